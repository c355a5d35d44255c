// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

struct Golden {
  const char* spec;
  std::uint64_t count;
  std::uint64_t checksum;
};

// Printed by `octocell find SPEC --json`, and confirmed by the reference when they were pinned.
constexpr Golden kGolden[] = {
#include "tests/support/golden_checksums.inc"
};

TEST(Determinism, EveryBackendGivesTheGoldenChecksums) {
  for (const BackendInfo& backend : backends()) {
    if (backend.kind == Kind::baseline || backend.why_unavailable()) continue;
    for (const Golden& golden : kGolden) {
      const auto finder = backend.create();
      find_completely(*finder, generate(golden.spec).view(), {});
      EXPECT_EQ(finder->digest(), (PairDigest{golden.count, golden.checksum})) << golden.spec;
    }
  }
}

constexpr Golden kGoldenAsWritten[] = {
#include "tests/support/golden_as_written.inc"
};

TEST(Determinism, TheNegativeControlLosesTheSamePairsOnEveryBackend) {
  for (const BackendInfo& backend : backends()) {
    if (backend.kind == Kind::baseline || backend.why_unavailable()) continue;
    for (const Golden& golden : kGoldenAsWritten) {
      const auto finder = backend.create();
      find_completely(*finder, generate(golden.spec).view(), {.rule = Rule::as_written});
      EXPECT_EQ(finder->digest(), (PairDigest{golden.count, golden.checksum})) << golden.spec;
    }
  }
}

TEST(Determinism, ThreadCountsAndRepetitionsDoNotMatter) {
  for (const char* spec : {kSanitized ? "dense:n=5000" : "dense:n=20000",
                           kSanitized ? "lattice:n=5000" : "lattice:n=20000", "giant:n=5000",
                           kSanitized ? "identical:n=1000" : "identical:n=3000"}) {
    const Scene scene = generate(spec);
    for (const Rule rule : {Rule::lowest_cell, Rule::chapter32, Rule::as_written}) {
      std::optional<PairDigest> first;
      for (const int threads : {1, 2, 3, 7}) {
        const auto finder = backend_named("impl_cpu").create();
        find_completely(*finder, scene.view(), {.rule = rule, .threads = threads});
        for (int again = 0; again < 3; ++again) {
          if (!first) first = finder->digest();
          ASSERT_EQ(finder->digest(), *first) << spec << ", " << threads << " threads";
          HostClock clock;
          finder->find_pairs(clock);
        }
      }
    }
  }
}

TEST(Determinism, AFinderForgetsTheSceneBefore) {
  const Scene a = generate("gas:n=5000");
  const Scene b = generate(kSanitized ? "lattice:n=3000" : "lattice:n=20000");
  for (const Implementation& how : implementations()) {
    if (how.backend->why_unavailable()) continue;
    const auto finder = how.backend->create();
    const PlanOptions options = how.plan_options();
    find_completely(*finder, a.view(), options);
    const PairDigest first = finder->digest();
    find_completely(*finder, b.view(), options);
    EXPECT_NE(finder->digest(), first) << how.label();
    find_completely(*finder, a.view(), options);
    EXPECT_EQ(finder->digest(), first) << how.label();
    find_completely(*finder, {}, options);
    EXPECT_EQ(finder->digest(), PairDigest{}) << how.label();
  }
}

}  // namespace
}  // namespace octocell
