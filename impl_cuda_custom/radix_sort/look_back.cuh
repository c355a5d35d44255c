// SPDX-License-Identifier: MIT
// Decoupled look-back (Merrill & Garland 2016): how many keys with a digit stand in all tiles
// below, found while those tiles are still at work.
#pragma once

#include <cstdint>

namespace octocell::cuda_custom {

/// A tile says of two neighbouring digits, in one word that is read and written at once: 2 bits of
/// state, 31 bits for how often the odd digit occurs, 31 bits for the even one. So neither can be
/// seen without the other or without its state, counts may be added as they stand, and 2^31 - 1
/// items need no portions.
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

/// What the state bits mean changes from pass to pass: all words end a pass as `whole`, and the
/// next pass takes that for `empty`. So they are reset once a sort, not once a pass.
struct States {
  std::uint64_t empty;  // nothing was said yet
  std::uint64_t own;    // counts of this tile alone
  std::uint64_t whole;  // counts of this tile and all below
};
__host__ __device__ constexpr States states_of(int pass) {
  const auto state = [](int number) { return static_cast<std::uint64_t>(number % 4) << 62; };
  return {state(2 * pass), state(2 * pass + 1), state(2 * pass + 2)};
}
static_assert(states_of(0).empty == 0 && states_of(1).empty == states_of(0).whole);

/// Volatile: neither kept in a register while waiting, nor answered by a stale first-level cache.
/// Nothing but the word itself is handed over, so no fence is needed.
__device__ inline std::uint64_t read(const std::uint64_t* word) {
  return *reinterpret_cast<const volatile std::uint64_t*>(word);
}
__device__ inline void write(std::uint64_t* word, std::uint64_t value) {
  *reinterpret_cast<volatile std::uint64_t*>(word) = value;
}

/// Reads that one thread has in flight. One by one, each tile further back would cost a whole
/// latency; too many read what is not needed.
constexpr int kMostAtOnce = 8;

/// Tiles of words before those of tile 0, which are read with it and never used.
constexpr int kMargin = kMostAtOnce - 1;

/// The sum over all tiles below. `word` is this thread's of the tile just below, and `kStride`
/// words lie between two tiles. All of those tiles have started, so they will answer. Where few
/// tiles follow each other, all have just started: none knows the tiles below it, the way back is
/// long, and a greater kAtOnce shortens it.
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
