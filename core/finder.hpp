// SPDX-License-Identifier: MIT
// The one question that our backends, FCL and Bullet all answer: which pairs overlap?
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/pair.hpp"
#include "core/plan.hpp"
#include "core/sphere.hpp"

namespace octocell {

/// What a finder on a device can do besides. Each call follows an upload() whose find_pairs() was
/// complete, has ended when it returns, and leaves the pairs where digest() and download() look.
class DeviceRuns {
 public:
  virtual ~DeviceRuns() = default;

  /// Untimed: pushes the scene and the work buffers out of the device's cache.
  virtual void flush_cache() = 0;

  /// All stages, recorded once as one graph and replayed; milliseconds on the device.
  virtual double replay_ms() = 0;

  /// Spheres from pinned host memory, all stages, pairs back to pinned memory; milliseconds.
  virtual double transfers_ms() = 0;
};

/// How much of the host's memory a run writes to [bytes].
struct HostBytes {
  double fixed = 0.0;   // in every run
  double per_id = 0.0;  // of Capacities
  double per_cell = 0.0;
  double per_pair = 0.0;  // or uncertain pair
};

/// Calls come in this order: upload, find_pairs (any number of times), counts, then download or
/// digest. update may replace the spheres between two find_pairs.
class PairFinder {
 public:
  virtual ~PairFinder() = default;

  /// Allocates and copies; timed in cold runs only. Must not pre-sort: that belongs in
  /// find_pairs().
  virtual void upload(const Plan& plan, SceneView scene) = 0;

  /// The spheres have moved (same number). The next find_pairs() brings the standing structure up
  /// to date instead of building one; a finder without one starts again.
  virtual void update(SceneView scene) = 0;

  /// Timed. Must not allocate, print or block, except to read which stages a frame on a device may
  /// skip.
  virtual void find_pairs(StageClock& clock) = 0;

  /// A clock that can time find_pairs(): the host's, or one of the device's. It must not outlive
  /// the finder.
  virtual std::unique_ptr<StageClock> make_clock(Marks marks) {
    return std::make_unique<HostClock>(marks);
  }

  /// Untimed: waits, and says what was met and what was too small.
  virtual Counts counts() = 0;

  /// Untimed: the pairs found, sorted, i < j; a pair reported twice stands there twice.
  virtual std::vector<Pair> download() = 0;

  /// Untimed: the same without a copy, if they lie in the host's memory anyway. Valid until the
  /// next call of another function.
  virtual std::span<const Pair> sorted_pairs() {
    downloaded_ = download();
    return downloaded_;
  }

  /// Untimed: count and checksum, wherever the pairs are. Works for count_only plans too.
  virtual PairDigest digest() = 0;

  /// What runs with a plan need. Devices have limits of their own, which they know.
  [[nodiscard]] virtual HostBytes host_bytes(const Plan&, SceneView) const { return {}; }

  /// What else it can do on its device; none: it runs on the host, or offers no more.
  virtual DeviceRuns* device_runs() { return nullptr; }

 private:
  std::vector<Pair> downloaded_;
};

/// The stages of our own backends. Their order is written here and nowhere else.
class GridPairFinder : public PairFinder {
 public:
  void find_pairs(StageClock& clock) final {
    clock.start();
    bounds();
    const bool fused = bounds_with_cell_ids() && runs(Stage::cell_ids);
    if (!fused) clock.mark(Stage::bounds);
    run_stages(clock, fused ? Stage::bounds : Stage::cell_ids);
    if (mispredicted()) run_stages(clock, Stage::cell_ids);
  }

 protected:
  [[nodiscard]] virtual Method method() const = 0;
  /// The plan says that there are no pairs; bounds() has then left empty lists.
  [[nodiscard]] virtual bool nothing_to_find() const = 0;
  /// True if cell_ids() checks what bounds() would, in its one reading of the spheres.
  [[nodiscard]] virtual bool bounds_with_cell_ids() const { return false; }
  /// Asked after bounds(), which may have found, or predicted, that there is nothing to do.
  [[nodiscard]] virtual bool runs(Stage stage) const {
    if (nothing_to_find()) return false;
    const bool is_grids = stage >= Stage::cell_ids && stage <= Stage::cell_index;
    return !is_grids || method() != Method::brute_force;
  }
  virtual void bounds() = 0;
  virtual void cell_ids() = 0;
  virtual void sort() = 0;
  virtual void cell_index() = 0;
  virtual void pair_tests() = 0;
  virtual void resolve() = 0;
  /// Asked at the end. Returns true if a skipped stage is needed after all; runs() then says so.
  virtual bool mispredicted() { return false; }

 private:
  /// Those after bounds(). `first`: of the stages whose time ends with cell_ids().
  void run_stages(StageClock& clock, Stage first) {
    if (runs(Stage::cell_ids)) {
      cell_ids();
      clock.mark(first, Stage::cell_ids);
    }
    if (runs(Stage::sort)) {
      sort();
      clock.mark(Stage::sort);
    }
    if (runs(Stage::cell_index)) {
      cell_index();
      clock.mark(Stage::cell_index);
    }
    if (runs(Stage::pair_tests)) {
      pair_tests();
      clock.mark(Stage::pair_tests);
    }
    if (runs(Stage::resolve)) {
      resolve();
      clock.mark(Stage::resolve);
    }
  }
};

}  // namespace octocell
