// SPDX-License-Identifier: MIT
#include "harness/trace/run_trace.hpp"

#include <algorithm>
#include <cstddef>

namespace octocell::trace {

Decision decision_on(const Considered& considered, const RunTrace& trace) {
  // On a lattice plain float32 has no error, so it needs no bound.
  const std::string_view by = trace.plan.test == PairTest::f32 ? "lattice" : "bound";
  switch (considered.judgement) {
    case Judgement::apart:
      return {"apart", by};
    case Judgement::other_cell:
      return {"skipped", "rule"};
    case Judgement::flags:
      return {"skipped", "flags"};
    case Judgement::overlap:
      return {"overlap", by};
    case Judgement::uncertain:
      break;
  }
  const Pair pair = make_pair_of(considered.i, considered.j);
  const bool found = std::ranges::binary_search(trace.pairs, pair);
  return {found ? "overlap" : "apart", "exact"};
}

std::vector<std::uint32_t> destinations(const SortPass& pass,
                                        const std::vector<std::uint32_t>& ids_before) {
  std::vector<std::uint32_t> next = pass.offsets;
  std::vector<std::uint32_t> places;
  places.reserve(ids_before.size());
  const std::uint64_t mask = (std::uint64_t{1} << pass.digit.width) - 1;
  for (const std::uint32_t id : ids_before) places.push_back(next[id >> pass.digit.shift & mask]++);
  return places;
}

}  // namespace octocell::trace
