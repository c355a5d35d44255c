// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/as_written.hpp"
#include "harness/trace/run_trace.hpp"

namespace octocell::trace {
namespace {

using Json = nlohmann::ordered_json;

/// Collects arrays; for those that the run does not have, null and the reason.
class Arrays {
 public:
  template <typename T>
  Json operator()(const std::string& path, const Recorded<T>& recorded) {
    return (*this)(path, recorded, [](const T& item) { return Json(item); });
  }
  template <typename T, typename Convert>
  Json operator()(const std::string& path, const Recorded<T>& recorded, Convert convert) {
    if (!recorded.exists) {
      missing_[path] = recorded.why_not;
      return nullptr;
    }
    Json array = Json::array();
    for (const T& item : recorded.items) array.push_back(convert(item));
    return array;
  }
  [[nodiscard]] const Json& missing() const { return missing_; }

 private:
  Json missing_ = Json::object();
};

Json json_of(Pair pair) { return Json::array({pair.i, pair.j}); }

Json spheres_of(SceneView scene) {
  Json spheres = Json::array();
  for (const Sphere& s : scene.spheres) spheres.push_back(Json::array({s.x, s.y, s.z, s.r}));
  return spheres;
}

Json grid_of(const Grid& grid) {
  Json corner = Json::array();
  Json sides = Json::array();
  Json cells = Json::array();
  Json wraps = Json::array();
  for (int axis = 0; axis < 3; ++axis) {
    const auto unit = static_cast<double>(grid.units_per_length);
    corner.push_back(grid.first_unit[axis] / unit);
    sides.push_back(grid.width[axis].units / unit);
    cells.push_back(grid.period(axis));
    wraps.push_back(grid.wraps(axis));
  }
  return {{"corner", corner}, {"sides", sides}, {"cells", cells}, {"wraps", wraps}};
}

/// The grids of a plan: one of home_phantom and of tiles, one for each level of half_shell.
Json grids_of(const Plan& plan) {
  Json grids = Json::array();
  if (plan.method == Method::half_shell) {
    for (int k = 0; k < plan.levels.count; ++k) {
      const Level& level = plan.levels.level[k];
      Json grid = grid_of(level.grid);
      grid["r_max"] = level.r_max;
      grid["first_id"] = level.first_id;
      grids.push_back(grid);
    }
  } else if (plan.method == Method::tiles) {
    grids.push_back(grid_of(plan.tiles.grid));
  } else if (plan.method == Method::home_phantom && plan.rule == Rule::as_written) {
    // From the origin, without an end; ids repeat as the text's hash does.
    const float side = as_written::cell_side(plan.facts.r_max);
    grids.push_back({{"corner", {0, 0, 0}}, {"sides", {side, side, side}}, {"cells", nullptr}});
  } else if (plan.method == Method::home_phantom) {
    grids.push_back(grid_of(plan.grid));
  }
  return grids;
}

Json plan_of(const RunTrace& trace) {
  const Plan& plan = trace.plan;
  Json skips = Json::array();
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    if (plan.taken.has(static_cast<Skip>(k))) skips.push_back(kSkips[k].name);
  }
  const bool has_rule = plan.method == Method::home_phantom;
  return {{"method", name_of(plan.method)},
          {"rule", has_rule ? Json(name_of(plan.rule)) : Json()},
          {"key_bits", plan.key_bits},
          {"cell_side", trace.cell_side ? Json(*trace.cell_side) : Json()},
          {"grids", grids_of(plan)},
          {"skips", skips}};
}

Json bounds_of(const PlanFacts& facts) {
  return {{"lowest", facts.lowest}, {"highest", facts.highest}, {"r_max", facts.r_max}};
}

Json cell_ids_of(const RunRecord& record, Arrays& arrays) {
  return {{"cell_ids", arrays("stages.cell_ids.cell_ids", record.ids.cell_ids)},
          {"objects", arrays("stages.cell_ids.objects", record.ids.objects)},
          {"control_bits", arrays("stages.cell_ids.control_bits", record.control_bits)}};
}

Json sort_of(const RunRecord& record, Arrays& arrays) {
  const std::vector<std::uint32_t>* before = &record.ids.cell_ids.items;
  const Json passes = arrays("stages.sort.passes", record.passes, [&](const SortPass& pass) {
    const Json json = {{"shift", pass.digit.shift},
                       {"bits", pass.digit.width},
                       {"counts", pass.counts},
                       {"offsets", pass.offsets},
                       {"destinations", destinations(pass, *before)},
                       {"cell_ids", pass.cell_ids},
                       {"objects", pass.objects}};
    before = &pass.cell_ids;
    return json;
  });
  return {{"passes", passes},
          {"cell_ids", arrays("stages.sort.cell_ids", record.sorted.cell_ids)},
          {"objects", arrays("stages.sort.objects", record.sorted.objects)}};
}

Json cell_index_of(const RunRecord& record, Arrays& arrays) {
  const auto cell = [&](const CellEntry& entry) -> Json {
    return {{"cell", record.sorted.cell_ids.items[entry.begin]},
            {"begin", entry.begin},
            {"homes", entry.homes},
            {"phantoms", entry.phantoms}};
  };
  const auto row = [](const ColumnRow& entry) -> Json {
    return {{"first_id", entry.first_id}, {"begin", entry.begin}};
  };
  return {{"cells", arrays("stages.cell_index.cells", record.cells, cell)},
          {"rows", arrays("stages.cell_index.rows", record.rows, row)}};
}

Json pair_tests_of(const RunTrace& trace, Arrays& arrays) {
  const RunRecord& record = trace.record;
  const auto considered = [&](const Considered& c) -> Json {
    const auto [verdict, reason] = decision_on(c, trace);
    return {{"i", c.i}, {"j", c.j}, {"cell", c.cell_id}, {"verdict", verdict}, {"reason", reason}};
  };
  return {{"considered", arrays("stages.pair_tests.considered", record.considered, considered)},
          {"certain", arrays("stages.pair_tests.certain", record.certain, json_of)},
          {"uncertain", arrays("stages.pair_tests.uncertain", record.uncertain, json_of)}};
}

/// Stage 6 appends the uncertain pairs that overlap to the certain ones.
Json resolve_of(const RunTrace& trace, Arrays& arrays) {
  Recorded<Pair> overlapping = trace.record.uncertain;
  std::erase_if(overlapping.items,
                [&](Pair pair) { return !std::ranges::binary_search(trace.pairs, pair); });
  return {{"overlap", arrays("stages.resolve.overlap", overlapping, json_of)}};
}

}  // namespace

nlohmann::ordered_json to_json(const RunTrace& trace) {
  Arrays arrays;
  Json stages = {{"bounds", bounds_of(trace.plan.facts)},
                 {"cell_ids", cell_ids_of(trace.record, arrays)},
                 {"sort", sort_of(trace.record, arrays)},
                 {"cell_index", cell_index_of(trace.record, arrays)},
                 {"pair_tests", pair_tests_of(trace, arrays)},
                 {"resolve", resolve_of(trace, arrays)}};
  Json pairs = Json::array();
  for (const Pair& pair : trace.pairs) pairs.push_back(json_of(pair));
  return {{"schema", 1},
          {"scene", trace.scene},
          {"backend", trace.backend},
          {"spheres", spheres_of(trace.view)},
          {"plan", plan_of(trace)},
          {"stages", std::move(stages)},
          {"pairs", std::move(pairs)},
          {"missing", arrays.missing()}};
}

}  // namespace octocell::trace
