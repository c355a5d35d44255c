// SPDX-License-Identifier: MIT
// Decoupled look-back (Merrill & Garland 2016): finds how many keys with a digit are in all tiles
// below, while those tiles are still being processed.
#pragma once

#include <cstdint>

namespace octocell::cuda_custom {

/// A tile publishes two neighbouring digits in one word, which is read and written at once: 2 bits
/// of state, 31 bits for the count of the odd digit, 31 bits for the count of the even one. So no
/// reader sees one without the other or without its state. Counts can be added without unpacking,
/// and 2^31 - 1 items need no splitting.
namespace look_back {

constexpr int kCountBits = 31;
constexpr std::uint64_t kOneCount = (std::uint64_t{1} << kCountBits) - 1;
constexpr std::uint64_t kCounts = (std::uint64_t{1} << 2 * kCountBits) - 1;
constexpr std::uint64_t kState = ~kCounts;

__host__ __device__ constexpr std::uint64_t pack(std::uint32_t even, std::uint32_t odd) {
  return std::uint64_t{odd} << kCountBits | even;
}
__host__ __device__ constexpr std::uint32_t even_of(std::uint64_t word) {
  return static_cast<std::uint32_t>(word & kOneCount);
}
__host__ __device__ constexpr std::uint32_t odd_of(std::uint64_t word) {
  return static_cast<std::uint32_t>(word >> kCountBits & kOneCount);
}

/// The meaning of the state bits changes from pass to pass: all words end a pass as `whole`, which
/// the next pass reads as `empty`. So they are reset once per sort, not once per pass.
struct States {
  std::uint64_t empty;  // nothing published yet
  std::uint64_t own;    // counts of this tile alone
  std::uint64_t whole;  // counts of this tile and all below
};
__host__ __device__ constexpr States states_of(int pass) {
  const auto state = [](int number) { return static_cast<std::uint64_t>(number % 4) << 62; };
  return {state(2 * pass), state(2 * pass + 1), state(2 * pass + 2)};
}
static_assert(states_of(0).empty == 0 && states_of(1).empty == states_of(0).whole);

/// Volatile: a waiting thread must not keep the word in a register or read it from a stale
/// first-level cache. Only the word itself is passed on, so no fence is needed.
__device__ inline std::uint64_t read(const std::uint64_t* word) {
  return *reinterpret_cast<const volatile std::uint64_t*>(word);
}
__device__ inline void write(std::uint64_t* word, std::uint64_t value) {
  *reinterpret_cast<volatile std::uint64_t*>(word) = value;
}

/// How many reads a thread has in flight. With single reads, each tile further back costs a whole
/// latency; with too many, most of them are not needed.
constexpr int kMostAtOnce = 8;

/// Tiles of words before those of tile 0: they are read together with it and never used.
constexpr int kMargin = kMostAtOnce - 1;

/// Returns the sum over all tiles below. `word` is this thread's word of the tile just below; two
/// tiles are `kStride` words apart. All those tiles have started, so they will publish. If there
/// are few tiles, all have just started and none knows the tiles below it. Then the way back is
/// long, and a larger kAtOnce shortens it.
template <int kStride, int kAtOnce>
__device__ std::uint64_t sum_below(const std::uint64_t* word, const States& states) {
  std::uint64_t sum = 0;
  for (;; word -= kAtOnce * kStride) {
    std::uint64_t words[kAtOnce];
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) words[k] = read(word - k * kStride);
#pragma unroll
    for (int k = 0; k < kAtOnce; ++k) {
      while ((words[k] & kState) == states.empty) words[k] = read(word - k * kStride);
      sum += words[k] & kCounts;
      if ((words[k] & kState) == states.whole) return sum;  // tile 0 always is
    }
  }
}

}  // namespace look_back
}  // namespace octocell::cuda_custom
