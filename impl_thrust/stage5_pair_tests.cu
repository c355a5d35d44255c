// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted objects, cell index. Writes certain pairs, and uncertain pairs for stage 6.
// Cost: 16 bytes gathered an id; each candidate is tested twice if its row finds something.
// Idea: count, scan, write. There is one work item for each entry, which is tested against the
//       entries behind it in its cell. The pairs found are counted, a scan finds each row's place,
//       and rows that found something test again and write.
#include <thrust/sequence.h>

#include <cstdint>

#include "core/flags.hpp"
#include "core/pair_rule.hpp"
#include "impl_thrust/found_pairs.cuh"
#include "impl_thrust/gather.cuh"
#include "impl_thrust/half_shell/half_shell.cuh"

namespace octocell::on_thrust {
namespace {

/// Tests one row: entry k against all that follow it in its cell.
struct RowTest {
  const Sphere* members;  // with stored radii
  const Object* objects;
  const std::uint32_t* cell_end;  // null: one cell holds all entries
  std::uint64_t entries;
  const Flags* flags;  // null: every pair may collide
  PairTest test;
  PairRule rule;

  template <typename OnSure, typename OnUncertain>
  OCTOCELL_HD void run(std::uint64_t k, OnSure on_sure, OnUncertain on_uncertain) const {
    const Member a = {members[k], objects[k]};
    if (!rule.may_be_row(a)) return;
    const std::uint64_t end = cell_end != nullptr ? cell_end[k] : entries;
    for (std::uint64_t j = k + 1; j < end; ++j) {
      const Sphere q = members[j];
      if (!may_overlap(test, a.sphere, q)) continue;
      const Member b = {q, objects[j]};
      if (!rule.counts_here(a, b)) continue;
      const Pair pair = make_pair_of(a.id(), b.id());
      if (flags != nullptr && !may_collide(flags[pair.i], flags[pair.j])) continue;
      if (is_sure(test, a.sphere, q)) {
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
  const PairRule rule = {w.brute_force(), w.plan.rule, w.control_bits.data(),
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
