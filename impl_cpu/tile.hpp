// SPDX-License-Identifier: MIT
// Up to 1024 spheres, one array per field: the data that the inner loop of stage 5 reads.
#pragma once

#include <cstddef>
#include <cstdint>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/lanes.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

template <PairTest test>
struct Tile {
  static constexpr std::uint32_t kLanes =
      block_size(8, 4);  // 16 were slower: most cells hold fewer
  using Number = NumberOf<test>;

  // Lanes may reach past the last sphere; the values there are not used.
  alignas(64) Number x[kTileSpheres + kLanes];
  alignas(64) Number y[kTileSpheres + kLanes];
  alignas(64) Number z[kTileSpheres + kLanes];
  alignas(64) Number r[kTileSpheres + kLanes];  // stored radii
  Object object[kTileSpheres];
  std::size_t size = 0;

  void push(const Sphere& s, Object o, const Packing& packing) {
    if constexpr (is_packed(test)) {
      put(pack<test>(s, packing));
    } else {
      put(stored<test>(s));
    }
    object[size] = o;
    ++size;
  }

  /// Fills the lanes past the end.
  void pad() {
    for (std::size_t k = size; k < size + kLanes; ++k) x[k] = y[k] = z[k] = r[k] = Number{};
  }

  [[nodiscard]] FieldsOf<test> fields() const { return {x, y, z, r}; }
  [[nodiscard]] std::uint32_t id(std::size_t i) const { return object[i] & kIdMask; }

  /// Returns one bit for each of spheres j to j + kLanes: whether it may overlap sphere i of
  /// `rows`.
  [[nodiscard, gnu::always_inline]] LaneBits may_overlap(const Tile& rows, std::size_t i,
                                                         std::size_t j) const {
    const LaneBits found = Lanes<test, kLanes>(fields(), j).may_overlap(rows.fields(), i);
    return found & first_bits(static_cast<std::uint32_t>(size - j));
  }

 private:
  template <typename Stored>
  void put(const Stored& s) {
    x[size] = s.x;
    y[size] = s.y;
    z[size] = s.z;
    r[size] = s.r;
  }
};

}  // namespace octocell::cpu
