// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted objects, cell index. Writes certain pairs, and uncertain pairs for stage 6.
// Cost: 16 bytes gathered an id; each candidate is tested twice if its row finds something.
// Idea: count, scan, write. There is one work item for each entry, which is tested against the
//       entries behind it in its cell. The pairs found are counted, a scan finds each row's place,
//       and rows that found something test again and write.
#include <thrust/for_each.h>
#include <thrust/scan.h>
#include <thrust/sequence.h>
#include <thrust/transform.h>

#include <cstdint>
#include <vector>

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

  /// Returns what becomes of row `a` and entry j behind it.
  [[nodiscard]] OCTOCELL_HD Judgement judge(const Member& a, std::uint64_t j) const {
    const Member b = {members[j], objects[j]};
    if (!may_overlap(test, a.sphere, b.sphere)) return Judgement::apart;
    if (!rule.counts_here(a, b)) return Judgement::other_cell;
    if (flags != nullptr && !may_collide(flags[a.id()], flags[b.id()])) return Judgement::flags;
    return is_sure(test, a.sphere, b.sphere) ? Judgement::overlap : Judgement::uncertain;
  }
  /// Returns the end of the entries that row k is tested against; they begin behind it.
  [[nodiscard]] OCTOCELL_HD std::uint64_t end_of_row(std::uint64_t k) const {
    if (!rule.may_be_row({members[k], objects[k]})) return k + 1;
    return cell_end != nullptr ? cell_end[k] : entries;
  }

  template <typename OnSure, typename OnUncertain>
  OCTOCELL_HD void run(std::uint64_t k, OnSure on_sure, OnUncertain on_uncertain) const {
    const Member a = {members[k], objects[k]};
    const std::uint64_t end = end_of_row(k);
    for (std::uint64_t j = k + 1; j < end; ++j) {
      const Judgement found = judge(a, j);
      if (found == Judgement::overlap) on_sure(make_pair_of(a.id(), objects[j] & kIdMask));
      if (found == Judgement::uncertain) on_uncertain(make_pair_of(a.id(), objects[j] & kIdMask));
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

/// How many candidates a row has.
struct CandidatesOfRow {
  RowTest rows;
  OCTOCELL_HD std::uint64_t operator()(std::uint64_t k) const {
    const std::uint64_t end = k < rows.entries ? rows.end_of_row(k) : 0;
    return end > k + 1 ? end - (k + 1) : 0;
  }
};

/// Judges the candidates of a row once more and writes each of them down.
struct WriteConsidered {
  RowTest rows;
  const std::uint32_t* cell_ids;  // null: no cells
  const std::uint64_t* candidates_before;
  Considered* considered;
  OCTOCELL_HD void operator()(std::uint64_t k) const {
    const Member a = {rows.members[k], rows.objects[k]};
    const std::uint64_t count = candidates_before[k + 1] - candidates_before[k];
    for (std::uint64_t c = 0; c < count; ++c) {
      const std::uint64_t j = k + 1 + c;
      considered[candidates_before[k] + c] = {a.id(), rows.objects[j] & kIdMask,
                                              cell_ids != nullptr ? cell_ids[k] : 0,
                                              rows.judge(a, j)};
    }
  }
};

/// For a run that is recorded: all candidates, in the order in which the rows stand.
template <typename System>
std::vector<Considered> write_down_candidates(Workspace<System>& w, const RowTest& rows) {
  typename System::template Array<std::uint64_t> before;
  before.allocate(rows.entries + 1);
  thrust::transform(w.system.policy(), Positions(0), Positions(rows.entries + 1), before.data(),
                    CandidatesOfRow{rows});
  thrust::exclusive_scan(w.system.policy(), before.data(), before.data() + rows.entries + 1,
                         before.data());
  const std::uint64_t total = w.system.read(before.data() + rows.entries);
  typename System::template Array<Considered> considered;
  considered.allocate(total);
  thrust::for_each(w.system.policy(), Positions(0), Positions(rows.entries),
                   WriteConsidered{rows, w.brute_force() ? nullptr : w.cell_ids.data(),
                                   before.data(), considered.data()});
  return w.system.read(considered.data(), total);
}

}  // namespace

template <typename System>
void pair_tests(Workspace<System>& w) {
  w.sure_count = w.pair_count = w.uncertain_count = w.checksum = 0;
  if (w.sphere_count() == 0) return;
  if (w.brute_force()) w.candidates = w.sphere_count() * (w.sphere_count() - 1) / 2;
  if (!w.may_test_pairs()) return;
  if (w.half_shell()) return half_shell::pair_tests(w);
  const RowTest rows = gather_rows(w);
  if (w.record != nullptr) w.record->considered.set(write_down_candidates(w, rows));
  count_scan_write(w, rows);
}

OCTOCELL_FOR_BOTH_SYSTEMS(pair_tests);

}  // namespace octocell::on_thrust
