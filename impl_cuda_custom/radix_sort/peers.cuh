// SPDX-License-Identifier: MIT
// Which lanes of a warp hold the same digit.
#pragma once

#include <cstdint>

#include "impl_cuda_custom/radix_sort/device_tools.cuh"

namespace octocell::cuda_custom {

/// All bits set; passed to kernels, because the compiler must not know the value. See
/// peers_by_two_bits().
constexpr std::uint32_t kOnes = 0xffffffffu;

/// Returns those of `peers` that agree with this lane on two bits: whether `one` is zero, and
/// whether `other` is. It is written in PTX because ranking is limited by the unit for integers and
/// logic. CUDA C++ gives seven instructions a bit, all for that unit. This needs three and a half;
/// one of them, the complement as x * -1 - 1, runs on the unit that multiplies. With a factor known
/// to the compiler it would not.
__device__ inline unsigned peers_by_two_bits(unsigned peers, std::uint32_t one, std::uint32_t other,
                                             std::uint32_t ones) {
  asm volatile(
      "{ .reg .pred p, q;\n"
      "  .reg .b32 a, b;\n"
      "  setp.ne.u32 p, %1, 0;\n"
      "  setp.ne.u32 q, %2, 0;\n"
      "  vote.sync.ballot.b32 a, p, 0xffffffff;\n"
      "  vote.sync.ballot.b32 b, q, 0xffffffff;\n"
      "  @!p mad.lo.u32 a, a, %3, %3;\n"
      "  @!q mad.lo.u32 b, b, %3, %3;\n"
      "  lop3.b32 %0, %0, a, b, 0x80; }"  // 0x80: the and of three
      : "+r"(peers)
      : "r"(one), "r"(other), "r"(ones));
  return peers;
}

/// Finds the lanes with the same digit, for several digits at a time, so that the votes of one do
/// not wait for those of another.
template <int kDigitBits, int kAbreast>
__device__ void find_peers(const std::uint32_t (&digits)[kAbreast], std::uint32_t ones,
                           unsigned (&peers)[kAbreast]) {
  static_assert(kDigitBits % 2 == 0);
#pragma unroll
  for (int k = 0; k < kAbreast; ++k) peers[k] = kAllLanes;
#pragma unroll
  for (int bit = 0; bit < kDigitBits; bit += 2) {
#pragma unroll
    for (int k = 0; k < kAbreast; ++k) {
      const std::uint32_t digit = digits[k];
      peers[k] = peers_by_two_bits(peers[k], digit & 1u << bit, digit & 2u << bit, ones);
    }
  }
}

}  // namespace octocell::cuda_custom
