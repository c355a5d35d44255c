// SPDX-License-Identifier: MIT
// Compares what a stage wrote with what it should write, entry by entry, and looks for the cause.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "harness/judge/evidence.hpp"
#include "harness/scenes/scene.hpp"
#include "harness/try/stage_arrays.hpp"

namespace octocell::hand_in {

/// The first entry that differs.
struct WrongEntry {
  std::string array;  // ids, objects, cells, phantoms, homes
  std::uint64_t entry;
  std::string expected;
  std::string got;
};

struct StageJudgement {
  std::optional<WrongEntry> first;  // none: exact
  std::optional<judge::Cause> cause = {};
};

StageJudgement judge_cell_ids(const Entries& got, const Scene& scene, const StageArrays& expected);
StageJudgement judge_sort(const Entries& got, const StageArrays& expected);
StageJudgement judge_cell_index(std::span<const octocell_cell> got, const StageArrays& expected);

/// "3H" for the home entry of sphere 3, "3P" for one of its phantoms, with its word.
std::string object_text(std::uint32_t object);

/// Returns a cause of the arrays; its name is short, and always the same.
judge::Cause list_cause(std::string name, std::string text);

}  // namespace octocell::hand_in
