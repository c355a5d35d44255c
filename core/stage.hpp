// SPDX-License-Identifier: MIT
// The stages, in the order in which they run. Their names are file stems, function names, timer labels, JSON keys, report columns
// and chapter names; tests/layout/test_layout.py checks that.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/enum_set.hpp"

namespace octocell {

enum class Stage : std::uint8_t {
  // our backends
  bounds,
  cell_ids,
  sort,
  cell_index,
  pair_tests,
  resolve,
  // baselines: build the structure, update it, query it for all pairs
  build,
  update,
  query,
};

inline constexpr std::size_t kStageCount = 9;

inline constexpr std::array<std::string_view, kStageCount> kStageNames = {
    "bounds", "cell_ids", "sort", "cell_index", "pair_tests", "resolve", "build", "update", "query",
};

constexpr std::size_t index_of(Stage stage) { return static_cast<std::size_t>(stage); }
constexpr std::string_view name_of(Stage stage) { return kStageNames[index_of(stage)]; }

using Stages = EnumSet<Stage, kStageCount>;

}  // namespace octocell
