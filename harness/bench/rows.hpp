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
  cold,        // nothing: creates, plans, allocates, finds; freed memory was returned to the system
  warm,        // buffers and objects exist and were touched before; all pairs are found again
  cold_cache,  // GPUs: like warm, but the GPU's cache holds neither scene nor buffers
  graph,       // GPUs: like warm, but all stages are recorded once and replayed as one graph
  transfers,   // GPUs: like warm, but spheres come from the host and pairs go back there
  first_update,  // baselines: like update, the first one after the structure was built
  update,   // baselines: the structure exists; every sphere is set again, then all pairs are found
  dynamic,  // spheres move from frame to frame: each implementation updates in its own way, then
            // finds all pairs
};
inline constexpr std::string_view kRunNames[] = {
    "cold", "warm", "cold_cache", "graph", "transfers", "first_update", "update", "dynamic"};
inline std::string_view name_of(Run run) { return kRunNames[static_cast<std::size_t>(run)]; }

/// Returns false if only the whole is timed, because its parts are not the stages.
inline bool has_stage_times(Run run) { return run != Run::graph && run != Run::transfers; }

/// One row of the results.
struct RowSpec {
  Implementation how;
  int threads = 1;
  Run run = Run::cold;
  std::string skips = {};        // for a planned row: "no_sort", "none", "rebuilt"; empty: all
  Skips allowed = Skips::all();  // the meaning of `skips`
};

/// Returns a name such as
/// "find_pairs/backend:impl_cpu/method:home_phantom/rule:lowest_cell/scene:gas/n:1000/..."
std::string row_name(const RowSpec& row, const Group& group);

/// Returns the rows of a group whose names match, in the order of every table.
std::vector<RowSpec> rows_of(const Group& group, std::string_view backend,
                             const std::regex& filter);

}  // namespace octocell::bench
