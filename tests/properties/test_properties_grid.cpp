// SPDX-License-Identifier: MIT
// The grid's claims (docs/exactness.md) for any box of centres, any cell side and any coordinate.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ios>
#include <ostream>

// needs the above
#include <rapidcheck/gtest.h>

#include "core/planner/planner.hpp"
#include "tests/properties/generators.hpp"
#include "tests/properties/oracle.hpp"

namespace octocell {
namespace {

using namespace properties;

/// What a grid is made for.
struct Setting {
  PlanFacts facts;
  double side;
  [[nodiscard]] Grid grid() const { return make_grid(facts, side, widest_box(facts, facts.r_max)); }
};
std::ostream& operator<<(std::ostream& out, const Setting& s) {
  for (int a = 0; a < 3; ++a) {
    out << std::hexfloat << "[" << s.facts.lowest[a] << ", " << s.facts.highest[a] << "] ";
  }
  return out << "r_max " << s.facts.r_max << ", side " << s.side;
}

Setting setting_of(const std::array<float, 6>& ends, float r, int side_exponent, int sixteenths) {
  Setting setting = {.facts = {.sphere_count = 2, .r_max = r, .r_min_nonzero = r}, .side = 0.0};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto [low, high] = std::minmax(ends[2 * a], ends[2 * a + 1]);
    setting.facts.lowest[a] = low;
    setting.facts.highest[a] = high;
  }
  setting.side = std::ldexp(1.0 + sixteenths / 16.0, side_exponent);
  return setting;
}

/// Boxes of like numbers (far from the origin, too) and of any; sides from 2^-160 to 2^150.
Gen<Setting> any_setting() {
  const auto like = gen::mapcat(whole_range<std::uint32_t>(0, 252), [](std::uint32_t exponent) {
    return gen::container<std::array<float, 6>>(float_between(exponent, exponent + 3));
  });
  const auto ends = gen::oneOf(like, gen::container<std::array<float, 6>>(any_float()));
  return gen::apply(setting_of, ends, any_radius(), whole_range(-160, 150), whole_range(0, 16));
}

/// In the box, at its corners, anywhere; or a few ulps from the border of a cell.
float coordinate_in(const Setting& setting, const Grid& grid, float anywhere, int cells, int ulps,
                    int kind) {
  const float low = setting.facts.lowest[0];
  const double border = low + cells * grid.cell_side;
  const double rounded = std::floor(border / grid.cell_side) * grid.cell_side;
  const double chosen = kind == 0 ? anywhere : kind == 1 ? low : kind == 2 ? border : rounded;
  return nudged(static_cast<float>(std::clamp<double>(chosen, -kFloatMax, kFloatMax)), ulps);
}

float pick_coordinate(const Setting& setting, const Grid& grid) {
  return coordinate_in(setting, grid, *any_float(), *whole_range(0, 1000), *whole_range(-4, 5),
                       *whole_range(0, 4));
}

/// 2^-k.
mpq_class units_per_length(const Grid& grid) { return exactly(grid.units_per_length); }

/// The definition of the cell, without the one exception: a negative product that underflows.
std::uint32_t cell_by_definition(const Grid& grid, float x) {
  mpz_class unit = floor_of(exactly(x) * units_per_length(grid));
  const bool underflows = x < 0.0F && x * grid.units_per_length == 0.0F;
  if (underflows) unit = 0;
  unit -= mpz_class(grid.first_unit[0]);
  const mpz_class last(grid.last_unit[0]);
  if (unit < 0) unit = 0;
  if (unit > last) unit = last;
  return static_cast<std::uint32_t>(floor_of(mpq_class(unit, grid.width[0].units)).get_ui());
}

RC_GTEST_PROP(GridProperties, CellsAreWhatTheirDefinitionSays, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  const float x = pick_coordinate(setting, grid);
  RC_ASSERT(cell_coordinate(grid, 0, x) == cell_by_definition(grid, x));
}

RC_GTEST_PROP(GridProperties, CellsAreMonotone, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  const auto [low, high] =
      std::minmax({pick_coordinate(setting, grid), pick_coordinate(setting, grid)});
  RC_ASSERT(cell_coordinate(grid, 0, low) <= cell_coordinate(grid, 0, high));
}

RC_GTEST_PROP(GridProperties, ClaimAValuesApartByCellsDifferByAtMostSoMany, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  const float x = pick_coordinate(setting, grid);
  const double away = x + *whole_range(-3, 4) * grid.cell_side;
  const float near = nudged(static_cast<float>(std::clamp<double>(away, -kFloatMax, kFloatMax)),
                            *whole_range(-3, 4));
  const float y = *gen::element(near, pick_coordinate(setting, grid));
  const mpz_class cells = ceiling_of(gap_along(x, y) / exactly(grid.cell_side));
  const std::int64_t apart =
      std::int64_t{cell_coordinate(grid, 0, x)} - cell_coordinate(grid, 0, y);
  RC_ASSERT(mpz_class(std::abs(apart)) <= cells);
}

RC_GTEST_PROP(GridProperties, ClaimBOverlappingSpheresShareACellOnEveryAxis, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  const Two two = *gen::oneOf(tangent_pair(), tied_pair(), any_pair());
  if (!properties::overlap(two.a, two.b)) RC_DISCARD("apart");
  const CellRange a = cells_met(grid, two.a, two.a.r);
  const CellRange b = cells_met(grid, two.b, two.b.r);
  RC_ASSERT(a.lowest.x <= b.highest.x && b.lowest.x <= a.highest.x);
  RC_ASSERT(a.lowest.y <= b.highest.y && b.lowest.y <= a.highest.y);
  RC_ASSERT(a.lowest.z <= b.highest.z && b.lowest.z <= a.highest.z);
}

RC_GTEST_PROP(GridProperties, SpheresMeetTheirHome, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  const Sphere s = *any_sphere();
  const Cell home = cell_of(grid, s.x, s.y, s.z);
  const CellRange met = cells_met(grid, s, s.r);
  RC_ASSERT(met.lowest.x <= home.x && home.x <= met.highest.x);
  RC_ASSERT(met.lowest.y <= home.y && home.y <= met.highest.y);
  RC_ASSERT(met.lowest.z <= home.z && home.z <= met.highest.z);
}

RC_GTEST_PROP(GridProperties, UnitsAreDividedExactly, ()) {
  const Grid grid = (*any_setting()).grid();
  const auto unit = *whole_range<std::uint64_t>(0, std::uint64_t{1} << 30);
  for (const std::uint64_t u : {unit, unit / grid.width[0].units * grid.width[0].units}) {
    RC_ASSERT(u * grid.width[0].reciprocal >> grid.width[0].reciprocal_bits ==
              u / grid.width[0].units);
  }
}

RC_GTEST_PROP(GridProperties, SidesAreAtLeastWhatWasAskedAndIdsFit, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  const double widest_needed = std::ldexp(256.0, 126);  // no rule needs more
  RC_ASSERT(grid.cell_side >= std::min(setting.side, widest_needed));
  RC_ASSERT(grid.key_bits <= 31);
  const PlanFacts& box = setting.facts;
  const Cell last = cell_of(grid, box.highest[0], box.highest[1], box.highest[2]);
  RC_ASSERT(std::uint64_t{cell_id(grid, last)} < std::uint64_t{1} << grid.key_bits);
  RC_ASSERT(last.x < grid.cell_count[0] && last.y < grid.cell_count[1] &&
            last.z < grid.cell_count[2]);
}

/// Far cells may share an id, cells of one sphere's box may not.
RC_GTEST_PROP(GridProperties, WrappedPeriodsAreTwiceTheWidestBox, ()) {
  const Setting setting = *any_setting();
  const Grid grid = setting.grid();
  RC_CLASSIFY(grid.wraps(), "wraps");
  const double widest = widest_box(setting.facts, setting.facts.r_max);
  for (const std::uint32_t mask : grid.wrap_mask) {
    if (mask == ~0U) continue;
    RC_ASSERT((mask & (mask + 1)) == 0U);
    RC_ASSERT(mask + 1.0 >= 2.0 * (widest / grid.cell_side + 2.0));
  }
}

}  // namespace
}  // namespace octocell
