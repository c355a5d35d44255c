// SPDX-License-Identifier: MIT
#include "core/images/periodic_box.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace octocell {
namespace {

constexpr double kUnit = 0x1p-53;  // U, half a unit in the last place of 1
constexpr char kNames[] = "abc";

double dot(const double (&u)[3], const double (&v)[3]) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// Writes the cross product of u and v, divided by `by`.
void cross(const double (&u)[3], const double (&v)[3], double by, double (&to)[3]) {
  to[0] = (u[1] * v[2] - u[2] * v[1]) / by;
  to[1] = (u[2] * v[0] - u[0] * v[2]) / by;
  to[2] = (u[0] * v[1] - u[1] * v[0]) / by;
}

void to_unit_length(double (&v)[3]) {
  const double length = std::sqrt(dot(v, v));
  for (double& x : v) x /= length;
}

void require_finite(const Box& box) {
  for (int a = 0; a < 3; ++a) {
    const auto& v = box.vector[a];
    if (!box.periodic[a] || (std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]))) {
      continue;
    }
    throw InputError(fmt::format("box: vector {} is ({}, {}, {}); its numbers must be finite",
                                 kNames[a], v[0], v[1], v[2]));
  }
}

/// Sets h[a] for an axis that does not repeat, across those that are set: h[b], and h[c] if `both`.
void complete(double (&h)[3][3], int a, int b, int c, bool both) {
  if (both) {
    cross(h[b], h[c], 1.0, h[a]);
  } else {
    double least[3] = {0, 0, 0};  // the axis of space that is farthest from h[b]
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::abs(h[b][k]) < std::abs(h[b][axis])) axis = k;
    }
    least[axis] = 1.0;
    cross(h[b], least, 1.0, h[a]);
  }
  to_unit_length(h[a]);
}

void complete_axes(PeriodicBox& box) {
  int periodic[3];
  int others[3];
  int n = 0;
  int m = 0;
  for (int a = 0; a < 3; ++a) (box.periodic[a] ? periodic[n++] : others[m++]) = a;
  if (n == 0) {
    for (int a = 0; a < 3; ++a) box.h[a][a] = 1.0;
  } else if (n == 1) {
    complete(box.h, others[0], periodic[0], 0, false);
    complete(box.h, others[1], periodic[0], others[0], true);
  } else if (n == 2) {
    complete(box.h, others[0], periodic[0], periodic[1], true);
  }
}

/// Returns an upper bound on the sum of |g[a] . h[b] - (a == b)| over the periodic axes b.
double skew_of(const PeriodicBox& box, int a) {
  double sum = 0.0;
  for (int b = 0; b < 3; ++b) {
    if (!box.periodic[b]) continue;
    double size = 0.0;
    for (int k = 0; k < 3; ++k) size += std::abs(box.g[a][k] * box.h[b][k]);
    const double off = std::abs(dot(box.g[a], box.h[b]) - (a == b ? 1.0 : 0.0));
    sum += off + 8.0 * kUnit * (size + 1.0);
  }
  return sum * (1.0 + 8.0 * kUnit);
}

}  // namespace

PeriodicBox prepare(const Box& given) {
  require_finite(given);
  PeriodicBox box = {};
  for (int a = 0; a < 3; ++a) {
    box.periodic[a] = given.periodic[a];
    if (!given.periodic[a]) continue;
    for (int k = 0; k < 3; ++k) box.h[a][k] = given.vector[a][k];
  }
  complete_axes(box);
  double normal[3];
  cross(box.h[1], box.h[2], 1.0, normal);
  const double volume = dot(box.h[0], normal);
  box.volume = std::abs(volume);
  for (int a = 0; a < 3; ++a) {
    cross(box.h[(a + 1) % 3], box.h[(a + 2) % 3], volume, box.g[a]);
    box.g_length[a] = std::sqrt(dot(box.g[a], box.g[a])) * (1.0 + 8.0 * kUnit);
    box.skew[a] = skew_of(box, a);
    if (box.periodic[a] && !(box.skew[a] <= 0.25)) {
      throw InputError(
          "box: its periodic vectors are zero, or lie in one plane or on one line, or nearly so");
    }
  }
  return box;
}

}  // namespace octocell
