// SPDX-License-Identifier: MIT
#include "harness/trace/exact_decimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace octocell::trace {
namespace {

constexpr std::uint32_t kBillion = 1'000'000'000;  // nine digits at a time
constexpr int kFractionLimbs = 10;                 // 320 bits: 298 and a shift by 22
constexpr int kShift = 32 * kFractionLimbs - 298;

bool is_zero(std::span<const std::uint32_t> limbs) {
  return std::ranges::all_of(limbs, [](std::uint32_t limb) { return limb == 0; });
}

/// Divides by 10^9 and returns the remainder.
std::uint32_t divide(std::span<std::uint32_t> limbs) {
  std::uint64_t remainder = 0;
  for (std::size_t k = limbs.size(); k-- > 0;) {
    const std::uint64_t part = remainder << 32 | limbs[k];
    limbs[k] = static_cast<std::uint32_t>(part / kBillion);
    remainder = part % kBillion;
  }
  return static_cast<std::uint32_t>(remainder);
}

/// Multiplies by 10^9 and returns what goes beyond the highest limb.
std::uint32_t multiply(std::span<std::uint32_t> limbs) {
  std::uint64_t carry = 0;
  for (std::uint32_t& limb : limbs) {
    carry += std::uint64_t{limb} * kBillion;
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  return static_cast<std::uint32_t>(carry);
}

std::string whole_digits(std::span<std::uint32_t> limbs) {
  std::vector<std::uint32_t> groups;  // of nine digits, the lowest first
  do {
    groups.push_back(divide(limbs));
  } while (!is_zero(limbs));
  std::string text = fmt::format("{}", groups.back());
  for (std::size_t k = groups.size() - 1; k-- > 0;) text += fmt::format("{:09}", groups[k]);
  return text;
}

std::string fraction_digits(std::span<std::uint32_t> limbs) {
  std::string text;
  while (!is_zero(limbs)) text += fmt::format("{:09}", multiply(limbs));
  text.erase(text.find_last_not_of('0') + 1);
  return text;
}

}  // namespace

std::string exact_decimal(const exact::Square& value) {
  std::vector<std::uint32_t> limbs(std::size(value.limb) + 1);
  std::uint32_t below = 0;
  for (std::size_t k = 0; k < std::size(value.limb); ++k) {
    limbs[k] = value.limb[k] << kShift | below;
    below = value.limb[k] >> (32 - kShift);
  }
  limbs.back() = below;
  const std::span<std::uint32_t> all = limbs;
  const std::string fraction = fraction_digits(all.first(kFractionLimbs));
  const std::string whole = whole_digits(all.subspan(kFractionLimbs));
  return fraction.empty() ? whole : whole + "." + fraction;
}

}  // namespace octocell::trace
