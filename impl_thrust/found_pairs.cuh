// SPDX-License-Identifier: MIT
// Stage 5's second half, whatever the method: pairs that work items find go where a scan says.
#pragma once

#include <thrust/for_each.h>
#include <thrust/functional.h>
#include <thrust/scan.h>
#include <thrust/transform.h>
#include <thrust/transform_reduce.h>

#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

OCTOCELL_HD bool is_sure(Band band, const Sphere& p, const Sphere& q) {
  return band == Band::fast ? band_is_sure<Band::fast>(p, q) : band_is_sure<Band::safe>(p, q);
}

// A `Test` says which pairs a work item finds: test.run(k, on_sure, on_doubt) calls one of the two
// with each, the same ones in the same order however often it is asked.

template <typename Test>
struct CountFound {
  Test test;
  std::uint64_t entries;
  OCTOCELL_HD Found operator()(std::uint64_t k) const {
    Found found = {0, 0};
    if (k == entries) return found;  // one past the last: the sum of all
    test.run(
        k, [&](Pair) { ++found.sure; }, [&](Pair) { ++found.doubts; });
    return found;
  }
};

struct FoundByBoth {
  OCTOCELL_HD Found operator()(const Found& a, const Found& b) const {
    return {a.sure + b.sure, a.doubts + b.doubts};
  }
};

template <typename Test>
struct WriteFound {
  Test test;
  const Found* found_before;
  Pair* pairs;   // none: not wanted, or no room
  Pair* doubts;  // likewise
  OCTOCELL_HD void operator()(std::uint64_t k) const {
    Found at = found_before[k];
    const Found end = found_before[k + 1];
    const bool writes_pairs = pairs != nullptr && at.sure != end.sure;
    const bool writes_doubts = doubts != nullptr && at.doubts != end.doubts;
    if (!writes_pairs && !writes_doubts) return;
    test.run(
        k,
        [&](Pair pair) {
          if (writes_pairs) pairs[at.sure++] = pair;
        },
        [&](Pair pair) {
          if (writes_doubts) doubts[at.doubts++] = pair;
        });
  }
};

template <typename Test>
struct SumFound {
  Test test;
  const Found* found_before;
  OCTOCELL_HD std::uint64_t operator()(std::uint64_t k) const {
    std::uint64_t sum = 0;
    if (found_before[k].sure == found_before[k + 1].sure) return sum;
    test.run(
        k, [&](Pair pair) { sum += mix_pair(pair); }, [](Pair) {});
    return sum;
  }
};

/// One work item an entry: counted, placed, written.
template <typename System, typename Test>
void count_scan_write(Workspace<System>& w, const Test& test) {
  const std::uint64_t entries = w.entries();
  const Positions first(0);
  const Positions end(entries);
  Found* const found = w.found.data();
  thrust::transform(w.system.policy(), first, end + 1, found, CountFound<Test>{test, entries});
  thrust::exclusive_scan(w.system.policy(), found, found + entries + 1, found, Found{0, 0},
                         FoundByBoth{});
  const Found total = w.system.read(found + entries);
  w.sure_count = w.pair_count = total.sure;
  w.doubt_count = total.doubts;
  const bool store = !w.plan.count_only && w.pairs_complete();
  if (w.plan.count_only) {
    w.checksum =
        thrust::transform_reduce(w.system.policy(), first, end, SumFound<Test>{test, found},
                                 std::uint64_t{0}, thrust::plus<std::uint64_t>{});
  }
  thrust::for_each(w.system.policy(), first, end,
                   WriteFound<Test>{test, found, store ? w.pairs.data() : nullptr,
                                    w.doubts_complete() ? w.doubts.data() : nullptr});
}

}  // namespace octocell::on_thrust
