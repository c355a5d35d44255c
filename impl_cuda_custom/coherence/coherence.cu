// SPDX-License-Identifier: MIT
#include "impl_cuda_custom/coherence/coherence.cuh"

#include <algorithm>

#include "core/cuda/cuda.cuh"

namespace octocell::cuda_custom::coherence {
namespace {

/// Measured on an H100, with a gas of a million spheres.
constexpr SkinCosts kSkinCosts = {
    .list = 1.8F, .fetch = 0.3F, .compare = 0.3F, .neighbor_list = 0.06F};

FrameHistory read(const Workspace& w) {
  FrameHistory history;
  cuda::check(cudaMemcpyAsync(&history, w.history.data(), sizeof history, cudaMemcpyDeviceToHost,
                              w.stream));
  cuda::check(cudaStreamSynchronize(w.stream));
  return history;
}

}  // namespace

void Coherence::reset(Workspace& w) {
  skin_.reset(w.plan.skin.growth, kSkinCosts, w.plan.skin.static_share);
  forget(w);
}

void Coherence::forget(Workspace& w) {
  w.growth = 0.0F;
  frames_ = 0;
  has_list_ = false;
  last_ = FrameMode::search;
  if (w.history.data() == nullptr) return;
  cuda::check(cudaMemsetAsync(w.history.data(), 0, sizeof(FrameHistory), w.stream));
}

bool Coherence::flags_differ(Workspace& w) {
  const SceneView& scene = w.scene;
  if (spheres_ == scene.spheres.size() && std::ranges::equal(flags_, scene.flags)) return false;
  spheres_ = scene.spheres.size();
  flags_.assign(scene.flags.begin(), scene.flags.end());
  return true;
}

bool Coherence::looked_at_too_many(Workspace& w, const State& state) {
  const bool too_many =
      state.mode == FrameMode::search && state.candidates > w.plan.candidate_limit;
  if (!too_many || !w.coherent() || read(w).list_made == 0) return false;
  skin_.made(w.plan.skin.growth, motion_);  // a list was made and served no frame
  skin_.left();
  forget(w);
  return true;
}

void Coherence::learn(Workspace& w, const State& state) {
  if (!w.coherent()) return;
  const FrameHistory history = read(w);
  if (history.frames == frames_) return;  // called twice for the same frame
  frames_ = history.frames;
  last_ = state.mode;
  note_mode(w, state, history);
  if (history.frames < 2 || !w.allowed().neighbor_list) return;
  motion_ = {.still_share = static_cast<float>(history.still) / kSampled,
             .farthest = history.farthest};
  w.growth = skin_.half_skin_for(motion_).value_or(0.0F);
}

/// Needs `motion_` as it was when the growth was chosen.
void Coherence::note_mode(const Workspace& w, const State& state, const FrameHistory& history) {
  if (state.mode == FrameMode::neighbor_list) skin_.served();
  if (state.mode != FrameMode::search) return;
  if (has_list_) skin_.left();
  has_list_ = history.list_made != 0 && history.neighbor_list <= w.allowed().near_room &&
              state.violations == 0;
  if (history.list_made == 0) return;
  skin_.made(history.growth, motion_);
  if (!has_list_) skin_.left();
}

}  // namespace octocell::cuda_custom::coherence
