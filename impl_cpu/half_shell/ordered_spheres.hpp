// SPDX-License-Identifier: MIT
// The spheres in the order of their columns, one array per field, and the rows that they form.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/buffer.hpp"
#include "core/half_shell.hpp"
#include "core/plan.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/lanes.hpp"

namespace octocell::cpu {

struct OrderedSpheres {
  static constexpr std::uint64_t kMargin =
      block_size(32, 16);  // vectors may reach past the last sphere

  const std::uint32_t* column_ids = nullptr;  // [spheres + kMargin], sorted; the margin holds the
                                              // largest number
  const std::uint32_t* sphere = nullptr;      // [spheres]: their ids
  Buffer<float> x, y, z;                      // [spheres + kMargin]
  Buffer<float> r;                            // the same: stored radii; only [1] if all are equal
  Buffer<std::uint16_t> packed[4];            // the same in 16 bits; packed tests only
  Buffer<ColumnRow> rows;                     // an extra row behind the last marks its end
  std::uint64_t row_count = 0;
  std::uint32_t level_rows[kMaxLevels + 1] = {};  // rows [l] to [l + 1] belong to level l

  void allocate(std::uint64_t count, PairTest test, std::uint64_t most_rows) {
    for (Buffer<float>* field : {&x, &y, &z}) field->allocate(count + kMargin);
    r.allocate(has_one_radius(test) ? 1 : count + kMargin);
    for (auto& field : packed) field.allocate(is_packed(test) ? count + kMargin : 0);
    rows.allocate(most_rows + 1);
  }
  template <PairTest test>
  void put(std::uint64_t k, const Sphere& s, const Packing& packing) {
    x[k] = s.x;
    y[k] = s.y;
    z[k] = s.z;
    if (place_of_radius<test>(k) == k) r[k] = stored_radius<test>(s.r);
    if constexpr (!is_packed(test)) return;
    const PackedSphere small = pack<test>(s, packing);
    packed[0][k] = small.x;
    packed[1][k] = small.y;
    packed[2][k] = small.z;
    packed[3][k] = small.r;
  }
  /// Defines the values that are read behind the last sphere but not used.
  void pad(std::uint64_t count) {
    for (Buffer<float>* field : {&x, &y, &z, &r}) pad(*field, count);
    for (auto& field : packed) pad(field, count);
  }

  /// Returns the fields that the test reads.
  template <PairTest test>
  [[nodiscard]] FieldsOf<test> fields() const {
    if constexpr (is_packed(test)) {
      return {packed[0].data(), packed[1].data(), packed[2].data(), packed[3].data()};
    } else {
      return {x.data(), y.data(), z.data(), r.data()};
    }
  }
  template <PairTest test>
  [[nodiscard]] Sphere at(std::uint64_t k) const {
    return {x[k], y[k], z[k], r[place_of_radius<test>(k)]};
  }

 private:
  template <typename Number>
  static void pad(const Buffer<Number>& field, std::uint64_t count) {
    if (field.capacity() >= count + kMargin) std::fill_n(&field[count], kMargin, Number{0});
  }
};

}  // namespace octocell::cpu
