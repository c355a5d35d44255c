// SPDX-License-Identifier: MIT
// What the stages of one run read and wrote, for small scenes that people want to look at.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/chapter32.hpp"
#include "core/digit_plan.hpp"
#include "core/half_shell.hpp"
#include "core/host_device.hpp"
#include "core/object_word.hpp"
#include "core/overlap.hpp"
#include "core/pair.hpp"

namespace octocell {

/// An array of a run; or, if the run has no such array, the reason.
template <typename T>
struct Recorded {
  bool exists = false;
  std::vector<T> items;
  std::string_view why_not = "the run does not have this stage";

  void set(std::vector<T> found) {
    exists = true;
    items = std::move(found);
  }
  void lack(std::string_view reason) { *this = {.exists = false, .items = {}, .why_not = reason}; }
};

/// Cell ids with their objects, as a stage left them.
struct RecordedIds {
  Recorded<std::uint32_t> cell_ids;
  Recorded<Object> objects;
};

/// One pass of the radix sort.
struct SortPass {
  Digit digit;
  std::vector<std::uint32_t> counts;    // [2^width] how many keys have this digit
  std::vector<std::uint32_t> offsets;   // [2^width] where the first key with this digit goes
  std::vector<std::uint32_t> cell_ids;  // after the pass
  std::vector<Object> objects;
};

/// What stage 5 made of two entries of a cell. In this order: the rule and the flags are not asked
/// about spheres that are certainly apart.
enum class Judgement : std::uint8_t {
  apart,       // by the float32 test, with its proved bound
  other_cell,  // the rule: the pair does not count in this cell
  flags,       // their flags keep the two from colliding
  overlap,     // by the float32 test, with its proved bound
  uncertain,   // left to stage 6
};

OCTOCELL_HD Judgement judgement_of(Verdict verdict) {
  if (verdict == Verdict::apart) return Judgement::apart;
  return verdict == Verdict::overlap ? Judgement::overlap : Judgement::uncertain;
}

/// Two entries that stage 5 looked at. `i` is the row: the earlier entry of the cell.
struct Considered {
  std::uint32_t i;
  std::uint32_t j;
  std::uint32_t cell_id;  // 0 for brute_force, which has no cells
  Judgement judgement;
};

struct RunRecord {
  RecordedIds ids;                                // after stage 2
  Recorded<chapter32::ControlBits> control_bits;  // of each sphere, after stage 2
  Recorded<SortPass> passes;
  RecordedIds sorted;  // after stage 3
  Recorded<CellEntry> cells;
  Recorded<ColumnRow> rows;  // method half_shell, instead of cells
  Recorded<Considered> considered;
  Recorded<Pair> certain;    // after stage 5
  Recorded<Pair> uncertain;  // after stage 5
};

}  // namespace octocell
