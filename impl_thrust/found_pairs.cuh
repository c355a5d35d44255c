// SPDX-License-Identifier: MIT
// The second half of stage 5, for any method: a scan says where the pairs of each work item go.
#pragma once

#include <thrust/for_each.h>
#include <thrust/scan.h>
#include <thrust/transform.h>
#include <thrust/transform_reduce.h>

#include <cstdint>

#include "impl_thrust/decide.cuh"
#include "impl_thrust/pair_test.cuh"
#include "impl_thrust/stages.cuh"

namespace octocell::on_thrust {

// A `Test` finds the pairs of a work item: test.run(k, on_sure, on_uncertain) calls one of the two
// functions for each pair, with the same pairs in the same order every time.

template <typename Test>
struct CountFound {
  Test test;
  std::uint64_t entries;
  OCTOCELL_HD Found operator()(std::uint64_t k) const {
    Found found = {0, 0};
    if (k == entries) return found;  // one past the last: the scan puts the total there
    test.run(
        k, [&](Pair) { ++found.sure; }, [&](Pair) { ++found.uncertain_pairs; });
    return found;
  }
};

struct FoundByBoth {
  OCTOCELL_HD Found operator()(const Found& a, const Found& b) const {
    return {a.sure + b.sure, a.uncertain_pairs + b.uncertain_pairs};
  }
};

template <typename Test>
struct WriteFound {
  Test test;
  const Found* found_before;
  Pair* pairs;            // null: no room
  Pair* uncertain_pairs;  // null: no room
  OCTOCELL_HD void operator()(std::uint64_t k) const {
    Found at = found_before[k];
    const Found end = found_before[k + 1];
    const bool writes_pairs = pairs != nullptr && at.sure != end.sure;
    const bool writes_uncertain_pairs =
        uncertain_pairs != nullptr && at.uncertain_pairs != end.uncertain_pairs;
    if (!writes_pairs && !writes_uncertain_pairs) return;
    test.run(
        k,
        [&](Pair pair) {
          if (writes_pairs) pairs[at.sure++] = pair;
        },
        [&](Pair pair) {
          if (writes_uncertain_pairs) uncertain_pairs[at.uncertain_pairs++] = pair;
        });
  }
};

/// Like PairDigest, whose merge() does not run on the device.
struct Digest {
  std::uint64_t count;
  std::uint64_t checksum;
};

struct DigestOfBoth {
  OCTOCELL_HD Digest operator()(const Digest& a, const Digest& b) const {
    return {a.count + b.count, a.checksum + b.checksum};
  }
};

/// For a count_only plan, which cannot store uncertain pairs: decides them where they are found.
template <typename Test>
struct DigestFound {
  Test test;
  const Found* found_before;
  Overlaps overlaps;
  OCTOCELL_HD Digest operator()(std::uint64_t k) const {
    Digest digest = {0, 0};
    const Found at = found_before[k];
    const Found end = found_before[k + 1];
    if (at.sure == end.sure && at.uncertain_pairs == end.uncertain_pairs) return digest;
    const auto take = [&](Pair pair) {
      ++digest.count;
      digest.checksum += mix_pair(pair);
    };
    test.run(k, take, [&](Pair pair) {
      if (overlaps(pair)) take(pair);
    });
    return digest;
  }
};

/// Runs one work item for each entry: counts, places and writes its pairs; or sums them up, in a
/// count_only plan.
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
  w.uncertain_count = total.uncertain_pairs;
  if (w.plan.count_only) {
    const Digest digest = thrust::transform_reduce(w.system.policy(), first, end,
                                                   DigestFound<Test>{test, found, {w.spheres}},
                                                   Digest{0, 0}, DigestOfBoth{});
    w.pair_count = digest.count;
    w.checksum = digest.checksum;
    return;
  }
  thrust::for_each(
      w.system.policy(), first, end,
      WriteFound<Test>{test, found, w.pairs_complete() ? w.pairs.data() : nullptr,
                       w.uncertain_pairs_complete() ? w.uncertain_pairs.data() : nullptr});
}

}  // namespace octocell::on_thrust
