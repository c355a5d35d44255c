// SPDX-License-Identifier: MIT
// Source of the formula: fixed-point cells, docs/exactness.md, "The grid".
#include <algorithm>
#include <bit>
#include <cmath>

#include "harness/planner/planner.hpp"

namespace octocell {
namespace {

constexpr int kMaxKeyBits = 31;
constexpr int kMinUnitExponent = -126;  // 2^126, its inverse, is a finite float
constexpr int kMaxUnitExponent = 126;

/// Smallest e with value < 2^e.
int exponent_above(double value) { return value > 0.0 ? std::ilogb(value) + 1 : -1100; }

/// k: as fine as the cell side asks for (7 bits), as coarse as range and magnitude need.
int unit_exponent(const PlanFacts& facts, double cell_side) {
  int k = exponent_above(cell_side) - 8;
  for (int a = 0; a < 3; ++a) {
    const double extent = static_cast<double>(facts.highest[a]) - facts.lowest[a];
    const double magnitude = std::max(std::fabs(static_cast<double>(facts.highest[a])),
                                      std::fabs(static_cast<double>(facts.lowest[a])));
    // + 1: two floors may be one further apart than the values.
    k = std::max({k, exponent_above(extent) + 1 - 30, exponent_above(magnitude) - 62});
  }
  return std::clamp(k, kMinUnitExponent, kMaxUnitExponent);
}

void place_axes(Grid& grid, const PlanFacts& facts) {
  for (int a = 0; a < 3; ++a) {
    grid.first_unit[a] = std::floor(facts.lowest[a] * grid.units_per_length);
    const double last = std::floor(facts.highest[a] * grid.units_per_length);
    grid.last_unit[a] = std::min(last - grid.first_unit[a], kMaxUnits);
    grid.cell_count[a] = cell_coordinate(grid, a, facts.highest[a]) + 1;
  }
}

/// Bits for each axis; the longest axes give way until all fit.
void number_cells(Grid& grid) {
  int bits[3];
  for (int a = 0; a < 3; ++a) bits[a] = static_cast<int>(std::bit_width(grid.cell_count[a] - 1));
  std::uint64_t period[3] = {grid.cell_count[0], grid.cell_count[1], grid.cell_count[2]};
  const auto too_many = [&] { return period[0] * period[1] > (1ULL << kMaxKeyBits) / period[2]; };
  while (too_many()) {
    const int longest = static_cast<int>(std::max_element(bits, bits + 3) - bits);
    --bits[longest];
    period[longest] = std::uint64_t{1} << bits[longest];
    grid.wrap_mask[longest] = static_cast<std::uint32_t>(period[longest] - 1);
  }
  grid.stride_y = static_cast<std::uint32_t>(period[0]);
  grid.stride_z = static_cast<std::uint32_t>(period[0] * period[1]);
  grid.key_bits = static_cast<int>(std::bit_width(period[0] * period[1] * period[2] - 1));
}

bool periods_are_wide_enough(const Grid& grid, double widest) {
  for (const std::uint32_t mask : grid.wrap_mask) {
    if (mask != ~0U && 2.0 * (widest / grid.cell_side + 2.0) > static_cast<double>(mask) + 1.0)
      return false;
  }
  return true;
}

Grid grid_with_unit(const PlanFacts& facts, int k, double cell_side) {
  Grid grid;
  const double unit = std::ldexp(1.0, k);
  grid.units_per_length = std::ldexp(1.0F, -k);
  // cell_side / unit is exact: unit is a power of two.
  const double units = std::clamp(std::ceil(cell_side / unit), 1.0, double{kMaxUnitsPerCell});
  grid.units_per_cell = static_cast<std::uint32_t>(units);
  grid.reciprocal_bits =
      kReciprocalBits + static_cast<int>(std::bit_width(grid.units_per_cell - 1));
  grid.cells_per_unit =
      ((std::uint64_t{1} << grid.reciprocal_bits) + grid.units_per_cell - 1) / grid.units_per_cell;
  grid.cell_side = units * unit;
  place_axes(grid, facts);
  number_cells(grid);
  return grid;
}

}  // namespace

double farthest_ulp(const PlanFacts& facts, float reach) {
  float farthest = 0.0F;
  for (int a = 0; a < 3; ++a) {
    farthest = std::max(
        {farthest, std::fabs(facts.lowest[a] - reach), std::fabs(facts.highest[a] + reach)});
  }
  farthest = std::min(farthest, std::nextafter(kFloatMax, 0.0F));
  return static_cast<double>(std::nextafter(farthest, kFloatMax)) - farthest;
}

double widest_box(const PlanFacts& facts, float reach) {
  return 2.0 * reach + farthest_ulp(facts, reach);
}

Grid make_grid(const PlanFacts& facts, double cell_side, double widest) {
  for (double side = cell_side;; side *= 2.0) {
    const Grid grid = grid_with_unit(facts, unit_exponent(facts, side), side);
    if (periods_are_wide_enough(grid, widest)) return grid;
    side = std::max(side, grid.cell_side);
  }
}

}  // namespace octocell
