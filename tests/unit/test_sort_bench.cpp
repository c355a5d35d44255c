// SPDX-License-Identifier: MIT
// The checks that bench-sort makes, and the sorts themselves at awkward sizes.
#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "harness/bench/sort/algorithms.hpp"
#include "harness/bench/sort/sort_cases.hpp"
#include "harness/bench/sort/sort_check.hpp"

namespace octocell::bench {
namespace {

using Column = std::vector<std::uint32_t>;

/// Input: keys 7 3 7 3 9 with values 0 1 2 3 4.
std::string fault(const Column& keys, const Column& values, bool stable = true) {
  const SortTruth truth = {5, pairs_checksum(Column{7, 3, 7, 3, 9}, Column{0, 1, 2, 3, 4})};
  return fault_of(keys, values, truth, stable).value_or("none");
}

TEST(SortCheck, AcceptsTheStableAnswer) {
  EXPECT_EQ(fault({3, 3, 7, 7, 9}, {1, 3, 0, 2, 4}), "none");
}

TEST(SortCheck, EqualKeysMayChangePlacesOnlyWhereNotStable) {
  EXPECT_EQ(fault({3, 3, 7, 7, 9}, {3, 1, 0, 2, 4}, false), "none");
  EXPECT_EQ(fault({3, 3, 7, 7, 9}, {3, 1, 0, 2, 4}),
            "not stable: values 3 and 1 of key 3 changed places at 1");
}

TEST(SortCheck, SeesWhatIsNotSorted) {
  EXPECT_EQ(fault({3, 7, 3, 7, 9}, {1, 0, 3, 2, 4}), "not sorted: key 3 at 2 comes after 7");
}

TEST(SortCheck, SeesPairsThatAreNotThoseOfTheInput) {
  const std::string lost = "not a permutation: the pairs are not those of the input";
  EXPECT_EQ(fault({3, 3, 7, 7, 9}, {1, 3, 0, 2, 3}), lost);  // a value twice
  EXPECT_EQ(fault({3, 3, 7, 7, 8}, {1, 3, 0, 2, 4}), lost);  // another key
  EXPECT_EQ(fault({3, 3, 7, 7, 9}, {0, 3, 1, 2, 4}), lost);  // values with each other's keys
  EXPECT_EQ(fault({0, 0, 0, 0, 0}, {0, 0, 0, 0, 0}), lost);
  EXPECT_EQ(fault({3, 3, 7, 7}, {1, 3, 0, 2}), "4 keys and 4 values instead of 5");
}

TEST(SortCheck, TheChecksumDoesNotDependOnTheOrder) {
  EXPECT_EQ(pairs_checksum(Column{1, 2}, Column{3, 4}), pairs_checksum(Column{2, 1}, Column{4, 3}));
  EXPECT_NE(pairs_checksum(Column{1, 2}, Column{3, 4}), pairs_checksum(Column{1, 2}, Column{4, 3}));
}

TEST(SortCases, KeysStayBelowTheirWidth) {
  for (const SortCase& what : sort_cases("full")) {
    if (what.n > 1u << 14) continue;
    for (const std::uint32_t key : make_keys(what)) {
      ASSERT_LT(std::uint64_t{key}, std::uint64_t{1} << what.bits) << name_of(what.order);
    }
  }
}

TEST(SortAlgorithms, SortAtEverySize) {
  for (const Algorithm& how : sort_algorithms()) {
    if (how.create == nullptr) continue;
    for (const std::uint32_t n : {0u, 1u, 2u, 3u, 255u, 1000u, 4097u}) {
      for (const Order order : {Order::random, Order::reversed, Order::few_distinct}) {
        for (const int threads : {1, 3}) {
          const SortCase what = {n, 17, order};
          Workspace work(n);
          work.front.keys = make_keys(what);
          std::iota(work.front.values.begin(), work.front.values.end(), 0u);
          const SortTruth truth = {n, pairs_checksum(work.front.keys, work.front.values)};
          const PairArrays& sorted = how.create(threads)->sort(work, what.bits);
          EXPECT_EQ(fault_of(sorted.keys, sorted.values, truth, how.stable).value_or("none"),
                    "none")
              << how.name << " n=" << n << " " << name_of(order) << " threads=" << threads;
        }
      }
    }
  }
}

}  // namespace
}  // namespace octocell::bench
