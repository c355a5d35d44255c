// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/judge/hypotheses.hpp"

namespace octocell::judge {
namespace {

using Ids = std::pair<std::int64_t, std::int64_t>;  // the smaller first
constexpr std::size_t kFewest = 3;                  // pairs that may name a cause

Ids in_order(std::int64_t i, std::int64_t j) { return {std::min(i, j), std::max(i, j)}; }

std::vector<Ids> distinct(std::vector<Ids> ids) {
  std::ranges::sort(ids);
  const auto rest = std::ranges::unique(ids);
  ids.erase(rest.begin(), rest.end());
  return ids;
}

std::size_t common(const std::vector<Ids>& a, const std::vector<Ids>& b) {
  std::vector<Ids> both;
  std::ranges::set_intersection(a, b, std::back_inserter(both));
  return both.size();
}

/// Another way to write the number of a sphere.
struct Renaming {
  std::string name;
  std::string text;
  std::function<std::int64_t(std::uint32_t)> of;
};

/// Returns the place of each sphere in their order along an axis.
std::vector<std::int64_t> places_along(std::size_t axis, const SceneFacts& facts) {
  std::vector<std::uint32_t> order(facts.spheres.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {},
                           [&](std::uint32_t id) { return centre_of(facts.spheres[id])[axis]; });
  std::vector<std::int64_t> places(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) places[order[k]] = static_cast<std::int64_t>(k);
  return places;
}

std::vector<Renaming> renamings(const SceneFacts& facts) {
  std::vector<Renaming> all = {{"ids from 1",
                                "the list counts spheres from 1, and the first sphere is 0",
                                [](std::uint32_t id) { return std::int64_t{id} + 1; }}};
  const auto add_bits = [&](int bits, bool is_signed) {
    const std::int64_t size = std::int64_t{1} << bits;
    if (static_cast<std::int64_t>(facts.spheres.size()) <= (is_signed ? size / 2 : size)) return;
    all.push_back({fmt::format("ids cut to {} bits", bits),
                   fmt::format("ids were stored in {} bits{}: what stands there is the id modulo "
                               "{}",
                               bits, is_signed ? " with a sign" : "", size),
                   [=](std::uint32_t id) {
                     const std::int64_t rest = id % size;
                     return is_signed && rest >= size / 2 ? rest - size : rest;
                   }});
  };
  for (const int bits : {8, 16}) {
    add_bits(bits, false);
    add_bits(bits, true);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.push_back({"places instead of ids",
                   fmt::format("the list holds the places of the spheres after sorting them along "
                               "{}, not their numbers in the scene",
                               "xyz"[axis]),
                   [places = places_along(axis, facts)](std::uint32_t id) { return places[id]; }});
  }
  return all;
}

/// Returns the renaming that turns the exact pairs into the list, but for one in a hundred.
std::optional<Cause> renamed(std::span<const ListedPair> list, const Differences& differences,
                             const SceneFacts& facts) {
  std::vector<Ids> rows;
  for (const ListedPair& p : list) rows.push_back(in_order(p.i, p.j));
  rows = distinct(std::move(rows));
  for (const Renaming& renaming : renamings(facts)) {
    std::vector<Ids> expected;
    for (const Pair& p : facts.truth)
      expected.push_back(in_order(renaming.of(p.i), renaming.of(p.j)));
    expected = distinct(std::move(expected));
    const std::size_t most = std::max(rows.size(), expected.size());
    const std::size_t same = common(rows, expected);
    if (same < kFewest || same <= differences.found.size() || same * 100 < most * 99) continue;
    return Cause{.kind = "list",
                 .name = renaming.name,
                 .text = fmt::format("{}: so read, {} of {} pairs are right", renaming.text, same,
                                     rows.size()),
                 .wrong = same};
  }
  return std::nullopt;
}

/// How the rows of repeated pairs lie.
std::optional<Cause> repeated(const Differences& differences) {
  const auto& all = differences.repeated;
  if (all.size() < kFewest) return std::nullopt;
  const auto pairs = differences.found.size() + differences.false_pairs.size();
  const bool in_both_orders =
      std::ranges::all_of(all, [](const RepeatedPair& p) { return p.ascending == p.descending; });
  const Cause cause = {.kind = "duplicates", .name = {}, .text = {}, .wrong = all.size()};
  if (in_both_orders && (all.size() == pairs || all.size() >= 20)) {
    Cause both = cause;
    both.name = "both orders";
    both.text = fmt::format("{} of {} pairs are listed as i, j and as j, i", all.size(), pairs);
    return both;
  }
  const std::uint64_t times = all.front().times();
  const auto is_as_often = [times](const RepeatedPair& p) { return p.times() == times; };
  if (all.size() == pairs && std::ranges::all_of(all, is_as_often)) {
    Cause whole = cause;
    whole.name = "everything repeated";
    whole.text = fmt::format("every pair is listed {} times", times);
    return whole;
  }
  return std::nullopt;
}

std::optional<Cause> out_of_range(std::span<const ListedPair> list,
                                  const Differences& differences) {
  const auto& rows = differences.out_of_range;
  if (rows.empty()) return std::nullopt;
  const Cause cause = {.kind = "out_of_range", .name = {}, .text = {}, .wrong = rows.size()};
  const ListedPair first = list[rows.front()];
  const auto is_first = [&](std::size_t row) { return list[row] == first; };
  if (first.i == first.j && rows.size() > 1 && std::ranges::all_of(rows, is_first)) {
    Cause unused = cause;
    unused.name = "unused rows";
    unused.text = fmt::format("{} rows hold {}, {}: room that nothing was written to", rows.size(),
                              first.i, first.j);
    return unused;
  }
  if (std::ranges::all_of(rows, [&](std::size_t row) { return list[row].i == list[row].j; })) {
    Cause self = cause;
    self.name = "itself";
    self.text = fmt::format("{} row{} a sphere with itself", rows.size(),
                            rows.size() == 1 ? " pairs" : "s pair");
    return self;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Cause> list_causes(std::span<const ListedPair> list, const Differences& differences,
                               const SceneFacts& facts) {
  if (auto cause = renamed(list, differences, facts)) return {std::move(*cause)};
  std::vector<Cause> causes;
  if (auto cause = repeated(differences)) causes.push_back(std::move(*cause));
  if (auto cause = out_of_range(list, differences)) causes.push_back(std::move(*cause));
  return causes;
}

std::optional<Cause> round_number_of_rows(const Differences& differences, const SceneFacts& facts) {
  const bool only_lost = differences.false_pairs.empty() && differences.repeated.empty();
  if (!only_lost || differences.missed.empty()) return std::nullopt;
  const std::uint64_t rows = differences.listed;
  const std::uint64_t n = facts.spheres.size();
  std::set<std::uint64_t> round;
  const std::uint64_t end = facts.truth.size();
  for (std::uint64_t k = 16; k < end; k *= 2) round.insert(k);
  for (std::uint64_t k = n; k < end; k *= 2) round.insert(k);
  for (std::uint64_t k = 100; k < end; k *= 10) round.insert({k, 2 * k, 5 * k});
  std::erase_if(round, [end](std::uint64_t k) { return k >= end; });
  const double chance = static_cast<double>(round.size()) / static_cast<double>(facts.truth.size());
  if (!round.contains(rows) || chance > 0.01) return std::nullopt;
  return Cause{
      .kind = "missed",
      .name = "clipped",
      .text = fmt::format("the list ends at {} rows, {}, and {} pairs are missing: a "
                          "buffer may have been full",
                          rows, std::has_single_bit(rows) ? "a power of two" : "a round number",
                          differences.missed.size()),
      .wrong = differences.missed.size(),
      .right = differences.found.size()};
}

}  // namespace octocell::judge
