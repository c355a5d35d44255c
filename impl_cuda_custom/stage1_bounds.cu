// SPDX-License-Identifier: MIT
// Stage 1, bounds: are the plan's assumptions about the scene still true?
// Reads spheres. Writes a violation, or nothing; initializes State.
// Cost: one pass, 16 bytes a sphere; none for half_shell and tiles, whose stage 2 makes the same
//       checks.
// Idea: the plan's facts are limits, so each sphere is compared with them by itself. Nothing has to
//       be reduced, and if all is well nothing is written.
#include <cstdint>

#include "impl_cuda_custom/coherence/frames.cuh"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {
namespace {

constexpr int kSpheresPerThread = 4;  // that many loads are in flight at once
constexpr int kSpheresPerBlock = kBlockThreads * kSpheresPerThread;

/// Initializes State on the device: a copy from the host would need memory that outlives it. Also
/// clears the counters of stage 2.
__global__ void open_state_kernel(State* state, State opening, std::uint32_t* counters,
                                  std::uint64_t counter_count) {
  if (threadIdx.x == 0) *state = opening;
  for (std::uint64_t k = threadIdx.x; k < counter_count; k += blockDim.x) counters[k] = 0;
}

__global__ void __launch_bounds__(kBlockThreads)
    bounds_kernel(const Sphere* spheres, std::uint64_t count, PlanFacts facts, State* state) {
  const std::uint64_t first = std::uint64_t{blockIdx.x} * kSpheresPerBlock + threadIdx.x;
  std::uint32_t violations = 0;
#pragma unroll
  for (int k = 0; k < kSpheresPerThread; ++k) {
    const std::uint64_t i = first + static_cast<std::uint64_t>(k) * kBlockThreads;
    if (i < count) violations |= violation_of(load_sphere(spheres, i), facts);
  }
  if (violations != 0) atomicOr(&state->violations, violations);
}

State opening_state(const Workspace& w) {
  State state;
  const std::uint64_t count = w.sphere_count();
  const bool goes_on = !w.plan.nothing_to_find;  // if not, the counts stay zero, as if no stage had
                                                 // run
  if (goes_on && !w.brute_force()) {
    state.ids = count;  // the homes; phantoms are added later
  } else if (goes_on && count > 0) {
    state.entries = count;
    state.candidates = count * (count - 1) / 2;
  }
  if (count > 0 && count != w.plan.facts.sphere_count) state.violations = kOutsidePlan;
  state.out_of_order = w.is_not_asked_for_order();
  return state;
}

/// The counters that stage 2 of half_shell and of tiles adds to.
struct Counters {
  std::uint32_t* words = nullptr;
  std::uint64_t count = 0;
};
Counters counters_of(Workspace& w) {
  if (w.tiles()) return {w.tile_sizes.data(), w.plan.tiles.tile_count()};
  if (!w.half_shell()) return {};
  return {reinterpret_cast<std::uint32_t*>(w.sort_scratch.data()), w.sorter_now().zeroed_words()};
}

}  // namespace

void bounds(Workspace& w) {
  if (w.coherent()) return coherence::open_frame(w);
  constexpr int kOpeningThreads = 1024;
  const Counters counters = counters_of(w);
  open_state_kernel<<<1, kOpeningThreads, 0, w.stream>>>(w.state.data(), opening_state(w),
                                                         counters.words, counters.count);
  cuda::check_launch();
  if (w.sphere_count() == 0 || w.half_shell() || w.tiles()) return;
  bounds_kernel<<<blocks_for(w.sphere_count(), kSpheresPerBlock), kBlockThreads, 0, w.stream>>>(
      w.spheres.data(), w.sphere_count(), w.plan.facts, w.state.data());
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom
