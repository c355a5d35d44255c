// SPDX-License-Identifier: MIT
// Computes depths from integers: the square root of |p - q|^2 gets kFraction binary places more
// than the unit 2^-149, and the code knows whether anything was cut off.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "harness/verify/reference/big_numbers.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {
namespace {

constexpr unsigned kFraction = 96;  // binary places
constexpr int kUnit = -149 - static_cast<int>(kFraction);
constexpr std::size_t kSignificand = 24;  // bits of a float32

/// |r_p + r_q - |p - q|| lies in [magnitude, magnitude + 1) units of 2^kUnit.
struct Depth {
  bool negative;
  mpz_class magnitude;
  bool exact;  // true if it is exactly `magnitude`
};

Depth exact_depth(const Sphere& a, const Sphere& b) {
  const Sides sides = sides_of(a, b);
  const mpz_class square = sides.distance2 << (2 * kFraction);
  mpz_class distance;
  mpz_class rest;
  mpz_sqrtrem(distance.get_mpz_t(), rest.get_mpz_t(), square.get_mpz_t());
  const bool exact = rest == 0;
  const mpz_class radius_sum = sides.radius_sum << kFraction;
  if (radius_sum <= distance)
    return {radius_sum != distance || !exact, distance - radius_sum, exact};
  return {false, radius_sum - distance - (exact ? 0 : 1), exact};
}

/// Returns how many binary places lie below a unit in the last place of the float32 next to it.
std::size_t places_below_ulp(const mpz_class& magnitude) {
  const std::size_t bits = mpz_sizeinbase(magnitude.get_mpz_t(), 2);
  return std::max<std::size_t>(bits, kSignificand + kFraction) - kSignificand;
}

float rounded(const Depth& depth) {
  const std::size_t places = places_below_ulp(depth.magnitude);
  mpz_class whole = depth.magnitude >> places;
  const mpz_class rest = depth.magnitude - (whole << places);
  const mpz_class half = mpz_class(1) << (places - 1);
  const bool is_odd = mpz_odd_p(whole.get_mpz_t()) != 0;
  if (rest > half || (rest == half && (!depth.exact || is_odd))) ++whole;
  const double value = std::ldexp(whole.get_d(), kUnit + static_cast<int>(places));
  return static_cast<float>(depth.negative ? -value : value);
}

double error_ulp(float claimed, const Depth& depth) {
  if (!std::isfinite(claimed)) {
    return claimed == rounded(depth) ? 0.0 : std::numeric_limits<double>::infinity();
  }
  const mpz_class magnitude = depth.negative ? mpz_class(-depth.magnitude) : depth.magnitude;
  const mpz_class error = (exactly(claimed) << kFraction) - magnitude;
  const auto places = static_cast<int>(places_below_ulp(depth.magnitude));
  return std::ldexp(std::fabs(error.get_d()), -places);
}

/// Returns the smallest value that the given share of the values does not exceed.
double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace

float depth(const Sphere& a, const Sphere& b) { return rounded(exact_depth(a, b)); }

double depth_error_ulp(float claimed, const Sphere& a, const Sphere& b) {
  return error_ulp(claimed, exact_depth(a, b));
}

double relative_depth(const Sphere& a, const Sphere& b) {
  const auto [radius_sum, distance2] = sides_of(a, b);
  const mpz_class difference = radius_sum * radius_sum - distance2;
  if (difference == 0) return 0.0;
  if (radius_sum == 0) return std::numeric_limits<double>::lowest();
  const double s = radius_sum.get_d();
  return difference.get_d() / (s * (s + std::sqrt(distance2.get_d())));
}

DepthErrors depth_errors(std::span<const float> depths, std::span<const Pair> pairs,
                         std::span<const Sphere> spheres) {
  DepthErrors errors;
  std::vector<double> ulps;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Depth truth = exact_depth(spheres[pairs[k].i], spheres[pairs[k].j]);
    ulps.push_back(error_ulp(depths[k], truth));
    if (depths[k] != rounded(truth)) ++errors.not_nearest;
  }
  std::ranges::sort(ulps);
  errors.median_ulp = quantile(ulps, 0.5);
  errors.p99_ulp = quantile(ulps, 0.99);
  errors.max_ulp = quantile(ulps, 1.0);
  return errors;
}

}  // namespace octocell::reference
