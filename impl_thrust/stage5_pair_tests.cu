// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted objects, cell index. Writes sure pairs, and doubts for stage 6.
// Cost: 16 bytes gathered an id; each candidate is looked at twice where its row finds something.
// Idea: count, scan, write. One work item an entry meets the entries after it in its cell; what it
//       finds is counted, a scan gives each row its place, and rows that found something test again
//       and write.
#include <thrust/for_each.h>
#include <thrust/scan.h>
#include <thrust/sequence.h>
#include <thrust/transform.h>
#include <thrust/transform_reduce.h>

#include "harness/interface/as_written.hpp"
#include "harness/interface/flags.hpp"
#include "impl_thrust/overlap.cuh"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {
namespace {

/// Which pairs that meet in a cell count there. The branch on the rule is the same for all.
struct RuleTest {
  bool every_pair;  // brute_force
  Rule rule;
  const chapter32::ControlBits* control_bits;
  float side;  // of as_written's cells

  [[nodiscard]] OCTOCELL_HD bool rows_are_homes() const {
    return !every_pair && rule != Rule::lowest_cell;
  }

  [[nodiscard]] OCTOCELL_HD bool counts_here(Object a, const Sphere& p, Object b,
                                             const Sphere& q) const {
    if (every_pair) return true;
    // The cell must be the lowest that both meet: on each axis, the lowest of one of them.
    // (Dittrich and Seeger, ICDE 2000, reference point method.)
    if (rule == Rule::lowest_cell) return ((a | b) & kLowestMask) == kLowestMask;
    if (rule == Rule::chapter32) {  // a row is a home, so its home's type is the cell's
      const chapter32::ControlBits row = control_bits[a & kIdMask];
      return chapter32::tests_pair_here(row & 7U, row, control_bits[b & kIdMask]);
    }
    // The course text: home with home; home with phantom if the phantom's home id is the larger.
    if ((b & kPhantom) == 0) return true;
    return as_written::hash(as_written::home(q, side)) >
           as_written::hash(as_written::home(p, side));
  }
};

/// One row: entry k against all that follow it in its cell.
struct RowTest {
  const Sphere* members;  // with band radii
  const Object* objects;
  const std::uint32_t* cell_end;  // none: one cell of all entries
  std::uint64_t entries;
  const Flags* flags;  // none: every pair may collide
  Band band;
  RuleTest rule;

  [[nodiscard]] OCTOCELL_HD bool sure(const Sphere& p, const Sphere& q) const {
    return band == Band::fast ? band_is_sure<Band::fast>(p, q) : band_is_sure<Band::safe>(p, q);
  }

  template <typename OnSure, typename OnDoubt>
  OCTOCELL_HD void run(std::uint64_t k, OnSure on_sure, OnDoubt on_doubt) const {
    const Object a = objects[k];
    if (rule.rows_are_homes() && (a & kPhantom) != 0) return;
    const std::uint64_t end = cell_end != nullptr ? cell_end[k] : entries;
    const Sphere p = members[k];
    for (std::uint64_t j = k + 1; j < end; ++j) {
      const Sphere q = members[j];
      if (!band_may_overlap(p, q)) continue;
      const Object b = objects[j];
      if (!rule.counts_here(a, p, b, q)) continue;
      const Pair pair = make_pair_of(a & kIdMask, b & kIdMask);
      if (flags != nullptr && !may_collide(flags[pair.i], flags[pair.j])) continue;
      if (sure(p, q)) {
        on_sure(pair);
      } else {
        on_doubt(pair);
      }
    }
  }
};

struct CountRow {
  RowTest row;
  OCTOCELL_HD Found operator()(std::uint64_t k) const {
    Found found = {0, 0};
    if (k == row.entries) return found;  // one past the last: the sum of all
    row.run(
        k, [&](Pair) { ++found.sure; }, [&](Pair) { ++found.doubts; });
    return found;
  }
};

struct FoundByBoth {
  OCTOCELL_HD Found operator()(const Found& a, const Found& b) const {
    return {a.sure + b.sure, a.doubts + b.doubts};
  }
};

struct WriteRow {
  RowTest row;
  const Found* found_before;
  Pair* pairs;   // none: not wanted, or no room
  Pair* doubts;  // likewise
  OCTOCELL_HD void operator()(std::uint64_t k) const {
    Found at = found_before[k];
    const Found end = found_before[k + 1];
    const bool writes_pairs = pairs != nullptr && at.sure != end.sure;
    const bool writes_doubts = doubts != nullptr && at.doubts != end.doubts;
    if (!writes_pairs && !writes_doubts) return;
    row.run(
        k,
        [&](Pair pair) {
          if (writes_pairs) pairs[at.sure++] = pair;
        },
        [&](Pair pair) {
          if (writes_doubts) doubts[at.doubts++] = pair;
        });
  }
};

/// A count_only plan has no room for doubts: they are decided where they are found.
struct SumRow {
  RowTest row;
  const Sphere* spheres;
  const Found* found_before;
  OCTOCELL_HD Confirmed operator()(std::uint64_t k) const {
    Confirmed sum = {0, 0};
    const Found at = found_before[k];
    const Found end = found_before[k + 1];
    if (at.sure == end.sure && at.doubts == end.doubts) return sum;
    row.run(
        k, [&](Pair pair) { sum.add(pair); },
        [&](Pair pair) {
          if (overlap(spheres[pair.i], spheres[pair.j])) sum.add(pair);
        });
    return sum;
  }
};

/// The sphere of an entry, with the radius that level 1 of the predicate uses.
struct Gather {
  const Sphere* spheres;
  Band band;
  OCTOCELL_HD Sphere operator()(Object object) const {
    Sphere s = spheres[object & kIdMask];
    s.r = band == Band::fast ? band_radius<Band::fast>(s.r) : band_radius<Band::safe>(s.r);
    return s;
  }
};

template <typename System>
RowTest gather_rows(Workspace<System>& w) {
  Object* const objects = w.objects.data();
  const std::uint64_t entries = w.entries();
  if (w.brute_force()) thrust::sequence(w.system.policy(), objects, objects + entries);
  thrust::transform(w.system.policy(), objects, objects + entries, w.members.data(),
                    Gather{w.spheres, w.plan.band});
  const RuleTest rule = {w.brute_force(), w.plan.rule, w.control_bits.data(),
                         as_written::cell_side(w.plan.facts.r_max)};
  return {
      w.members.data(), objects, w.brute_force() ? nullptr : w.cell_end.data(), entries, w.flags,
      w.plan.band,      rule};
}

template <typename System>
void test_rows(Workspace<System>& w, const RowTest& row) {
  const Positions first(0);
  const Positions end(row.entries);
  Found* const found = w.found.data();
  thrust::transform(w.system.policy(), first, end + 1, found, CountRow{row});
  thrust::exclusive_scan(w.system.policy(), found, found + row.entries + 1, found, Found{0, 0},
                         FoundByBoth{});
  const Found total = w.system.read(found + row.entries);
  w.sure_count = w.pair_count = total.sure;
  w.doubt_count = total.doubts;
  if (w.plan.count_only) {
    const Confirmed sum =
        thrust::transform_reduce(w.system.policy(), first, end, SumRow{row, w.spheres, found},
                                 Confirmed{0, 0}, ConfirmedInBoth{});
    w.pair_count = sum.count;
    w.checksum = sum.checksum;
    return;
  }
  thrust::for_each(w.system.policy(), first, end,
                   WriteRow{row, found, w.pairs_complete() ? w.pairs.data() : nullptr,
                            w.doubts_complete() ? w.doubts.data() : nullptr});
}

}  // namespace

template <typename System>
void pair_tests(Workspace<System>& w) {
  w.sure_count = w.pair_count = w.doubt_count = w.checksum = 0;
  if (w.sphere_count() == 0) return;
  if (w.brute_force()) w.candidates = w.sphere_count() * (w.sphere_count() - 1) / 2;
  if (w.may_test_pairs()) test_rows(w, gather_rows(w));
}

OCTOCELL_FOR_BOTH_SYSTEMS(pair_tests);

}  // namespace octocell::on_thrust
