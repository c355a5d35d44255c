// SPDX-License-Identifier: MIT
// What a frame leaves on the device for the next, and what the next may reuse. One thread of the
// device decides, with functions that tests on the host can call.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/flags.hpp"
#include "core/frame_mode.hpp"
#include "core/overlap.hpp"
#include "core/same_bits.hpp"

namespace octocell::cuda_custom::coherence {

/// What is known about earlier frames. All zero means that nothing is known.
struct FrameHistory {
  std::uint64_t frames;          // frames since then
  std::uint32_t snapshot_holds;  // the snapshot equals the spheres of the last frame
  std::uint32_t list_made;       // the last search listed neighbor pairs
  float growth;                  // of each radius in that search
  std::uint64_t neighbor_list;   // pairs listed; continues to count past the end
  std::uint32_t still;           // how many spheres of the sample had not changed in the last frame
  float farthest;                // the longest way of a sphere of the sample
  // Used within a frame, until its first kernel ends:
  std::uint32_t found;         // bits, see below
  std::uint32_t blocks_done;   // of that kernel
  std::uint32_t still_now;     // spheres of the sample
  std::uint32_t farthest_now;  // the bits of a float
};

/// Bits of FrameHistory::found.
inline constexpr std::uint32_t kDiffers = 1;  // from the snapshot
inline constexpr std::uint32_t kLeft = 2;     // its skin, or the plan's facts

/// The number of spheres whose steps stand for all. This is a guess that affects only time.
inline constexpr std::uint32_t kSampled = 256;

/// What may be reused, and how much room there is.
struct Allowed {
  bool unchanged;
  bool neighbor_list;
  std::uint64_t near_room;
  [[nodiscard]] OCTOCELL_HD bool any() const { return unchanged || neighbor_list; }
};

/// What a frame tries, before it has read a sphere.
struct FrameTasks {
  bool compare;        // with the snapshot
  bool check_skin;     // against the places where spheres were when the neighbor pairs were listed
  bool take_snapshot;  // for the next frame
};

/// Decides what a frame tries. `complete` means that the last frame found all pairs and had room
/// for them; if not, nothing from it is used. A snapshot is written if the next frame may use it:
/// in the first frame, and when nothing in the sample moves.
OCTOCELL_HD FrameTasks tasks_of(const FrameHistory& history, bool complete,
                                const Allowed& allowed) {
  const bool still = history.frames == 0 || history.still == kSampled;
  FrameTasks tasks = {};
  tasks.compare = complete && allowed.unchanged && history.snapshot_holds != 0;
  tasks.check_skin = complete && allowed.neighbor_list && history.list_made != 0 &&
                     history.neighbor_list <= allowed.near_room;
  tasks.take_snapshot = allowed.unchanged && !tasks.compare && still;
  return tasks;
}

OCTOCELL_HD FrameMode mode_of(const FrameTasks& tasks, std::uint32_t found) {
  if (tasks.compare && (found & kDiffers) == 0) return FrameMode::unchanged;
  if (tasks.check_skin && (found & kLeft) == 0) return FrameMode::neighbor_list;
  return FrameMode::search;
}

/// Returns what is known after the frame. `growth` belongs to its search, if it was one. What the
/// last search left stays valid until the next search.
OCTOCELL_HD FrameHistory after(FrameHistory history, const FrameTasks& tasks, FrameMode mode,
                               const Allowed& allowed, float growth) {
  ++history.frames;
  history.snapshot_holds = mode == FrameMode::unchanged || tasks.take_snapshot ? 1 : 0;
  if (mode == FrameMode::search) {
    history.list_made = allowed.neighbor_list && growth > 0.0F ? 1 : 0;
    history.growth = growth;
    history.neighbor_list = 0;
  }
  history.still = history.frames == 1 ? 0 : history.still_now;
  memcpy(&history.farthest, &history.farthest_now, sizeof history.farthest);
  history.found = history.blocks_done = history.still_now = history.farthest_now = 0;
  return history;
}

OCTOCELL_HD std::uint32_t bits_of(float value) {
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The ball of the growth around the place where a sphere was, and the point where it is now. As
/// long as they overlap and the radius is the same, the sphere has not left its skin
/// (docs/exactness.md). Both must be finite.
struct SkinTest {
  Sphere ball;
  Sphere point;
};
OCTOCELL_HD SkinTest skin_test_of(const Sphere& then, const Sphere& now, float growth) {
  return {{then.x, then.y, then.z, growth}, {now.x, now.y, now.z, 0.0F}};
}

/// Returns by how much a radius grows; static spheres are expected not to move, so theirs do not.
OCTOCELL_HD float growth_of(const Flags* flags, std::uint32_t sphere, float growth) {
  return flags != nullptr && is_static(flags[sphere]) ? 0.0F : growth;
}

/// Returns the radius that a search uses: enlarged if it lists neighbor pairs.
OCTOCELL_HD float radius_in_search(const Sphere& s, const Flags* flags, std::uint32_t sphere,
                                   float growth) {
  if (growth == 0.0F) return s.r;
  const float more = growth_of(flags, sphere, growth);
  return more == 0.0F ? s.r : grown_radius(s.r, more);
}

/// Decides in float32. If uncertain, only the exact predicate can tell.
OCTOCELL_HD Verdict within_skin(const Sphere& then, const Sphere& now, float growth) {
  if (growth == 0.0F) return same_bits(then, now) ? Verdict::overlap : Verdict::apart;
  if (bits_of(then.r) != bits_of(now.r)) return Verdict::apart;
  const SkinTest test = skin_test_of(then, now, growth);
  return filter_verdict<Filter::safe>(test.ball, test.point);
}

}  // namespace octocell::cuda_custom::coherence
