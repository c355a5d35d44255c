// SPDX-License-Identifier: MIT
// The one question that our backends, FCL and Bullet all answer: which pairs overlap?
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/buffer.hpp"
#include "core/clock.hpp"
#include "core/frame_mode.hpp"
#include "core/pair.hpp"
#include "core/plan.hpp"
#include "core/run_record.hpp"
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

/// Pairs that belong to their holder.
struct OwnedPairs {
  Buffer<Pair> items;
  std::uint64_t count = 0;
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

  /// Sets what long runs ask from time to time, on the thread of the caller; may be empty. If it
  /// returns true, find_pairs() throws Stopped, and the next call must be upload(). Best effort: a
  /// finder may never ask.
  virtual void stop_when(std::function<bool()> /*wanted*/) {}

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

  /// Returns the same in the order that the pairs happen to have. Valid until the next call of
  /// another function. Untimed.
  virtual std::span<const Pair> pairs() { return sorted_pairs(); }

  /// Returns the pairs in memory of their own; the finder then has none until its next run. Sorted
  /// if sorted_pairs() was called before. Untimed.
  virtual OwnedPairs take_pairs() {
    const std::span<const Pair> found = pairs();
    OwnedPairs taken;
    taken.items.allocate(found.size());
    taken.count = found.size();
    std::copy(found.begin(), found.end(), taken.items.data());
    return taken;
  }

  /// Returns count and checksum, wherever the pairs are; also for count_only plans. Untimed.
  virtual PairDigest digest() = 0;

  /// Returns what runs with a plan need. GPU memory is not included: a GPU backend checks it
  /// itself.
  [[nodiscard]] virtual HostBytes host_bytes(const Plan&, SceneView) const { return {}; }

  /// From now on, each find_pairs() writes down what its stages read and wrote, until `to` is null.
  /// That is slow and allocates: for a few thousand spheres, and a plan for one thread. Returns
  /// false if the finder cannot do it.
  virtual bool record(RunRecord* /*to*/) { return false; }

  /// Returns what else this finder can do on a GPU; null if it runs on the host or can do no more.
  virtual DeviceRuns* device_runs() { return nullptr; }

 private:
  std::vector<Pair> downloaded_;
};

/// Returns the stages after stage 1 that a plan needs, in a frame with this mode.
inline Stages stages_after_bounds(const Plan& plan, FrameMode mode = FrameMode::search) {
  if (plan.nothing_to_find || mode == FrameMode::unchanged) return {};
  const Stages tests = Stages().with(Stage::pair_tests).with(Stage::resolve);
  if (plan.method == Method::brute_force || mode == FrameMode::neighbor_list) return tests;
  if (plan.method == Method::tiles) return tests.with(Stage::cell_ids);  // sorts within tiles
  return tests.with(Stage::cell_ids).with(Stage::sort).with(Stage::cell_index);
}

/// Runs the stages of our own backends, in the order of stage.hpp.
class GridPairFinder : public PairFinder {
 public:
  void find_pairs(StageClock& clock) final {
    clock.start();
    if (record_ != nullptr) *record_ = {};
    Stages left = Stages().with(Stage::bounds);
    while (!left.empty()) {
      const Stage first = left.first();
      Stage last = first;
      left = run(first, left.without(first));
      if (first == Stage::bounds && left.has(Stage::cell_ids) && bounds_with_cell_ids()) {
        last = Stage::cell_ids;
        left = run(last, left.without(last));
      }
      clock.mark(first, last);
      if (record_ != nullptr) write_down(last, *record_);
      if (left.empty()) left = missed_stages();
    }
  }

  bool record(RunRecord* to) final {
    record_ = to;
    return true;
  }

 protected:
  /// Runs a stage, or queues it. Returns the stages that follow: after bounds, those that the frame
  /// needs; after others, `left`, unless the stage failed and earlier ones must run again. If the
  /// plan says that there are no pairs, bounds leaves empty lists.
  virtual Stages run(Stage stage, Stages left) = 0;
  /// Returns true if cell_ids also makes the checks of bounds, so that the spheres are read once.
  [[nodiscard]] virtual bool bounds_with_cell_ids() const { return false; }
  /// Called at the end. Returns stages that were left out and are needed after all.
  virtual Stages missed_stages() { return {}; }
  /// Copies what a stage has written into the record.
  virtual void write_down(Stage stage, RunRecord& record) = 0;
  /// Returns where stages write what is gone when they end; null if this run is not recorded.
  [[nodiscard]] RunRecord* recording() const { return record_; }

 private:
  RunRecord* record_ = nullptr;
};

}  // namespace octocell
