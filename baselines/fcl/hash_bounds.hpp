// SPDX-License-Identifier: MIT
// The cells of FCL's spatial hash: a box and a cell side that never change.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/sphere.hpp"

namespace octocell::baselines {

/// If cells begin where the scene's box begins, their borders lie where regular data has its own,
/// and boxes that touch there share no cell.
enum class HashCells : bool { apart_from_data, aligned_with_data };

struct HashBounds {
  double cell = 1.0;
  double lowest[3] = {0, 0, 0};
  double highest[3] = {0, 0, 0};

  /// Makes cells of two largest radii, around the boxes of all spheres, with room to move.
  HashBounds(std::span<const Sphere> spheres, HashCells cells) {
    if (spheres.empty()) return;
    float r_max = 0.0F;
    for (const Sphere& s : spheres) r_max = std::max(r_max, s.r);
    std::fill_n(lowest, 3, std::numeric_limits<double>::max());
    std::fill_n(highest, 3, std::numeric_limits<double>::lowest());
    for (const Sphere& s : spheres) {
      const double centre[3] = {s.x, s.y, s.z};
      for (int k = 0; k < 3; ++k) {
        lowest[k] = std::min(lowest[k], centre[k] - s.r);
        highest[k] = std::max(highest[k], centre[k] + s.r);
      }
    }
    cell = r_max > 0.0F ? 2.0 * r_max : cell_of_points(spheres.size());
    if (cells == HashCells::apart_from_data) make_room();
  }

  [[nodiscard]] bool hold(const Sphere& s) const {
    const double centre[3] = {s.x, s.y, s.z};
    for (int k = 0; k < 3; ++k) {
      if (centre[k] - s.r < lowest[k] || centre[k] + s.r > highest[k]) return false;
    }
    return 2.0 * s.r <= cell;
  }

  [[nodiscard]] double cells_along(int axis) const { return (highest[axis] - lowest[axis]) / cell; }
  [[nodiscard]] double most_cells() const {
    return std::max({cells_along(0), cells_along(1), cells_along(2)});
  }

  /// Returns how many pairs of entries meet in a cell. In a scene of a few giants, that is nearly
  /// all.
  [[nodiscard]] std::uint64_t pairs_in_cells(std::span<const Sphere> spheres) const {
    std::vector<std::uint64_t> keys;
    keys.reserve(spheres.size());
    for (const Sphere& s : spheres) keys.push_back(key(s));
    std::sort(keys.begin(), keys.end());
    std::uint64_t pairs = 0;
    std::uint64_t run = 0;
    for (std::size_t i = 1; i < keys.size(); ++i) {
      run = keys[i] == keys[i - 1] ? run + 1 : 0;
      pairs += run;
    }
    return pairs;
  }

 private:
  // Points have no radius that could give the cell side; this puts about one of them into a cell.
  [[nodiscard]] double cell_of_points(std::size_t count) const {
    double side = 0.0;
    for (int k = 0; k < 3; ++k) side = std::max(side, highest[k] - lowest[k]);
    return side > 0.0 ? side / std::cbrt(static_cast<double>(count)) : 1.0;
  }

  // Shifts the borders by a fraction of a cell that no float32 coordinate has, and adds an eighth
  // of the box to move in.
  void make_room() {
    constexpr double kApart = 0.61803398874989485;
    for (int k = 0; k < 3; ++k) {
      const double room = std::ceil(cells_along(k) / 8.0) + kApart;
      lowest[k] -= room * cell;
      highest[k] += room * cell;
    }
  }

  [[nodiscard]] std::uint64_t key(const Sphere& s) const {
    const double centre[3] = {s.x, s.y, s.z};
    std::uint64_t mixed = 0;
    for (int k = 0; k < 3; ++k) {
      const auto place = static_cast<std::int64_t>((centre[k] - lowest[k]) / cell);
      mixed = (mixed ^ static_cast<std::uint64_t>(place)) * 0x9e3779b97f4a7c15u;
    }
    return mixed;
  }
};

}  // namespace octocell::baselines
