// SPDX-License-Identifier: MIT
// The host's part of frame coherence: when to forget earlier frames, and how wide a skin the next
// search gets. The device decides what a frame does (docs/decisions/0020-frame-coherence-gpu.md).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/planner/skin_width.hpp"
#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom::coherence {

class Coherence {
 public:
  /// Returns true if the flags, or the number of spheres, differ from the last scene. Then nothing
  /// known is valid any more, and other arrays may be needed. The device compares spheres; flags
  /// are compared here, where they come from.
  bool flags_differ(Workspace& w);
  /// Forgets all earlier frames, because the arrays are new or hold other data.
  void forget(Workspace& w);
  /// Does the same, and forgets how fast spheres move.
  void reset(Workspace& w);

  /// Returns the mode of the last frame if it needed no search: this frame may need none, either.
  [[nodiscard]] std::optional<FrameMode> predicted() const {
    if (last_ == FrameMode::search) return std::nullopt;
    return last_;
  }

  /// Enlarged spheres have more candidates. Returns true if those were too many; the frame must
  /// then be searched again, as if there had been no frame before.
  bool looked_at_too_many(Workspace& w, const State& state);

  /// Chooses the growth of the next search. Called after a frame, when the caller waits for it
  /// anyway.
  void learn(Workspace& w, const State& state);

 private:
  void note_mode(const Workspace& w, const State& state, const FrameHistory& history);

  std::vector<Flags> flags_;  // of the last scene
  std::uint64_t spheres_ = 0;
  std::uint64_t frames_ = 0;  // how many frames have been learned from
  bool has_list_ = false;
  FrameMode last_ = FrameMode::search;
  FrameMotion motion_;
  SkinWidth skin_;
};

}  // namespace octocell::cuda_custom::coherence
