// SPDX-License-Identifier: MIT
#include "core/planner/crowding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/planner/sampled_cells.hpp"

namespace octocell {
namespace {

/// Returns how many rows hold spheres. Assumes an even spread. If most ids stand for empty space,
/// uses the sample instead: the number of rows at which an even spread would put as many of its
/// pairs into the same row.
double filled_rows(const Level& level, const Members& members) {
  constexpr std::uint64_t kEnough = 20;
  const Grid& grid = level.grid;
  const auto filled = [&](double rows) { return rows * (1.0 - std::exp(-members.count / rows)); };
  const double evenly = filled(rows_of_cells(grid));
  if (!grid.wraps()) return evenly;
  const SampledCells sampled(grid, members.sample, ~0U);  // all columns are one cell
  const auto pairs = static_cast<double>(sampled.pairs_in_blocks(0));
  const auto size = static_cast<double>(members.sample.size());
  return pairs < kEnough ? evenly : std::min(evenly, filled(size * size / 2.0 / pairs));
}

}  // namespace

Members members_of(const SceneStats& stats, Octaves octaves) {
  Members members;
  for (std::size_t k = octaves.first; k < octaves.second; ++k) {
    members.count += static_cast<double>(stats.radii[k].count);
    members.radius_sum += stats.radii[k].radius_sum;
    members.r_max = stats.radii[k].largest;
  }
  const float above = octaves.first == 0 ? -1.0F : stats.radii[octaves.first - 1].largest;
  for (const Sphere& s : stats.sample) {
    if (s.r > above && s.r <= members.r_max) members.sample.push_back(s);
  }
  return members;
}

std::uint32_t columns_per_cell(const Grid& grid) {
  const std::uint32_t columns =
      (grid.width[1].units + grid.width[0].units - 1) / grid.width[0].units;
  return std::min(columns, grid.cell_count[0]);
}

/// Returns how many spheres of the level lie in a cell around one of them, by an even spread or by
/// the sample, whichever is more. A cell of the small sample holds few, so the sample is counted in
/// blocks of cells, the smallest blocks in which enough of its spheres meet.
double neighbours_in_cell(const Level& level, const Members& members) {
  constexpr std::uint64_t kEnough = 100;
  const Grid& grid = level.grid;
  const std::uint32_t columns = columns_per_cell(grid);
  const double cells_there = std::max(static_cast<double>(level.ids) / columns, 1.0);
  const double evenly = members.count / cells_there;
  const auto size = static_cast<double>(members.sample.size());
  const std::uint32_t cells[3] = {grid.cell_count[0] / columns + 1, grid.cell_count[1],
                                  grid.cell_count[2]};
  const std::uint32_t most = std::max({cells[0], cells[1], cells[2]});
  const SampledCells sampled(grid, members.sample, columns);
  for (int shift = 0; size > 1 && most >> shift != 0; ++shift) {
    const std::uint64_t pairs = sampled.pairs_in_blocks(shift);
    if (pairs < kEnough) continue;
    double block = 1.0;  // cells
    for (const std::uint32_t n : cells) block *= std::min<double>(n, std::ldexp(1.0, shift));
    return std::max(evenly, 2.0 * static_cast<double>(pairs) / size * members.count / size / block);
  }
  return evenly;
}

Crowding crowding_of(const Level& level, const Members& members) {
  return {neighbours_in_cell(level, members), filled_rows(level, members)};
}

}  // namespace octocell
