// SPDX-License-Identifier: MIT
// Up to 1024 spheres, field by field, next to each other: what the inner loop of stage 5 reads.
#pragma once

#include <experimental/simd>

#include "harness/interface/faults.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

namespace stdx = std::experimental;

inline constexpr std::size_t kLanes = 8;  // 16 were slower: most cells hold fewer than 8
using Floats = stdx::simd<float, stdx::simd_abi::deduce_t<float, kLanes>>;

struct Tile {
  // A vector may reach past the last sphere; what it reads there is masked out.
  alignas(64) float x[kTileSpheres + kLanes];
  alignas(64) float y[kTileSpheres + kLanes];
  alignas(64) float z[kTileSpheres + kLanes];
  alignas(64) float r[kTileSpheres + kLanes];  // band radii
  Object object[kTileSpheres];
  std::size_t size = 0;

  template <Band band>
  void push(const Sphere& s, Object o) {
    x[size] = s.x;
    y[size] = s.y;
    z[size] = s.z;
    r[size] = band_radius<band>(s.r);
    object[size] = o;
    ++size;
  }

  /// Defines the lanes past the end.
  void pad() {
    for (std::size_t k = size; k < size + kLanes; ++k) x[k] = y[k] = z[k] = r[k] = 0.0F;
  }

  [[nodiscard]] Sphere sphere(std::size_t i) const { return {x[i], y[i], z[i], r[i]}; }
  [[nodiscard]] std::uint32_t id(std::size_t i) const { return object[i] & kIdMask; }

  /// Level 1 of the predicate, eight at a time: may any of columns j..j+7 overlap `row`?
  [[nodiscard]] bool any_may_overlap(const Sphere& row, std::size_t j) const {
    const auto load = [j](const float* field) { return Floats(field + j, stdx::element_aligned); };
    const Floats dx = row.x - load(x);
    const Floats dy = row.y - load(y);
    const Floats dz = row.z - load(z);
    const Floats reach = row.r + load(r);
    return OCTOCELL_FAULT(tile_touching_apart,
                          stdx::any_of(dx * dx + dy * dy + dz * dz < reach * reach),
                          stdx::any_of(dx * dx + dy * dy + dz * dz <= reach * reach));
  }
};

}  // namespace octocell::cpu
