// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted objects, cell index. Writes certain pairs, and uncertain pairs for stage 6.
// Cost: 16 bytes gathered an id; each candidate is tested twice if its row finds something.
// Idea: count, scan, write. There is one work item for each entry, which is tested against the
//       entries behind it in its cell. The pairs found are counted, a scan finds each row's place,
//       and rows that found something test again and write.
#include <thrust/sequence.h>

#include <cstdint>

#include "core/as_written.hpp"
#include "core/faults.hpp"
#include "core/flags.hpp"
#include "impl_thrust/found_pairs.cuh"
#include "impl_thrust/gather.cuh"
#include "impl_thrust/half_shell/half_shell.cuh"

namespace octocell::on_thrust {
namespace {

/// Decides which pairs that meet in a cell count there. All work items take the same branch on the
/// rule.
struct RuleTest {
  bool every_pair;  // brute_force
  Rule rule;
  const chapter32::ControlBits* control_bits;
  float side;  // cell side of rule as_written

  [[nodiscard]] OCTOCELL_HD bool rows_are_homes() const {
    return !every_pair && rule != Rule::lowest_cell;
  }

  [[nodiscard]] OCTOCELL_HD bool counts_here(Object a, const Sphere& p, Object b,
                                             const Sphere& q) const {
    if (every_pair) return true;
    // The cell must be the lowest that both spheres meet; on each axis, it is the lowest cell of
    // one of them (Dittrich and Seeger, ICDE 2000, reference point method).
    if (rule == Rule::lowest_cell)
      return OCTOCELL_FAULT(thrust_lowest_cell_rule_dropped, true,
                            ((a | b) & kLowestMask) == kLowestMask);
    if (rule == Rule::chapter32) {  // a row is a home, so the type of its home is the type of the
                                    // cell
      const chapter32::ControlBits row = control_bits[a & kIdMask];
      return chapter32::tests_pair_here(row & 7U, row, control_bits[b & kIdMask]);
    }
    // As written in the text: two homes, or a home and a phantom if the phantom's home id is
    // larger.
    if ((b & kPhantom) == 0) return true;
    return as_written::hash(as_written::home(q, side)) >
           as_written::hash(as_written::home(p, side));
  }
};

/// Tests one row: entry k against all that follow it in its cell.
struct RowTest {
  const Sphere* members;  // with stored radii
  const Object* objects;
  const std::uint32_t* cell_end;  // null: one cell holds all entries
  std::uint64_t entries;
  const Flags* flags;  // null: every pair may collide
  PairTest test;
  RuleTest rule;

  template <typename OnSure, typename OnUncertain>
  OCTOCELL_HD void run(std::uint64_t k, OnSure on_sure, OnUncertain on_uncertain) const {
    const Object a = objects[k];
    if (rule.rows_are_homes() && (a & kPhantom) != 0) return;
    const std::uint64_t end = cell_end != nullptr ? cell_end[k] : entries;
    const Sphere p = members[k];
    for (std::uint64_t j = k + 1; j < end; ++j) {
      const Sphere q = members[j];
      if (!may_overlap(test, p, q)) continue;
      const Object b = objects[j];
      if (!rule.counts_here(a, p, b, q)) continue;
      const Pair pair = make_pair_of(a & kIdMask, b & kIdMask);
      if (flags != nullptr && !may_collide(flags[pair.i], flags[pair.j])) continue;
      if (is_sure(test, p, q)) {
        on_sure(pair);
      } else {
        on_uncertain(pair);
      }
    }
  }
};

template <typename System>
RowTest gather_rows(Workspace<System>& w) {
  Object* const objects = w.objects.data();
  const std::uint64_t entries = w.entries();
  if (w.brute_force()) thrust::sequence(w.system.policy(), objects, objects + entries);
  gather_members(w);
  const RuleTest rule = {w.brute_force(), w.plan.rule, w.control_bits.data(),
                         as_written::cell_side(w.plan.facts.r_max)};
  return {
      w.members.data(), objects, w.brute_force() ? nullptr : w.cell_end.data(), entries, w.flags,
      w.plan.test,      rule};
}

}  // namespace

template <typename System>
void pair_tests(Workspace<System>& w) {
  w.sure_count = w.pair_count = w.uncertain_count = w.checksum = 0;
  if (w.sphere_count() == 0) return;
  if (w.brute_force()) w.candidates = w.sphere_count() * (w.sphere_count() - 1) / 2;
  if (!w.may_test_pairs()) return;
  if (w.half_shell()) return half_shell::pair_tests(w);
  count_scan_write(w, gather_rows(w));
}

OCTOCELL_FOR_BOTH_SYSTEMS(pair_tests);

}  // namespace octocell::on_thrust
