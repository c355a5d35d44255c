// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "harness/scenes/scenes.hpp"
#include "tests/support/cpu_pipeline.hpp"

namespace octocell::cpu {
namespace {

std::unique_ptr<Workspace> after_cell_index(const Scene& scene, const PlanOptions& options) {
  auto w = workspace_for(scene.view(), options);
  bounds(*w);
  cell_ids(*w);
  sort(*w);
  cell_index(*w);
  return w;
}

struct Members {
  std::uint32_t homes = 0;
  std::uint32_t phantoms = 0;
};

std::map<std::uint32_t, Members> count_members(const Workspace& w) {
  std::map<std::uint32_t, Members> cells;
  for (std::uint64_t k = 0; k < w.id_count; ++k) {
    Members& m = cells[sorted_ids(w)[k]];
    ++((sorted_objects(w)[k] & kPhantom) != 0 ? m.phantoms : m.homes);
  }
  return cells;
}

class CellIndexOfARule : public testing::TestWithParam<Rule> {};

TEST_P(CellIndexOfARule, HoldsEveryCellWithSomethingToTestAndItsCounts) {
  for (const char* spec : {"gas:n=0", "gas:n=1", "gas:n=2", "gas:n=50001", "identical:n=300"}) {
    const Scene scene = generate(spec);
    for (const int threads : {1, 3}) {
      const auto w = after_cell_index(scene, {.rule = GetParam(), .threads = threads});
      std::map<std::uint32_t, Members> expected = count_members(*w);
      std::uint64_t candidates = 0;
      for (const CellEntry& cell : w->cells.items()) {
        const std::uint32_t id = sorted_ids(*w)[cell.begin];
        ASSERT_TRUE(cell.begin == 0 || sorted_ids(*w)[cell.begin - 1] != id) << "begins mid-cell";
        ASSERT_TRUE(expected.contains(id)) << "listed twice";
        ASSERT_EQ(cell.homes, expected[id].homes);
        ASSERT_EQ(cell.phantoms, expected[id].phantoms);
        const std::uint64_t h = cell.homes;
        const std::uint64_t all = h + cell.phantoms;
        candidates += GetParam() == Rule::lowest_cell ? all * (all - 1) / 2
                                                      : h * (h - 1) / 2 + h * cell.phantoms;
        expected.erase(id);
      }
      for (const auto& [id, m] : expected) {
        const bool nothing_to_test =
            m.homes + m.phantoms < 2 || (GetParam() != Rule::lowest_cell && m.homes == 0);
        ASSERT_TRUE(nothing_to_test) << spec << ": cell " << id << " is missing";
      }
      EXPECT_EQ(w->candidates, candidates);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, CellIndexOfARule,
                         testing::Values(Rule::lowest_cell, Rule::chapter32, Rule::as_written),
                         [](const auto& rule) { return std::string(name_of(rule.param)); });

TEST(CellIndex, CandidatesStayInProportionOnRandomScenes) {
  for (const char* spec : {"gas:n=20000", "poly:n=20000", "giant:n=20000", "shifted:n=20000",
                           "cluster:n=20000", "discs:n=20000", "chain:n=20000"}) {
    const Scene scene = generate(spec);
    const auto w = after_cell_index(scene, {});
    EXPECT_LT(w->candidates, 100 * scene.spheres.size()) << spec;
    EXPECT_LT(w->id_count, 8 * scene.spheres.size()) << spec;
  }
}

}  // namespace
}  // namespace octocell::cpu
