// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/host_device.hpp"
#include "core/sphere.hpp"

namespace octocell {

/// Returns true if each of the four numbers is a whole number of units. `units_per_length` is a
/// power of two, so the products are exact: float64 represents every float32 times any such power.
OCTOCELL_HD bool lies_on_lattice(const Sphere& s, double units_per_length) {
  const auto is_whole = [units_per_length](float value) {
    const double units = static_cast<double>(value) * units_per_length;
    return units == floor(units);
  };
  return is_whole(s.x) && is_whole(s.y) && is_whole(s.z) && is_whole(s.r);
}

}  // namespace octocell
