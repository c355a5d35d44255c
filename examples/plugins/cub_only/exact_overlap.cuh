// SPDX-License-Identifier: MIT
// Do two spheres overlap over the real numbers? Float64 decides if that is certain; otherwise the
// sign of an exact sum does (Shewchuk, "Adaptive Precision Floating-Point Arithmetic", 1997).
#pragma once

#include "octocell_plugin.h"

/// a + b = sum + error, exactly. Intrinsics are never fused with a multiplication.
__device__ inline double exact_sum(double a, double b, double& error) {
  const double sum = __dadd_rn(a, b);
  const double part = __dsub_rn(sum, a);
  error = __dadd_rn(__dsub_rn(a, __dsub_rn(sum, part)), __dsub_rn(b, part));
  return sum;
}

/// A sum of doubles without rounding: `size` parts that do not overlap, the smallest first.
struct ExactSum {
  double parts[24];
  int size = 0;

  __device__ void add(double value) {
    int kept = 0;
    for (int k = 0; k < size; ++k) {
      double error;
      value = exact_sum(value, parts[k], error);
      if (error != 0.0) parts[kept++] = error;
    }
    if (value != 0.0) parts[kept++] = value;
    size = kept;
  }
  /// Adds sign * a * b. Float32 numbers are multiples of 2^-149, so no part underflows.
  __device__ void add_product(double sign, double a, double b) {
    const double product = __dmul_rn(a, b);
    add(sign * product);
    add(sign * __fma_rn(a, b, -product));
  }
  /// Adds sign * (a + b)^2.
  __device__ void add_square_of_sum(double sign, double a, double b) {
    double low;
    const double high = exact_sum(a, b, low);
    add_product(sign, high, high);
    add_product(2.0 * sign, high, low);
    add_product(sign, low, low);
  }
  /// The largest part has the sign of the sum.
  __device__ bool is_at_most_zero() const { return size == 0 || parts[size - 1] < 0.0; }
};

__device__ inline bool overlap(const octocell_sphere& a, const octocell_sphere& b) {
  const double x = double(a.x) - b.x;
  const double y = double(a.y) - b.y;
  const double z = double(a.z) - b.z;
  const double reach = double(a.r) + b.r;
  const double distance2 = x * x + y * y + z * z;
  const double reach2 = reach * reach;
  // The relative error of each side is below 8 * 2^-53.
  if (fabs(distance2 - reach2) > 1e-14 * (distance2 + reach2)) return distance2 < reach2;
  ExactSum difference;
  difference.add_square_of_sum(1.0, a.x, -double(b.x));
  difference.add_square_of_sum(1.0, a.y, -double(b.y));
  difference.add_square_of_sum(1.0, a.z, -double(b.z));
  difference.add_square_of_sum(-1.0, a.r, b.r);
  return difference.is_at_most_zero();
}
