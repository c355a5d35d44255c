// SPDX-License-Identifier: MIT
// Stage 5, pair_tests: which spheres that share a cell overlap?
// Reads spheres, sorted objects, cell index. Writes sure pairs, and doubts for stage 6.
// Cost: 16 bytes gathered an id, then about one vector operation a candidate and eighth.
// Idea: float32 with a proved band decides all but a few pairs in a million; the rule that names
//       the one cell in which a pair counts is asked only for pairs that may overlap.
#include "harness/interface/as_written.hpp"
#include "harness/interface/faults.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/pair_sink.hpp"
#include "impl_cpu/tile.hpp"

namespace octocell::cpu {
namespace {

constexpr std::uint64_t kCellsPerBlock = 512;
constexpr std::uint64_t kPrefetchAhead = 24;

/// brute_force: every pair counts.
struct EveryPair {
  static constexpr bool rows_are_homes = false;
  [[nodiscard]] bool counts_here(const Tile&, std::size_t, const Tile&, std::size_t) const {
    return true;
  }
};

/// The cell must be the lowest that both spheres meet: on each axis, the lowest of one of them.
/// (Dittrich and Seeger, ICDE 2000, reference point method.)
struct LowestCell {
  static constexpr bool rows_are_homes = false;
  [[nodiscard]] bool counts_here(const Tile& a, std::size_t i, const Tile& b, std::size_t j) const {
    return OCTOCELL_FAULT(lowest_cell_rule_dropped, true,
                          ((a.object[i] | b.object[j]) & kLowestMask) == kLowestMask);
  }
};

/// A row is a home, so its home's type is the cell's.
struct Chapter32 {
  static constexpr bool rows_are_homes = true;
  const chapter32::ControlBits* control_bits;
  [[nodiscard]] bool counts_here(const Tile& a, std::size_t i, const Tile& b, std::size_t j) const {
    const chapter32::ControlBits row = control_bits[a.id(i)];
    return chapter32::tests_pair_here(row & 7U, row, control_bits[b.id(j)]);
  }
};

/// The course text: home with home; home with phantom if the phantom's home id is the larger.
struct AsWritten {
  static constexpr bool rows_are_homes = true;
  float side;
  [[nodiscard]] bool counts_here(const Tile& a, std::size_t i, const Tile& b, std::size_t j) const {
    if ((b.object[j] & kPhantom) == 0) return true;
    const auto home_id = [&](const Tile& t, std::size_t k) {
      return as_written::hash(as_written::home(t.sphere(k), side));
    };
    return home_id(b, j) > home_id(a, i);
  }
};

template <Band band, typename RuleTest>
class PairTester {
 public:
  PairTester(Workspace& w, RuleTest rule) : w_(w), rule_(rule), sink_(w) {}

  void load_cell(Tile& tile, std::uint64_t begin, std::uint64_t count) const {
    const Object* objects = w_.ids[w_.current].objects.data();
    tile.size = 0;
    for (std::uint64_t k = begin; k < begin + count; ++k) {
      if (k + kPrefetchAhead < w_.id_count) {
        __builtin_prefetch(&w_.scene.spheres[objects[k + kPrefetchAhead] & kIdMask]);
      }
      tile.push<band>(w_.scene.spheres[objects[k] & kIdMask], objects[k]);
    }
    tile.pad();
  }

  void load_spheres(Tile& tile, std::uint64_t begin, std::uint64_t count) const {
    tile.size = 0;
    for (std::uint64_t k = begin; k < begin + count; ++k) {
      tile.push<band>(w_.scene.spheres[k], static_cast<Object>(k));
    }
    tile.pad();
  }

  /// The first `rows` of the tile against all that follow them.
  void test_within(const Tile& tile, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i)
      test_row(tile, i, tile, OCTOCELL_FAULT(tile_pairs_with_self, i, i + 1));
  }

  void test_between(const Tile& a, std::size_t rows, const Tile& b) {
    for (std::size_t i = 0; i < rows; ++i) test_row(a, i, b, 0);
  }

 private:
  void test_row(const Tile& a, std::size_t i, const Tile& b, std::size_t first) {
    const Sphere row = a.sphere(i);
    for (std::size_t j = first; j < b.size; j += kLanes) {
      if (b.any_may_overlap(row, j)) test_lanes(a, i, b, j);
    }
  }

  void test_lanes(const Tile& a, std::size_t i, const Tile& b, std::size_t first) {
    const Sphere row = a.sphere(i);
    for (std::size_t j = first; j < std::min(first + kLanes, b.size); ++j) {
      const Sphere column = b.sphere(j);
      if (!band_may_overlap(row, column) || !rule_.counts_here(a, i, b, j)) continue;
      sink_.take<band>(row, a.id(i), column, b.id(j));
    }
  }

  Workspace& w_;
  RuleTest rule_;
  PairSink sink_;
};

/// All tile pairs of `count` members, tile rows shared out among the threads.
/// load(tester, tile, offset, size) fills a tile; only the first `rows` members act as rows.
template <Band band, typename RuleTest, typename Load>
void test_tiles(Workspace& w, RuleTest rule, std::uint64_t rows, std::uint64_t count, Load load) {
  const std::uint64_t row_tiles = (rows + kTileSpheres - 1) / kTileSpheres;
  w.threads->for_blocks(row_tiles, 1, [&](std::uint64_t tile, std::uint64_t) {
    PairTester<band, RuleTest> tester(w, rule);
    Tile a;
    Tile b;
    const std::uint64_t begin = tile * kTileSpheres;
    load(tester, a, begin, std::min<std::uint64_t>(kTileSpheres, count - begin));
    const std::size_t rows_here = std::min<std::uint64_t>(a.size, rows - begin);
    tester.test_within(a, rows_here);
    for (std::uint64_t next = begin + kTileSpheres;
         OCTOCELL_FAULT(tile_last_missing, next + kTileSpheres < count, next < count);
         next += kTileSpheres) {
      load(tester, b, next, std::min<std::uint64_t>(kTileSpheres, count - next));
      tester.test_between(a, rows_here, b);
    }
  });
}

template <Band band, typename RuleTest>
void test_crowded_cell(Workspace& w, RuleTest rule, const CellEntry& cell) {
  const std::uint64_t members = cell.homes + std::uint64_t{cell.phantoms};
  test_tiles<band>(w, rule, RuleTest::rows_are_homes ? cell.homes : members, members,
                   [&](auto& tester, Tile& tile, std::uint64_t offset, std::uint64_t size) {
                     tester.load_cell(tile, cell.begin + offset, size);
                   });
}

/// Cells that fit a tile, block by block; then the crowded ones, each by all threads.
template <Band band, typename RuleTest>
void test_cells(Workspace& w, RuleTest rule) {
  const std::span<const CellEntry> cells = w.cells.items();
  w.crowded_cells.clear();
  w.threads->for_blocks(cells.size(), kCellsPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
    PairTester<band, RuleTest> tester(w, rule);
    Tile tile;
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
    test_crowded_cell<band>(w, rule, cells[c]);
  }
}

template <Band band>
void test_all_spheres(Workspace& w) {
  const std::uint64_t count = w.scene.spheres.size();
  test_tiles<band>(w, EveryPair{}, count, count,
                   [](auto& tester, Tile& tile, std::uint64_t begin, std::uint64_t size) {
                     tester.load_spheres(tile, begin, size);
                   });
}

template <Band band>
void run(Workspace& w) {
  if (w.plan.method == Method::brute_force) return test_all_spheres<band>(w);
  switch (w.plan.rule) {
    case Rule::lowest_cell:
      return test_cells<band>(w, LowestCell{});
    case Rule::chapter32:
      return test_cells<band>(w, Chapter32{w.control_bits.data()});
    case Rule::as_written:
      return test_cells<band>(w, AsWritten{as_written::cell_side(w.plan.facts.r_max)});
  }
}

}  // namespace

void pair_tests(Workspace& w) {
  w.pairs.clear(w.plan.count_only);
  w.doubts.clear();
  if (w.plan.method == Method::brute_force && !w.scene.spheres.empty()) {
    const std::uint64_t count = w.scene.spheres.size();
    w.candidates = count * (count - 1) / 2;
  }
  if (!w.may_test_pairs()) return;
  if (w.plan.method == Method::half_shell) return half_shell::pair_tests(w);
  if (w.plan.band == Band::fast) return run<Band::fast>(w);
  run<Band::safe>(w);
}

}  // namespace octocell::cpu
