// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace octocell {

/// A set of enumerators whose values are 0 to `count` - 1.
template <typename Enum, std::size_t count>
class EnumSet {
 public:
  constexpr EnumSet() = default;
  static constexpr EnumSet all() { return EnumSet((1U << count) - 1U); }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr bool has(Enum e) const { return (bits_ & bit(e)) != 0; }
  /// Returns the enumerator with the lowest value. The set is not empty.
  [[nodiscard]] constexpr Enum first() const { return static_cast<Enum>(std::countr_zero(bits_)); }
  [[nodiscard]] constexpr EnumSet with(Enum e) const { return EnumSet(bits_ | bit(e)); }
  [[nodiscard]] constexpr EnumSet without(Enum e) const { return EnumSet(bits_ & ~bit(e)); }
  [[nodiscard]] constexpr EnumSet both(EnumSet other) const { return EnumSet(bits_ & other.bits_); }
  [[nodiscard]] constexpr EnumSet either(EnumSet other) const {
    return EnumSet(bits_ | other.bits_);
  }
  friend constexpr bool operator==(EnumSet, EnumSet) = default;

 private:
  static_assert(count < 32);
  constexpr explicit EnumSet(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Enum e) { return 1U << static_cast<std::uint32_t>(e); }
  std::uint32_t bits_ = 0;
};

}  // namespace octocell
