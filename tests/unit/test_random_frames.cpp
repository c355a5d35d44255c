// SPDX-License-Identifier: MIT
// Random sequences of frames on impl_cpu: every frame has the exact pairs. OCTOCELL_FRAME_SEQUENCES
// sets how many are played, OCTOCELL_FRAME_SEED the first seed.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "impl_cpu/backend.hpp"
#include "impl_cpu/block_size.hpp"
#include "tests/support/random_player.hpp"

namespace octocell {
namespace {

TEST(RandomFrames, HaveTheExactPairs) {
  constexpr std::uint64_t kSequences = 300;
  // Where blocks are small, small scenes have many of them.
  constexpr std::size_t kMostSpheres = cpu::block_size(6000, 1000);
  play_random_frames(kSequences, kMostSpheres, cpu::make_backend,
                     {Skip::unchanged, Skip::few_movers, Skip::skin});
}

}  // namespace
}  // namespace octocell
