// SPDX-License-Identifier: MIT
// The one question that our backends, FCL and Bullet all answer: which pairs overlap?
#pragma once

#include <memory>
#include <vector>

#include "harness/interface/clock.hpp"
#include "harness/interface/pair.hpp"
#include "harness/interface/plan.hpp"
#include "harness/interface/sphere.hpp"

namespace octocell {

/// Calls come in this order: upload, find_pairs (any number of times), counts, then download or
/// digest. update may replace the spheres between two find_pairs.
class PairFinder {
 public:
  virtual ~PairFinder() = default;

  /// Untimed, except in cold runs: allocate, make the objects, copy. No re-layout that flatters.
  virtual void upload(const Plan& plan, SceneView scene) = 0;

  /// The spheres have moved (same number). The next find_pairs() brings the standing structure up
  /// to date instead of building one; a finder without one simply starts anew.
  virtual void update(SceneView scene) = 0;

  /// Timed: no allocation of ours, no printing, no wait for the host.
  virtual void find_pairs(StageClock& clock) = 0;

  /// Untimed: waits, and says what was met and what was too small.
  virtual Counts counts() = 0;

  /// Untimed: the pairs found, sorted, i < j; a pair reported twice stands there twice.
  virtual std::vector<Pair> download() = 0;

  /// Untimed: count and checksum, wherever the pairs are. Works for count_only plans too.
  virtual PairDigest digest() = 0;
};

/// The stages of our own backends. Their order is written here and nowhere else.
class GridPairFinder : public PairFinder {
 public:
  void find_pairs(StageClock& clock) final {
    clock.start();
    bounds();
    clock.mark(Stage::bounds);
    if (method() != Method::brute_force) {
      cell_ids();
      clock.mark(Stage::cell_ids);
      sort();
      clock.mark(Stage::sort);
      cell_index();
      clock.mark(Stage::cell_index);
    }
    pair_tests();
    clock.mark(Stage::pair_tests);
    resolve();
    clock.mark(Stage::resolve);
  }

 protected:
  [[nodiscard]] virtual Method method() const = 0;
  virtual void bounds() = 0;
  virtual void cell_ids() = 0;
  virtual void sort() = 0;
  virtual void cell_index() = 0;
  virtual void pair_tests() = 0;
  virtual void resolve() = 0;
};

}  // namespace octocell
