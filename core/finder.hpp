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

/// More that a finder on a GPU can do. Each call must follow an upload() whose find_pairs() was
/// complete. When the call returns, its work has ended and the pairs are where digest() and
/// download() read them.
class DeviceRuns {
 public:
  virtual ~DeviceRuns() = default;

  /// Untimed: evicts the scene and the work buffers from the device's cache.
  virtual void flush_cache() = 0;

  /// Records all stages once as one graph and replays it. Returns milliseconds on the device.
  virtual double replay_ms() = 0;

  /// Copies spheres from pinned host memory, runs all stages and copies the pairs back to pinned
  /// memory. Returns milliseconds.
  virtual double transfers_ms() = 0;
};

/// How many bytes of the host's memory a run writes.
struct HostBytes {
  double fixed = 0.0;   // in every run
  double per_id = 0.0;  // of Capacities
  double per_cell = 0.0;
  double per_pair = 0.0;  // per pair or uncertain pair
};

/// Calls come in this order: upload, find_pairs (any number of times), counts, then download or
/// digest. update may replace the spheres between two calls of find_pairs.
class PairFinder {
 public:
  virtual ~PairFinder() = default;

  /// Allocates and copies. Timed only in cold runs. Must not pre-sort: that belongs in
  /// find_pairs().
  virtual void upload(const Plan& plan, SceneView scene) = 0;

  /// Announces that the spheres have moved (their number is the same). The next find_pairs()
  /// updates the finder's standing structure instead of building a new one; a finder without one
  /// starts from scratch.
  virtual void update(SceneView scene) = 0;

  /// Finds the pairs; timed. Must not allocate, print or block, except to read which stages a GPU
  /// frame may skip.
  virtual void find_pairs(StageClock& clock) = 0;

  /// Returns a clock that can time find_pairs(): the host's or the device's. It must not outlive
  /// the finder.
  virtual std::unique_ptr<StageClock> make_clock(Marks marks) {
    return std::make_unique<HostClock>(marks);
  }

  /// Waits, then returns what was found and which buffers were too small. Untimed.
  virtual Counts counts() = 0;

  /// Returns the pairs found, sorted, with i < j; a pair found twice appears twice. Untimed.
  virtual std::vector<Pair> download() = 0;

  /// Returns the same, without a copy if the pairs are in the host's memory anyway. Valid until the
  /// next call of another function. Untimed.
  virtual std::span<const Pair> sorted_pairs() {
    downloaded_ = download();
    return downloaded_;
  }

  /// Returns count and checksum, wherever the pairs are; also for count_only plans. Untimed.
  virtual PairDigest digest() = 0;

  /// Returns what runs with a plan need. GPU memory is not included: a GPU backend checks it
  /// itself.
  [[nodiscard]] virtual HostBytes host_bytes(const Plan&, SceneView) const { return {}; }

  /// Returns what else this finder can do on a GPU; null if it runs on the host or can do no more.
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
  /// Returns true if the plan says that there are no pairs; bounds() has then left empty lists.
  [[nodiscard]] virtual bool nothing_to_find() const = 0;
  /// Returns true if cell_ids() also makes the checks of bounds(), so that the spheres are read
  /// once.
  [[nodiscard]] virtual bool bounds_with_cell_ids() const { return false; }
  /// Returns whether a stage runs. Called after bounds(), which may find, or predict, that nothing
  /// is left to do.
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
  /// Returns true if a skipped stage is needed after all; runs() then allows it. Called at the end.
  virtual bool mispredicted() { return false; }

 private:
  /// Runs the stages after bounds(). The time that ends with cell_ids() belongs to the stages from
  /// `first` on.
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
