// SPDX-License-Identifier: MIT
#include "harness/try/stage_arrays.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "core/run_record.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"

namespace octocell::hand_in {
namespace {

octocell_grid as_cubes(const Grid& grid) {
  octocell_grid cubes = {};
  for (int axis = 0; axis < 3; ++axis) {
    cubes.corner[axis] = grid.first_unit[axis] / static_cast<double>(grid.units_per_length);
    cubes.cells[axis] = grid.cell_count[axis];
  }
  cubes.side = grid.cell_side;
  return cubes;
}

Entries copy_of(const RecordedIds& ids) { return {ids.cell_ids.items, ids.objects.items}; }

}  // namespace

std::optional<StageArrays> arrays_of(const Scene& scene) {
  const Implementation how = {.backend = &backend_named("impl_cpu"),
                              .method = Method::home_phantom};
  PlanOptions asked = how.plan_options();
  asked.candidate_limit = 0;  // the arrays before stage 5 are wanted, not the pairs
  float r_max = 0.0F;
  for (const Sphere& s : scene.spheres) r_max = std::max(r_max, s.r);
  if (r_max > 0.0F) asked.cell_side = 2.0 * static_cast<double>(r_max);

  const std::unique_ptr<PairFinder> finder = how.backend->create();
  RunRecord record;
  finder->record(&record);
  const Outcome outcome = find_completely(*finder, scene.view(), asked);
  if (outcome.plan.grid.wraps()) return std::nullopt;
  StageArrays arrays = {.grid = as_cubes(outcome.plan.grid),
                        .key_bits = static_cast<std::uint32_t>(outcome.plan.key_bits),
                        .unsorted = copy_of(record.ids),
                        .sorted = copy_of(record.sorted),
                        .cells = {}};
  for (const CellEntry& c : record.cells.items)
    arrays.cells.push_back({c.begin, c.homes, c.phantoms});
  return arrays;
}

StageArrays random_keys(std::size_t n, std::uint32_t bits, std::size_t seed) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(seed * 33 + bits));
  StageArrays arrays;
  arrays.key_bits = bits;
  for (std::size_t k = 0; k < n; ++k) {
    const auto key = static_cast<std::uint32_t>(random());
    arrays.unsorted.ids.push_back(bits == 0 ? 0 : key >> (32 - bits));
    const auto control_bits = static_cast<std::uint32_t>(random()) & ~OCTOCELL_SPHERE;
    arrays.unsorted.objects.push_back(static_cast<std::uint32_t>(k) | control_bits);
  }
  arrays.sorted = stably_sorted(arrays.unsorted);
  return arrays;
}

Entries stably_sorted(const Entries& entries, std::uint32_t mask) {
  std::vector<std::size_t> order(entries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return entries.ids[k] & mask; });
  Entries sorted;
  for (const std::size_t k : order) {
    sorted.ids.push_back(entries.ids[k]);
    sorted.objects.push_back(entries.objects[k]);
  }
  return sorted;
}

}  // namespace octocell::hand_in
