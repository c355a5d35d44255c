// SPDX-License-Identifier: MIT
// Method home_phantom: two spheres may meet in several cells; a rule says in which of them the pair
// counts.
#pragma once

#include <cstdint>

#include "core/as_written.hpp"
#include "core/chapter32.hpp"
#include "core/host_device.hpp"
#include "core/object_word.hpp"
#include "core/plan.hpp"

namespace octocell {

/// Rule lowest_cell: the cell must be the lowest that both spheres meet; on each axis, it is the
/// lowest cell of one of them (Dittrich and Seeger, ICDE 2000, reference point method).
OCTOCELL_HD bool is_lowest_of_both(Object a, Object b) {
  return ((a | b) & kLowestMask) == kLowestMask;
}

/// Rule chapter32. `row` is a home, so the type of its home is the type of the cell.
OCTOCELL_HD bool counts_by_chapter32(chapter32::ControlBits row, chapter32::ControlBits other) {
  return chapter32::tests_pair_here(row & 7U, row, other);
}

/// Rule as_written: tests two homes, or a home and a phantom if the phantom's home id is larger.
OCTOCELL_HD bool counts_as_written(const Sphere& row, const Sphere& other, bool other_is_phantom,
                                   float side) {
  if (!other_is_phantom) return true;
  return as_written::hash(as_written::home(other, side)) >
         as_written::hash(as_written::home(row, side));
}

/// Returns true if a pair must have a home as its first entry, which comes before the other.
OCTOCELL_HD bool rows_are_homes(Rule rule) { return rule != Rule::lowest_cell; }

/// Returns how many pairs a rule tests in a cell; if zero, the cell needs no entry.
OCTOCELL_HD std::uint64_t candidates_in_cell(Rule rule, std::uint64_t homes,
                                             std::uint64_t phantoms) {
  const std::uint64_t all = homes + phantoms;
  if (!rows_are_homes(rule)) return all * (all - 1) / 2;
  return homes == 0 ? 0 : homes * (homes - 1) / 2 + homes * phantoms;
}

/// An entry of a cell, with its sphere.
struct Member {
  Sphere sphere;
  Object object;
  [[nodiscard]] OCTOCELL_HD std::uint32_t id() const { return object & kIdMask; }
  [[nodiscard]] OCTOCELL_HD bool is_phantom() const { return (object & kPhantom) != 0; }
};

/// The rule of a plan, chosen while the program runs: its branch is the same for all GPU threads.
struct PairRule {
  bool every_pair;  // brute_force
  Rule rule;
  const chapter32::ControlBits* control_bits;
  float text_side;  // cell side of rule as_written

  [[nodiscard]] OCTOCELL_HD bool may_be_row(const Member& a) const {
    return every_pair || !rows_are_homes(rule) || !a.is_phantom();
  }
  /// Returns true if the pair counts in the cell. `a` may be a row and comes before `b`.
  [[nodiscard]] OCTOCELL_HD bool counts_here(const Member& a, const Member& b) const {
    if (every_pair) return true;
    if (rule == Rule::lowest_cell) return is_lowest_of_both(a.object, b.object);
    if (rule == Rule::chapter32) {
      return counts_by_chapter32(control_bits[a.id()], control_bits[b.id()]);
    }
    return counts_as_written(a.sphere, b.sphere, b.is_phantom(), text_side);
  }
};

}  // namespace octocell
