// SPDX-License-Identifier: MIT
// Decisions on float64 numbers: by float64 arithmetic if its rounding cannot matter, else by
// integers of as many bits as it takes.
//
// Wide radii. Rounding moves the centre of i by at most m_i, the sum over its axes, and changes its
// radius by d_i. If the float64 spheres i and j overlap, then the rounded centres are at most
// (r_i + m_i) + (r_j + m_j) apart. If the rounded ones overlap, r_i + d_i does. So radii of
// r_i + m_i + d_i, rounded up, keep every pair of both kinds.
#include "python/native/exact64.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>
#include <optional>

namespace octocell::python {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// |p - q| is compared with the limit, which is the sum of two numbers.
struct Question {
  std::array<double, 3> p;
  std::array<double, 3> q;
  std::array<double, 2> limit;
};

/// Returns how distance^2 compares with limit^2, if float64 arithmetic is sure of it. Each side
/// carries at most 8 roundings of 2^-53, as long as it is far from underflow.
std::optional<std::strong_ordering> by_float64(const Question& question) {
  double distance2 = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = question.p[axis] - question.q[axis];
    distance2 += d * d;
  }
  const double limit = question.limit[0] + question.limit[1];
  const double limit2 = limit * limit;
  const double bound = 0x1p-48 * (distance2 + limit2);
  if (!(bound > 0x1p-900)) return {};
  if (distance2 - limit2 > bound) return std::strong_ordering::greater;
  if (limit2 - distance2 > bound) return std::strong_ordering::less;
  return {};
}

/// Returns value / 2^unit as an integer.
Integer scaled(double value, int unit) {
  if (value == 0) return 0;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);  // 53 bits behind the point
  const auto significand = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int shift = exponent - 53 - unit;
  // Below 2^-1022 a float64 has trailing zeros here; the shift to the right loses none of its bits.
  return shift >= 0 ? Integer(significand) << shift : Integer(significand >> -shift);
}

/// Does the same with integers. All float64 numbers are multiples of 2^-1074.
std::strong_ordering by_integers(const Question& question) {
  double smallest = std::numeric_limits<double>::max();
  const auto look_at = [&](double value) {
    if (value != 0) smallest = std::min(smallest, std::abs(value));
  };
  std::ranges::for_each(question.p, look_at);
  std::ranges::for_each(question.q, look_at);
  std::ranges::for_each(question.limit, look_at);
  const int unit = std::max(std::ilogb(smallest) - 52, -1074);
  Integer distance2 = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Integer d = scaled(question.p[axis], unit) - scaled(question.q[axis], unit);
    distance2 += d * d;
  }
  const Integer limit = scaled(question.limit[0], unit) + scaled(question.limit[1], unit);
  const int order = distance2.compare(limit * limit);
  return order <=> 0;
}

std::strong_ordering compare(const Question& question) {
  const auto sure = by_float64(question);
  return sure ? *sure : by_integers(question);
}

bool overlap(const Sphere64& a, const Sphere64& b) {
  return compare({{a.x, a.y, a.z}, {b.x, b.y, b.z}, {a.r, b.r}}) <= 0;
}

Sphere nearest(const Sphere64& s) {
  return {static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z),
          static_cast<float>(s.r)};
}

float next_up(float value) { return std::nextafter(value, std::numeric_limits<float>::infinity()); }

/// The differences are exact: a float64 and its nearest float32 share a grid of few enough steps.
float wide_radius(const Sphere64& s, const Sphere& to) {
  const double change =
      std::abs(s.x - to.x) + std::abs(s.y - to.y) + std::abs(s.z - to.z) + std::abs(s.r - to.r);
  if (change == 0) return to.r;
  return next_up(next_up(static_cast<float>(s.r + change)));
}

void require_valid(const Sphere64& s, const Sphere& to, std::size_t index) {
  const bool valid =
      std::isfinite(to.x) && std::isfinite(to.y) && std::isfinite(to.z) && std::isfinite(to.r);
  if (valid && s.r >= 0) return;
  throw Error(fmt::format("sphere {}: x={} y={} z={} r={}; all four must be finite as float32 and "
                          "r >= 0",
                          index, s.x, s.y, s.z, s.r),
              ErrorKind::invalid_sphere, index);
}

}  // namespace

Rounded rounded(std::span<const Sphere64> spheres) {
  Rounded result;
  result.nearest.reserve(spheres.size());
  result.wide.reserve(spheres.size());
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const Sphere to = nearest(spheres[k]);
    require_valid(spheres[k], to, k);
    result.nearest.push_back(to);
    const float wide = wide_radius(spheres[k], to);
    if (!std::isfinite(wide))
      throw Error("a radius is too large to be rounded", ErrorKind::limit, k);
    result.wide.push_back({to.x, to.y, to.z, wide});
  }
  return result;
}

Changed changed(std::span<const Sphere64> spheres, std::span<const Pair> found,
                std::span<const Pair> wide) {
  Changed result;
  auto next = found.begin();
  for (const Pair& pair : wide) {
    const bool is_found = next != found.end() && *next == pair;
    if (is_found) ++next;
    const bool before = overlap(spheres[pair.i], spheres[pair.j]);
    if (before && !is_found) ++result.lost;
    if (!before && is_found) ++result.gained;
  }
  return result;
}

void near(std::span<const Point64> points, std::span<const Pair> pairs,
          std::span<const double> limits, bool strict, std::span<bool> result) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Point64& p = points[pairs[k].i];
    const Point64& q = points[pairs[k].j];
    const double limit = limits[limits.size() == 1 ? 0 : k];
    const auto order = compare({{p.x, p.y, p.z}, {q.x, q.y, q.z}, {limit, 0}});
    result[k] = limit >= 0 && (strict ? order < 0 : order <= 0);
  }
}

}  // namespace octocell::python
