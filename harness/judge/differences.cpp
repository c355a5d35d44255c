// SPDX-License-Identifier: MIT
#include "harness/judge/differences.hpp"

#include <algorithm>
#include <iterator>

namespace octocell::judge {
namespace {

/// A row that names two spheres.
struct Row {
  Pair pair;
  bool is_descending;
};

bool names_two_spheres(const ListedPair& p, std::size_t spheres) {
  const auto is_id = [spheres](std::int64_t id) {
    return id >= 0 && static_cast<std::uint64_t>(id) < spheres;
  };
  return is_id(p.i) && is_id(p.j) && p.i != p.j;
}

Row row_from(const ListedPair& p) {
  return {make_pair_of(static_cast<std::uint32_t>(p.i), static_cast<std::uint32_t>(p.j)),
          p.i > p.j};
}

}  // namespace

Differences differences_of(std::span<const ListedPair> list, std::span<const Pair> truth,
                           std::size_t spheres) {
  Differences result = {.listed = list.size()};
  std::vector<Row> rows;
  rows.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (names_two_spheres(list[k], spheres)) {
      rows.push_back(row_from(list[k]));
    } else {
      result.out_of_range.push_back(k);
    }
  }
  std::ranges::sort(rows, {}, &Row::pair);

  std::vector<Pair> listed;
  for (std::size_t begin = 0; begin < rows.size();) {
    RepeatedPair same = {rows[begin].pair, 0, 0};
    std::size_t end = begin;
    for (; end < rows.size() && rows[end].pair == same.pair; ++end)
      ++(rows[end].is_descending ? same.descending : same.ascending);
    listed.push_back(same.pair);
    if (same.times() > 1) result.repeated.push_back(same);
    result.duplicates += same.times() - 1;
    begin = end;
  }
  std::ranges::set_intersection(listed, truth, std::back_inserter(result.found));
  std::ranges::set_difference(truth, listed, std::back_inserter(result.missed));
  std::ranges::set_difference(listed, truth, std::back_inserter(result.false_pairs));
  return result;
}

std::size_t row_of(std::span<const ListedPair> list, Pair pair, std::size_t occurrence) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto i = static_cast<std::int64_t>(pair.i);
    const auto j = static_cast<std::int64_t>(pair.j);
    const bool is_it = list[k] == ListedPair{i, j} || list[k] == ListedPair{j, i};
    if (is_it && occurrence-- == 0) return k;
  }
  return list.size();
}

}  // namespace octocell::judge
