// SPDX-License-Identifier: MIT
#include "harness/bench/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <thread>
#include <utility>

namespace octocell::bench {
namespace {

/// The order in which the report's waterfall adds them.
constexpr Skip kFromTextToPlan[] = {
    Skip::key_bits, Skip::safe_filter, Skip::equal_radii, Skip::uncertain_pairs,
    Skip::phantoms, Skip::layers,      Skip::wide_cells,  Skip::sort,
    Skip::grid,     Skip::search,      Skip::unchanged,   Skip::few_movers,
    Skip::skin};
static_assert(std::size(kFromTextToPlan) == kSkipCount);

constexpr std::string_view kFastBaselines[] = {"fcl_dynamic_aabb_tree_morton",
                                               "fcl_dynamic_aabb_tree_array_morton", "bullet_dbvt"};
// These sweep along one axis, use one list for all, or put cells in lists: time is quadratic, or
// nearly.
constexpr std::string_view kSlowBaselines[] = {
    "fcl_sap",   "fcl_ssap",          "fcl_interval_tree",    "fcl_spatial_hashing",
    "fcl_naive", "bullet_axis_sweep", "bullet_axis_sweep_32", "bullet_simple"};

bool has_time_for(const Implementation& how, Rows rows) {
  const auto is_among = [&](const auto& names) {
    return std::ranges::find(names, how.backend->name) != std::end(names);
  };
  const bool is_default = how.planned();
  const bool on_device = how.backend->device;
  if (rows == Rows::device_default) return on_device && is_default;
  if (rows == Rows::frames) return is_default && how.backend->skips.has(Skip::unchanged);
  if (rows == Rows::ablation) return !how.is_baseline() && !how.negative_control();
  if (rows == Rows::device) return on_device;
  if (rows == Rows::precision) return is_default;
  if (rows == Rows::error) {
    const bool of_a_library = is_among(kFastBaselines) || how.has_known_issues();
    return how.is_baseline() ? of_a_library : is_default;
  }
  if (rows == Rows::headline) return on_device || is_default;
  if (rows == Rows::fast) {
    const bool home_phantom = how.has_rule() && how.rule == Rule::lowest_cell;
    return how.is_baseline() ? is_among(kFastBaselines) : is_default || home_phantom;
  }
  return rows == Rows::every || !is_among(kSlowBaselines);
}

std::vector<int> thread_counts(const Implementation& how) {
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (!how.backend->threaded || !how.planned() || all == 1) return {1};
  return {1, all};
}

void add_without(std::vector<RowSpec>& rows, RowSpec row, Skip skip) {
  row.skips = fmt::format("no_{}", name_of(skip));
  row.allowed = Skips::all().without(skip);
  rows.push_back(std::move(row));
}

/// Adds a planned row with each skip forbidden alone, with all forbidden, and with the first few
/// allowed: step by step from a pipeline that leaves nothing out to the planned one.
void add_ablation(std::vector<RowSpec>& rows, const RowSpec& planned) {
  const auto add = [&](std::string name, Skips allowed) {
    RowSpec row = planned;
    row.skips = std::move(name);
    row.allowed = allowed;
    rows.push_back(std::move(row));
  };
  const auto counts = [&](Skip skip) {
    return planned.how.backend->skips.has(skip) &&
           (skip < Skip::unchanged || planned.run == Run::dynamic);
  };
  Skips first;
  add("none", first);
  int number = 0;
  for (const Skip skip : kFromTextToPlan) {
    if (!counts(skip)) continue;
    first = first.with(skip);
    add(fmt::format("first_{}_{}", ++number, name_of(skip)), first);
  }
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (counts(skip)) add_without(rows, planned, skip);
  }
}

bool has_predicates(Rows rows) { return rows == Rows::error || rows == Rows::precision; }

/// Returns all implementations that rows can choose from.
std::vector<Implementation> candidates_for(Rows rows, std::string_view backend) {
  std::vector<Implementation> all = implementations(backend);
  if (has_predicates(rows)) std::ranges::copy(other_predicates(backend), std::back_inserter(all));
  return all;
}

/// Returns a planned row whose frames reuse nothing from the last.
RowSpec rebuilt(RowSpec row) {
  row.skips = "rebuilt";
  row.allowed = Skips::all().without(Skip::unchanged).without(Skip::few_movers).without(Skip::skin);
  return row;
}

}  // namespace

std::string row_name(const RowSpec& row, const Group& group) {
  std::string name = fmt::format("find_pairs/backend:{}", row.how.backend->name);
  if (!row.how.is_baseline()) name += fmt::format("/method:{}", row.how.method_name());
  if (row.how.has_rule()) name += fmt::format("/rule:{}", name_of(row.how.rule));
  if (row.how.predicate != Predicate::exact) {
    name += fmt::format("/predicate:{}", name_of(row.how.predicate));
  }
  if (!row.skips.empty()) name += fmt::format("/skips:{}", row.skips);
  return name + fmt::format("/scene:{}/n:{}/threads:{}/run:{}", group.scene, group.n, row.threads,
                            name_of(row.run));
}

std::vector<RowSpec> rows_of(const Group& group, std::string_view backend,
                             const std::regex& filter) {
  std::vector<RowSpec> rows;
  for (const Implementation& how : candidates_for(group.rows, backend)) {
    if (!has_time_for(how, group.rows)) continue;
    if (group.moves() && how.negative_control()) continue;  // its losses do not depend on motion
    if (group.rows == Rows::ablation) {
      rows.push_back({how, 1, group.moves() ? Run::dynamic : Run::warm});
      if (how.planned()) add_ablation(rows, RowSpec(rows.back()));
      continue;
    }
    if (has_predicates(group.rows)) {
      rows.push_back({how, 1, Run::warm});
      const bool exact = how.planned() && how.predicate == Predicate::exact;
      if (exact) add_without(rows, RowSpec(rows.back()), Skip::uncertain_pairs);
      continue;
    }
    if (group.rows == Rows::frames) {
      rows.push_back({how, 1, Run::dynamic});
      rows.push_back(rebuilt(rows.back()));
      continue;
    }
    for (const int threads : thread_counts(how)) {
      if (group.moves()) {
        rows.push_back({how, threads, Run::dynamic});
        continue;
      }
      rows.push_back({how, threads, Run::cold});
      rows.push_back({how, threads, Run::warm});
    }
    if (how.backend->has_device_runs && !group.moves()) {
      for (const Run run : {Run::cold_cache, Run::graph, Run::transfers}) {
        rows.push_back({how, 1, run});
      }
    }
    if (!how.is_baseline() || group.rows == Rows::fast || group.moves()) continue;
    rows.push_back({how, 1, Run::first_update});
    rows.push_back({how, 1, Run::update});
  }
  std::erase_if(
      rows, [&](const RowSpec& row) { return !std::regex_search(row_name(row, group), filter); });
  return rows;
}

}  // namespace octocell::bench
