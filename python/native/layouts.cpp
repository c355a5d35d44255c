// SPDX-License-Identifier: MIT
#include "python/native/layouts.hpp"

#include <numeric>

namespace octocell::python {

Csr to_csr(std::span<const Pair> pairs, std::size_t sphere_count, bool both) {
  Csr csr;
  csr.begin.assign(sphere_count + 1, 0);
  for (const Pair& pair : pairs) {
    ++csr.begin[pair.i + 1];
    if (both) ++csr.begin[pair.j + 1];
  }
  std::partial_sum(csr.begin.begin(), csr.begin.end(), csr.begin.begin());
  csr.indices.resize(static_cast<std::size_t>(csr.begin.back()));
  std::vector<std::int64_t> next(csr.begin.begin(), csr.begin.end() - 1);
  // First all smaller neighbors, then all larger ones: so each row of sorted pairs is sorted.
  if (both) {
    for (const Pair& pair : pairs) csr.indices[next[pair.j]++] = static_cast<std::int32_t>(pair.i);
  }
  for (const Pair& pair : pairs) csr.indices[next[pair.i]++] = static_cast<std::int32_t>(pair.j);
  return csr;
}

void join(const float* centers, const float* radii, std::size_t radius_step,
          std::span<Sphere> spheres) {
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const float* const center = centers + 3 * k;
    spheres[k] = {center[0], center[1], center[2], radii[radius_step * k]};
  }
}

}  // namespace octocell::python
