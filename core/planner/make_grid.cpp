// SPDX-License-Identifier: MIT
// Source of the formula: fixed-point cells, docs/exactness.md, "The grid".
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/planner/planner.hpp"

namespace octocell {
namespace {

constexpr int kMinUnitExponent = -126;  // 2^126, its inverse, is a finite float
constexpr int kMaxUnitExponent = 126;

/// Returns the smallest e with value < 2^e.
int exponent_above(double value) { return value > 0.0 ? std::ilogb(value) + 1 : -1100; }

/// Returns k: fine enough for the cell side (7 bits), coarse enough for the range and the
/// magnitude.
int unit_exponent(const PlanFacts& facts, double cell_side) {
  int k = exponent_above(cell_side) - 8;
  for (int a = 0; a < 3; ++a) {
    const double extent = static_cast<double>(facts.highest[a]) - facts.lowest[a];
    const double magnitude = std::max(std::fabs(static_cast<double>(facts.highest[a])),
                                      std::fabs(static_cast<double>(facts.lowest[a])));
    // + 1: two floors may differ by one more than the values.
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

/// Gives each axis its bits; the longest axis loses bits until all fit.
void number_cells(Grid& grid, int most_bits) {
  int bits[3];
  for (int a = 0; a < 3; ++a) bits[a] = static_cast<int>(std::bit_width(grid.cell_count[a] - 1));
  std::uint64_t period[3] = {grid.cell_count[0], grid.cell_count[1], grid.cell_count[2]};
  const auto too_many = [&] { return period[0] * period[1] > (1ULL << most_bits) / period[2]; };
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

/// Returns true if every wrapped axis has a period of at least `cells`.
bool periods_have(const Grid& grid, const double (&cells)[3]) {
  for (int a = 0; a < 3; ++a) {
    const std::uint32_t mask = grid.wrap_mask[a];
    if (mask != ~0U && cells[a] > static_cast<double>(mask) + 1.0) return false;
  }
  return true;
}

/// Makes a grid with units of 2^k. `columns` says how many columns a cell is cut into along x.
Grid grid_with_unit(const PlanFacts& facts, int k, double cell_side, std::uint32_t columns,
                    int most_bits) {
  Grid grid;
  const double unit = std::ldexp(1.0, k);
  grid.units_per_length = std::ldexp(1.0F, -k);
  // cell_side / unit is exact: unit is a power of two.
  const auto units = static_cast<std::uint32_t>(
      std::clamp(std::ceil(cell_side / unit), 1.0, double{kMaxUnitsPerCell}));
  grid.width[0] = cell_width((units + columns - 1) / columns);
  grid.width[1] = grid.width[2] = cell_width(units);
  grid.cell_side = units * unit;
  place_axes(grid, facts);
  number_cells(grid, most_bits);
  return grid;
}

}  // namespace

CellWidth cell_width(std::uint32_t units) {
  CellWidth width;
  width.units = units;
  width.reciprocal_bits = kReciprocalBits + static_cast<int>(std::bit_width(units - 1));
  width.reciprocal = ((std::uint64_t{1} << width.reciprocal_bits) + units - 1) / units;
  return width;
}

double farthest_ulp(const PlanFacts& facts, float extent) {
  float farthest = 0.0F;
  for (int a = 0; a < 3; ++a) {
    farthest = std::max(
        {farthest, std::fabs(facts.lowest[a] - extent), std::fabs(facts.highest[a] + extent)});
  }
  farthest = std::min(farthest, std::nextafter(kFloatMax, 0.0F));
  return static_cast<double>(std::nextafter(farthest, kFloatMax)) - farthest;
}

double widest_box(const PlanFacts& facts, float extent) {
  return 2.0 * extent + farthest_ulp(facts, extent);
}

Grid make_grid(const PlanFacts& facts, double cell_side, double widest) {
  for (double side = cell_side;; side *= 2.0) {
    const Grid grid = grid_with_unit(facts, unit_exponent(facts, side), side, 1, kMaxKeyBits);
    const double period = 2.0 * (widest / grid.cell_side + 2.0);
    const double periods[3] = {period, period, period};
    if (periods_have(grid, periods)) return grid;
    side = std::max(side, grid.cell_side);
  }
}

Level make_level(const PlanFacts& facts, float r_max, double cell_side, std::uint32_t columns,
                 int most_bits) {
  const double least = std::max(2.0 * static_cast<double>(r_max), 0x1p-149);
  const double side = std::max(cell_side, least);
  Level level;
  level.r_max = r_max;
  level.grid = grid_with_unit(facts, unit_exponent(facts, side), side, columns, most_bits);
  const Grid& grid = level.grid;
  const std::uint32_t column_units = grid.width[0].units;
  const auto diameter_units = static_cast<std::uint32_t>(std::ceil(least * grid.units_per_length));
  level.column_reach = (diameter_units + column_units - 1) / column_units;
  level.ids = 1;
  for (int a = 0; a < 3; ++a) level.ids *= grid.period(a);
  return level;
}

}  // namespace octocell
