// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted objects, cell index. Writes certain pairs, and uncertain pairs for stage 6.
// Cost: 16 bytes gathered per id, then about one vector operation per eight candidates.
// Idea: float32 with a proved filter decides all but a few pairs in a million. The rule, which
//       chooses the one cell where a pair counts, is evaluated only for pairs that may overlap.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pair_rule.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/pair_sink.hpp"
#include "impl_cpu/tile.hpp"

namespace octocell::cpu {
namespace {

constexpr std::uint64_t kCellsPerBlock = block_size(512, 8);
constexpr std::uint64_t kPrefetchAhead = 24;

// The rules (core/pair_rule.hpp), each as a type of its own: the innermost loop does not branch.

/// brute_force: every pair counts.
struct EveryPair {
  static constexpr bool rows_are_homes = false;
  [[nodiscard]] bool counts_here(Object, Object) const { return true; }
};

struct LowestCell {
  static constexpr bool rows_are_homes = false;
  [[nodiscard]] bool counts_here(Object a, Object b) const { return is_lowest_of_both(a, b); }
};

struct Chapter32 {
  static constexpr bool rows_are_homes = true;
  const chapter32::ControlBits* control_bits;
  [[nodiscard]] bool counts_here(Object a, Object b) const {
    return counts_by_chapter32(control_bits[a & kIdMask], control_bits[b & kIdMask]);
  }
};

struct AsWritten {
  static constexpr bool rows_are_homes = true;
  const Sphere* spheres;
  float side;
  [[nodiscard]] bool counts_here(Object a, Object b) const {
    return counts_as_written(spheres[a & kIdMask], spheres[b & kIdMask], (b & kPhantom) != 0, side);
  }
};

/// `recorded`: the run writes down each candidate. A type of its own, so that others need not ask.
template <PairTest test, typename RuleTest, bool recorded>
class PairTester {
 public:
  PairTester(Workspace& w, RuleTest rule) : w_(w), rule_(rule), sink_(w) {}

  void load_cell(Tile<test>& tile, std::uint64_t begin, std::uint64_t count) {
    if constexpr (recorded) cell_id_ = w_.ids[w_.current].cell_ids[begin];
    const Object* objects = w_.ids[w_.current].objects.data();
    tile.size = 0;
    for (std::uint64_t k = begin; k < begin + count; ++k) {
      if (k + kPrefetchAhead < w_.id_count) {
        __builtin_prefetch(&w_.scene.spheres[objects[k + kPrefetchAhead] & kIdMask]);
      }
      tile.push(w_.scene.spheres[objects[k] & kIdMask], objects[k], w_.plan.packing);
    }
    tile.pad();
  }

  void load_spheres(Tile<test>& tile, std::uint64_t begin, std::uint64_t count) const {
    tile.size = 0;
    for (std::uint64_t k = begin; k < begin + count; ++k) {
      tile.push(w_.scene.spheres[k], static_cast<Object>(k), w_.plan.packing);
    }
    tile.pad();
  }

  /// Tests the first `rows` spheres of the tile against all that follow them.
  void test_within(const Tile<test>& tile, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) test_row(tile, i, tile, i + 1);
  }

  void test_between(const Tile<test>& a, std::size_t rows, const Tile<test>& b) {
    for (std::size_t i = 0; i < rows; ++i) test_row(a, i, b, 0);
  }

 private:
  void test_row(const Tile<test>& a, std::size_t i, const Tile<test>& b, std::size_t first) {
    for (std::size_t j = first; j < b.size; j += Tile<test>::kLanes) {
      const LaneBits found = b.may_overlap(a, i, j);
      if constexpr (recorded) {
        const auto lanes = std::min<std::size_t>(Tile<test>::kLanes, b.size - j);
        for (std::uint32_t lane = 0; lane < lanes; ++lane) {
          const Object other = b.object[j + lane];
          const bool may_overlap = (found >> lane & 1U) != 0;
          write_down(a.object[i], other, may_overlap ? take(a.object[i], other) : Judgement::apart);
        }
      } else {
        for_each_lane(found, [&](std::uint32_t lane) { take(a.object[i], b.object[j + lane]); });
      }
    }
  }

  void write_down(Object a, Object b, Judgement judgement) {
    w_.record->considered.items.push_back({a & kIdMask, b & kIdMask, cell_id_, judgement});
  }

  Judgement take(Object a, Object b) {
    if (!rule_.counts_here(a, b)) return Judgement::other_cell;
    const std::span<const Sphere> spheres = w_.scene.spheres;
    const std::uint32_t id_a = a & kIdMask;
    const std::uint32_t id_b = b & kIdMask;
    return sink_.take<test>(stored<test>(spheres[id_a]), id_a, stored<test>(spheres[id_b]), id_b);
  }

  Workspace& w_;
  RuleTest rule_;
  PairSink sink_;
  std::uint32_t cell_id_ = 0;  // of the loaded cell; only for a record
};

/// Tests all pairs of `count` members, tile by tile; threads share the rows of tiles. load(tester,
/// tile, offset, size) fills a tile. Only the first `rows` members act as rows.
template <PairTest test, bool recorded, typename RuleTest, typename Load>
void test_tiles(Workspace& w, RuleTest rule, std::uint64_t rows, std::uint64_t count, Load load) {
  const std::uint64_t row_tiles = (rows + kTileSpheres - 1) / kTileSpheres;
  w.threads->for_blocks(row_tiles, 1, [&](std::uint64_t tile, std::uint64_t) {
    PairTester<test, RuleTest, recorded> tester(w, rule);
    Tile<test> a;
    Tile<test> b;
    const std::uint64_t begin = tile * kTileSpheres;
    load(tester, a, begin, std::min<std::uint64_t>(kTileSpheres, count - begin));
    const std::size_t rows_here = std::min<std::uint64_t>(a.size, rows - begin);
    tester.test_within(a, rows_here);
    for (std::uint64_t next = begin + kTileSpheres; next < count; next += kTileSpheres) {
      load(tester, b, next, std::min<std::uint64_t>(kTileSpheres, count - next));
      tester.test_between(a, rows_here, b);
    }
  });
}

template <PairTest test, bool recorded, typename RuleTest>
void test_crowded_cell(Workspace& w, RuleTest rule, const CellEntry& cell) {
  const std::uint64_t members = cell.homes + std::uint64_t{cell.phantoms};
  test_tiles<test, recorded>(
      w, rule, RuleTest::rows_are_homes ? cell.homes : members, members,
      [&](auto& tester, Tile<test>& tile, std::uint64_t offset, std::uint64_t size) {
        tester.load_cell(tile, cell.begin + offset, size);
      });
}

/// Tests cells that fit into a tile, block by block; then the larger ones, each by all threads.
template <PairTest test, bool recorded, typename RuleTest>
void test_cells(Workspace& w, RuleTest rule) {
  const std::span<const CellEntry> cells = w.cells.items();
  w.crowded_cells.clear();
  w.threads->for_blocks(cells.size(), kCellsPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
    PairTester<test, RuleTest, recorded> tester(w, rule);
    Tile<test> tile;
    for (std::uint64_t c = begin; c < end; ++c) {
      const CellEntry& cell = cells[c];
      const std::uint64_t members = cell.homes + std::uint64_t{cell.phantoms};
      if (members > kTileSpheres) {
        const auto index = static_cast<std::uint32_t>(c);
        w.crowded_cells.append({&index, 1});
        continue;
      }
      tester.load_cell(tile, cell.begin, members);
      tester.test_within(tile, RuleTest::rows_are_homes ? cell.homes : members);
    }
  });
  for (const std::uint32_t c : w.crowded_cells.items()) {
    test_crowded_cell<test, recorded>(w, rule, cells[c]);
  }
}

template <PairTest test, bool recorded>
void test_all_spheres(Workspace& w) {
  const std::uint64_t count = w.scene.spheres.size();
  test_tiles<test, recorded>(w, EveryPair{}, count, count,
                             [](auto& tester, Tile<test>& tile, std::uint64_t begin,
                                std::uint64_t size) { tester.load_spheres(tile, begin, size); });
}

template <PairTest test, bool recorded = false>
void run(Workspace& w) {
  if constexpr (may_be_exact(test) && !recorded) {
    if (w.record != nullptr) return run<test, true>(w);
  }
  if (w.plan.method == Method::brute_force) return test_all_spheres<test, recorded>(w);
  switch (w.plan.rule) {
    case Rule::lowest_cell:
      return test_cells<test, recorded>(w, LowestCell{});
    case Rule::chapter32:
      return test_cells<test, recorded>(w, Chapter32{w.control_bits.data()});
    case Rule::as_written:
      return test_cells<test, recorded>(
          w, AsWritten{w.scene.spheres.data(), as_written::cell_side(w.plan.facts.r_max)});
  }
}

}  // namespace

void pair_tests(Workspace& w) {
  w.pairs.clear(w.plan.count_only);
  w.uncertain_pairs.clear();
  if (w.plan.method == Method::brute_force && !w.scene.spheres.empty()) {
    const std::uint64_t count = w.scene.spheres.size();
    w.candidates = count * (count - 1) / 2;
  }
  if (!w.may_test_pairs()) return;
  if (w.plan.method == Method::half_shell) return half_shell::pair_tests(w);
  with_pair_test(w.plan.test, [&]<PairTest test>() { run<test>(w); });
}

}  // namespace octocell::cpu
