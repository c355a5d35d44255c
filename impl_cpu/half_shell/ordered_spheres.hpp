// SPDX-License-Identifier: MIT
// The spheres in the order of their columns, field by field, and the rows that they form.
#pragma once

#include "harness/interface/buffer.hpp"
#include "harness/interface/plan.hpp"

namespace octocell::cpu {

/// The columns of one y and one z of a level that hold spheres.
struct Row {
  std::uint32_t first_id;  // of its column 0
  std::uint32_t begin;     // its spheres end where the next row's begin
};

struct OrderedSpheres {
  static constexpr std::uint64_t kMargin = 32;  // vectors may reach past the last sphere

  const std::uint32_t* column_ids = nullptr;  // [spheres + kMargin], sorted; then the greatest
  Buffer<float> x, y, z, r;                   // [spheres + kMargin]; r: band radii
  Buffer<std::uint32_t> sphere;               // [spheres]: their ids
  Buffer<Row> rows;                           // [spheres + 1]; one behind the last ends it
  std::uint64_t row_count = 0;
  std::uint32_t level_rows[kMaxLevels + 1] = {};  // level l has rows [l] to [l + 1]

  void allocate(std::uint64_t count) {
    for (Buffer<float>* field : {&x, &y, &z, &r}) field->allocate(count + kMargin);
    sphere.allocate(count);
    rows.allocate(count + 1);
  }
  template <Band band>
  void put(std::uint64_t k, const Sphere& s, std::uint32_t id) {
    x[k] = s.x;
    y[k] = s.y;
    z[k] = s.z;
    r[k] = band_radius<band>(s.r);
    sphere[k] = id;
  }
  [[nodiscard]] Sphere at(std::uint64_t k) const { return {x[k], y[k], z[k], r[k]}; }
};

}  // namespace octocell::cpu
