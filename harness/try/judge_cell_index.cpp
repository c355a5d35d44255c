// SPDX-License-Identifier: MIT
// The mistakes that are tried: what a list with one of them would hold.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/try/judge_stage.hpp"

namespace octocell::hand_in {
namespace {

using Cells = std::vector<octocell_cell>;
using Mistake = std::pair<judge::Cause, Cells>;

constexpr std::array<std::uint32_t, 9> kBlocks = {32, 64, 128, 256, 512, 1024, 2048, 4096, 65536};

auto as_tuple(const octocell_cell& c) { return std::tuple(c.begin, c.homes, c.phantoms); }

bool are_equal(const Cells& a, const Cells& b) {
  return std::ranges::equal(a, b, {}, as_tuple, as_tuple);
}

Cells in_order(Cells cells) {
  std::ranges::sort(cells, {}, as_tuple);
  return cells;
}

octocell_cell cell_of(const Entries& sorted, std::size_t begin, std::size_t end) {
  octocell_cell cell = {static_cast<std::uint32_t>(begin), 0, 0};
  for (std::size_t k = begin; k < end; ++k)
    ++((sorted.objects[k] & OCTOCELL_PHANTOM) != 0 ? cell.phantoms : cell.homes);
  return cell;
}

/// Returns all cells; those that cross a multiple of `block` are cut there.
Cells all_cells(const Entries& sorted, std::size_t block) {
  Cells cells;
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= sorted.size(); ++k) {
    const bool ends = k == sorted.size() || sorted.ids[k] != sorted.ids[k - 1] || k % block == 0;
    if (!ends) continue;
    cells.push_back(cell_of(sorted, begin, k));
    begin = k;
  }
  return cells;
}

template <typename Change>
Cells changed(Cells cells, Change change) {
  for (octocell_cell& cell : cells) change(cell);
  return cells;
}

template <typename Keep>
Cells only(Cells cells, Keep keep) {
  std::erase_if(cells, [&](const octocell_cell& cell) { return !keep(cell); });
  return cells;
}

std::uint32_t members(const octocell_cell& cell) { return cell.homes + cell.phantoms; }
bool has_two(const octocell_cell& cell) { return members(cell) >= 2; }

void add_blocks(std::vector<Mistake>& mistakes, const Entries& sorted, const Cells& right) {
  for (const std::uint32_t block : kBlocks) {
    if (block >= sorted.size()) return;
    const auto add = [&](const char* what, Cells cells) {
      mistakes.emplace_back(
          list_cause("block borders",
                     fmt::format("cells that cross a multiple of {} are {}", block, what)),
          std::move(cells));
    };
    add("cut in two", only(all_cells(sorted, block), has_two));
    add("missing", only(right, [&](const octocell_cell& c) {
          return c.begin / block == (c.begin + members(c) - 1) / block;
        }));
    const auto end = static_cast<std::uint32_t>(sorted.size() / block * block);
    mistakes.emplace_back(
        list_cause("last block missing",
                   fmt::format("the cells behind entry {}, the last whole block of {}, are missing",
                               end, block)),
        only(right, [&](const octocell_cell& c) { return c.begin < end; }));
    add("missing where they begin at one",
        only(right, [&](const octocell_cell& c) { return c.begin == 0 || c.begin % block != 0; }));
  }
}

std::vector<Mistake> mistakes_with(const Entries& sorted, const Cells& right) {
  std::vector<Mistake> mistakes;
  const auto add = [&](const char* name, const char* text, Cells cells) {
    mistakes.emplace_back(list_cause(name, text), std::move(cells));
  };
  const Cells all = all_cells(sorted, sorted.size() + 1);
  add("cells of one entry", "cells with a single entry are listed, too", all);
  if (!right.empty()) {
    add("last cell missing", "the last cell is missing", Cells(right.begin(), right.end() - 1));
    add("first cell missing", "the first cell is missing", Cells(right.begin() + 1, right.end()));
  }
  add("no homes no cell", "cells without a home are missing: two phantoms may be a pair, too",
      only(right, [](const octocell_cell& c) { return c.homes != 0; }));
  add("homes and phantoms exchanged", "homes are counted as phantoms, and phantoms as homes",
      changed(right, [](octocell_cell& c) { std::swap(c.homes, c.phantoms); }));
  add("phantoms not counted", "the number of phantoms is 0 everywhere",
      changed(right, [](octocell_cell& c) { c.phantoms = 0; }));
  add("all counted as homes", "phantoms are counted as homes: bit 31 of the object says which",
      changed(right, [](octocell_cell& c) {
        c = {c.begin, members(c), 0};
      }));
  add("one short", "each cell ends one entry too early",
      changed(right, [](octocell_cell& c) { --(c.phantoms != 0 ? c.phantoms : c.homes); }));
  Cells twice = right;
  twice.insert(twice.end(), right.begin(), right.end());
  add("listed twice", "each cell is listed twice", in_order(std::move(twice)));
  add_blocks(mistakes, sorted, right);
  return mistakes;
}

std::string text_of(const octocell_cell& c) {
  return fmt::format("begin {}, homes {}, phantoms {}", c.begin, c.homes, c.phantoms);
}

}  // namespace

StageJudgement judge_cell_index(std::span<const octocell_cell> got, const StageArrays& expected) {
  const Cells has = in_order({got.begin(), got.end()});
  const Cells right = in_order(expected.cells);
  if (are_equal(has, right)) return {};
  const auto [a, b] = std::ranges::mismatch(has, right, {}, as_tuple, as_tuple);
  const bool is_missing = a == has.end() || (b != right.end() && b->begin < a->begin);
  const bool is_more = b == right.end() || (a != has.end() && a->begin < b->begin);
  const WrongEntry first = {"cells", static_cast<std::uint64_t>(b - right.begin()),
                            is_more ? "not listed" : text_of(*b),
                            is_missing ? "not listed" : text_of(*a)};
  for (auto& [cause, cells] : mistakes_with(expected.sorted, right)) {
    if (are_equal(has, cells)) return {first, cause};
  }
  return {first};
}

}  // namespace octocell::hand_in
