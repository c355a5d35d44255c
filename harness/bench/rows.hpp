// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "harness/bench/groups.hpp"
#include "harness/engine/registry.hpp"

namespace octocell::bench {

/// What a measurement starts from.
enum class Run : std::uint8_t {
  cold,          // nothing: create, plan, allocate, find; freed memory was given back to the system
  warm,          // buffers and objects stand and were touched; everything is found again
  cold_cache,    // devices: as warm, but the device's cache holds neither scene nor buffers
  graph,         // devices: as warm, all stages recorded once and replayed as one graph
  transfers,     // devices: as warm, and the spheres come from the host, and the pairs go there
  first_update,  // baselines: as update, the first after the structure was built
  update,        // baselines: the structure stands, every sphere is announced again, then all pairs
  dynamic,  // the spheres move from frame to frame: each one's own way to follow, then all pairs
};
inline constexpr std::string_view kRunNames[] = {
    "cold", "warm", "cold_cache", "graph", "transfers", "first_update", "update", "dynamic"};
inline std::string_view name_of(Run run) { return kRunNames[static_cast<std::size_t>(run)]; }

/// Only the whole is timed: its parts are not the stages.
inline bool has_stage_times(Run run) { return run != Run::graph && run != Run::transfers; }

/// One row of the results.
struct RowSpec {
  Implementation how;
  int threads = 1;
  Run run = Run::cold;
  std::string skips = {};        // a planned row's: "no_sort", "none", "rebuilt"; empty: all
  Skips allowed = Skips::all();  // what that means
};

/// "find_pairs/backend:impl_cpu/method:home_phantom/rule:lowest_cell/scene:gas/n:1000/..."
std::string row_name(const RowSpec& row, const Group& group);

/// The rows of a group whose names match, in the order of every table.
std::vector<RowSpec> rows_of(const Group& group, std::string_view backend,
                             const std::regex& filter);

}  // namespace octocell::bench
