// SPDX-License-Identifier: MIT
// Lists of pairs in other layouts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "include/octocell/octocell.hpp"

namespace octocell::python {

/// Sorted by sphere: the neighbors of sphere i are indices[begin[i]] to indices[begin[i + 1] - 1].
struct Csr {
  std::vector<std::int64_t> begin;  // one more than there are spheres
  std::vector<std::int32_t> indices;
};

/// Every pair counts for i; with `both`, for j, too. Of sorted pairs, the neighbors of each sphere
/// are sorted as well.
Csr to_csr(std::span<const Pair> pairs, std::size_t sphere_count, bool both);

/// Returns spheres as the library reads them, from centres and radii in rows of `stride` floats.
void join(const float* centers, const float* radii, std::size_t radius_step,
          std::span<Sphere> spheres);

}  // namespace octocell::python
