// SPDX-License-Identifier: MIT
// CGAL finds the pairs of boxes that meet; of those, spheres that overlap are kept.
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/MP_Float.h>
#include <CGAL/box_intersection_d.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "octocell_plugin.h"

namespace {

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;

/// Rounding is monotone, so boxes of spheres that touch still meet after it. Boxes are closed.
Box box_of(const octocell_sphere& s, std::uint32_t id) {
  const double r = s.r;
  std::array<double, 3> low = {s.x - r, s.y - r, s.z - r};
  std::array<double, 3> high = {s.x + r, s.y + r, s.z + r};
  return Box(low.data(), high.data(), id);
}

/// The question in numbers of type T.
template <typename T>
struct Sides {
  T distance2;
  T reach2;
};

template <typename T>
Sides<T> sides_of(const octocell_sphere& a, const octocell_sphere& b) {
  const T x = T(double{a.x}) - T(double{b.x});
  const T y = T(double{a.y}) - T(double{b.y});
  const T z = T(double{a.z}) - T(double{b.z});
  const T reach = T(double{a.r}) + T(double{b.r});
  return {x * x + y * y + z * z, reach * reach};
}

bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const auto [distance2, reach2] = sides_of<double>(a, b);
  // The relative error of each side is below 8 * 2^-53.
  const bool is_certain = std::abs(distance2 - reach2) > 1e-14 * (distance2 + reach2);
  if (is_certain) return distance2 < reach2;
  const auto exact = sides_of<CGAL::MP_Float>(a, b);
  return exact.distance2 <= exact.reach2;
}

}  // namespace

int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) boxes.push_back(box_of(spheres[i], i));
  *count = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [=](const Box& a, const Box& b) {
    if (!overlap(spheres[a.info()], spheres[b.info()])) return;
    if (*count < capacity) pairs[*count] = {a.info(), b.info()};
    ++*count;
  });
  return 0;
}
