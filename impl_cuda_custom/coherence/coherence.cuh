// SPDX-License-Identifier: MIT
// The host's part of frame coherence: what it forgets, and how wide a skin it asks the next search
// for. What a frame does is decided on the device (docs/decisions/0020-frame-coherence-gpu.md).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/planner/skin_width.hpp"
#include "impl_cuda_custom/stages.cuh"

namespace octocell::cuda_custom::coherence {

/// What spares a frame of that course its search.
inline std::optional<Skip> skip_of(FrameMode mode) {
  switch (mode) {
    case FrameMode::search:
      break;
    case FrameMode::unchanged:
      return Skip::unchanged;
    case FrameMode::neighbor_list:
      return Skip::skin;
  }
  return std::nullopt;
}

class Coherence {
 public:
  /// Another scene has come. The device compares spheres; flags are compared here, where they come
  /// from. True: they have changed, or the number of spheres has. Then nothing that was known
  /// holds, and other arrays may be needed.
  bool flags_differ(Workspace& w);
  /// Nothing is known from here on: the arrays are new, or mean something else.
  void forget(Workspace& w);
  /// The same, and how fast spheres move is not known either.
  void reset(Workspace& w);

  /// The course of the last frame, where it was spared its search: then this one may be, too.
  [[nodiscard]] std::optional<FrameMode> predicted() const {
    if (last_ == FrameMode::search) return std::nullopt;
    return last_;
  }

  /// Grown spheres have more candidates. If those are too many, the frame is to be searched again,
  /// as if there had been none before.
  bool looked_at_too_many(Workspace& w, const State& state);

  /// After a frame, while its caller waits for it anyway: chooses the growth of the next search.
  void learn(Workspace& w, const State& state);

 private:
  void note_mode(const Workspace& w, const State& state, const Kept& kept);

  std::vector<Flags> flags_;  // of the scene before
  std::uint64_t spheres_ = 0;
  std::uint64_t frames_ = 0;  // learnt from
  bool has_list_ = false;
  FrameMode last_ = FrameMode::search;
  FrameMotion motion_;
  SkinWidth skin_;
};

}  // namespace octocell::cuda_custom::coherence
