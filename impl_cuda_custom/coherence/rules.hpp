// SPDX-License-Identifier: MIT
// What a frame leaves on the device for the next, and what the next may take over from it. Decided
// there, by one thread, in functions that the host's tests can call.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/flags.hpp"
#include "core/predicate.hpp"
#include "core/same_bits.hpp"

namespace octocell::cuda_custom::coherence {

/// What a frame does. Kernels of other courses leave as soon as they see it.
enum class FrameMode : std::uint32_t {
  search,         // everything
  unchanged,      // no sphere has changed: the pairs stand
  neighbor_list,  // no sphere has left the skin: pairs are among the near ones
};

/// What is known of the frames before. All zero: nothing.
struct Kept {
  std::uint64_t frames;          // since then
  std::uint32_t snapshot_holds;  // the copy equals the spheres of the last frame
  std::uint32_t list_made;       // neighbor pairs were listed in the last search, with
  float growth;                  // as much added to each radius
  std::uint64_t neighbor_list;   // listed; counts on past the end
  std::uint32_t still;           // how many of the sample had not changed in the last frame
  float farthest;                // that one of the sample had moved
  // In a frame, until its first kernel ends:
  std::uint32_t found;         // bits, see below
  std::uint32_t blocks_done;   // of that kernel
  std::uint32_t still_now;     // of the sample
  std::uint32_t farthest_now;  // the bits of a float
};

/// What has been seen of the spheres.
inline constexpr std::uint32_t kDiffers = 1;  // from the copy
inline constexpr std::uint32_t kLeft = 2;     // the skin, or the plan's facts

/// Spheres whose steps say how all move: a guess, on which time depends and nothing else.
inline constexpr std::uint32_t kSampled = 256;

/// What may be taken over, and the room for it.
struct Allowed {
  bool unchanged;
  bool neighbor_list;
  std::uint64_t near_room;
  [[nodiscard]] OCTOCELL_HD bool any() const { return unchanged || neighbor_list; }
};

/// What a frame tries, before it has seen a sphere.
struct Trial {
  bool compare;  // with the copy
  bool skin;     // with where spheres were when the neighbor pairs were listed
  bool keep;     // a copy is made, for the next frame
};

/// `complete`: the last frame found all pairs, and had room for them. If not, nothing it left is
/// relied on. A copy is made where it may be of use in the next frame: the first time, and once
/// nothing in the sample moves.
OCTOCELL_HD Trial trial_of(const Kept& kept, bool complete, const Allowed& allowed) {
  const bool still = kept.frames == 0 || kept.still == kSampled;
  Trial trial = {};
  trial.compare = complete && allowed.unchanged && kept.snapshot_holds != 0;
  trial.skin = complete && allowed.neighbor_list && kept.list_made != 0 &&
               kept.neighbor_list <= allowed.near_room;
  trial.keep = allowed.unchanged && !trial.compare && still;
  return trial;
}

OCTOCELL_HD FrameMode mode_of(const Trial& trial, std::uint32_t found) {
  if (trial.compare && (found & kDiffers) == 0) return FrameMode::unchanged;
  if (trial.skin && (found & kLeft) == 0) return FrameMode::neighbor_list;
  return FrameMode::search;
}

/// What is known once the frame has taken its course. `growth`: that of its search, if it has one.
/// What stood before the last search stands until the next.
OCTOCELL_HD Kept after(Kept kept, const Trial& trial, FrameMode mode, const Allowed& allowed,
                       float growth) {
  ++kept.frames;
  kept.snapshot_holds = mode == FrameMode::unchanged || trial.keep ? 1 : 0;
  if (mode == FrameMode::search) {
    kept.list_made = allowed.neighbor_list && growth > 0.0F ? 1 : 0;
    kept.growth = growth;
    kept.neighbor_list = 0;
  }
  kept.still = kept.frames == 1 ? 0 : kept.still_now;
  memcpy(&kept.farthest, &kept.farthest_now, sizeof kept.farthest);
  kept.found = kept.blocks_done = kept.still_now = kept.farthest_now = 0;
  return kept;
}

OCTOCELL_HD std::uint32_t bits_of(float value) {
  std::uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The ball of the growth around where a sphere was, and the point where it is now: as long as they
/// overlap, and the radius is the same, the sphere has not left its skin (docs/exactness.md). Both
/// finite.
struct Step {
  Sphere ball;
  Sphere point;
};
OCTOCELL_HD Step step_of(const Sphere& then, const Sphere& now, float growth) {
  return {{then.x, then.y, then.z, growth}, {now.x, now.y, now.z, 0.0F}};
}

/// By how much a radius grows: static spheres are expected to stand.
OCTOCELL_HD float growth_of(const Flags* flags, std::uint32_t sphere, float growth) {
  return flags != nullptr && is_static(flags[sphere]) ? 0.0F : growth;
}

/// The radius that a search goes by which lists neighbor pairs, and without growth any other.
OCTOCELL_HD float radius_in_search(const Sphere& s, const Flags* flags, std::uint32_t sphere,
                                   float growth) {
  if (growth == 0.0F) return s.r;
  const float more = growth_of(flags, sphere, growth);
  return more == 0.0F ? s.r : grown_radius(s.r, more);
}

/// In float32. Uncertain: only the exact predicate knows.
OCTOCELL_HD Verdict within_skin(const Sphere& then, const Sphere& now, float growth) {
  if (growth == 0.0F) return same_bits(then, now) ? Verdict::overlap : Verdict::apart;
  if (bits_of(then.r) != bits_of(now.r)) return Verdict::apart;
  const Step step = step_of(then, now, growth);
  return filter_verdict<Filter::safe>(step.ball, step.point);
}

}  // namespace octocell::cuda_custom::coherence
