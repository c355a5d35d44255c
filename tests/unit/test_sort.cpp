// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "core/digit_plan.hpp"
#include "core/planner/planner.hpp"
#include "harness/scenes/scenes.hpp"
#include "impl_cpu/radix_sort.hpp"
#include "tests/support/cpu_pipeline.hpp"

namespace octocell::cpu {
namespace {

struct Items {
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> values;
  KeysAndValues spans() { return {keys, values}; }
  friend bool operator==(const Items&, const Items&) = default;
};

enum class Order { random, sorted, reversed, constant, few_values };

Items make_items(std::size_t count, int key_bits, Order order) {
  std::mt19937 random(static_cast<unsigned>(count) + 1);
  const std::uint32_t mask = key_bits == 32 ? ~0U : (1U << key_bits) - 1;
  Items items;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t r = static_cast<std::uint32_t>(random()) & mask;
    items.keys.push_back(order == Order::constant     ? mask / 2
                         : order == Order::few_values ? r % 3
                                                      : r);
  }
  if (order == Order::sorted) std::sort(items.keys.begin(), items.keys.end());
  if (order == Order::reversed) std::sort(items.keys.rbegin(), items.keys.rend());
  items.values.resize(count);
  std::iota(items.values.begin(), items.values.end(), 0U);  // so that stability shows
  return items;
}

Items stable_sorted(const Items& items) {
  std::vector<std::uint32_t> order(items.keys.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return items.keys[a] < items.keys[b]; });
  Items sorted;
  for (const std::uint32_t k : order) {
    sorted.keys.push_back(items.keys[k]);
    sorted.values.push_back(items.values[k]);
  }
  return sorted;
}

TEST(RadixSort, EqualsAStableSort) {
  for (const int threads : {1, 2, 3, 7}) {
    Threads pool(threads);
    for (const std::size_t count :
         {0, 1, 2, 3, 31, 32, 33, 255, 256, 257, 65535, 65536, 65537, 100003}) {
      for (const int bits : {0, 1, 7, 8, 9, 16, 17, 20, 31, 32}) {
        Items front = make_items(count, bits, Order::random);
        const Items expected = stable_sorted(front);
        Items back = {std::vector<std::uint32_t>(count), std::vector<std::uint32_t>(count)};
        const int where = radix_sort(front.spans(), back.spans(), bits, pool);
        ASSERT_EQ(where == 0 ? front : back, expected) << count << " keys of " << bits << " bits";
      }
    }
  }
}

TEST(RadixSort, AnyOrderOfTheInputWillDo) {
  Threads pool(2);
  for (const Order order : {Order::sorted, Order::reversed, Order::constant, Order::few_values}) {
    Items front = make_items(50001, 20, order);
    const Items expected = stable_sorted(front);
    Items back = {std::vector<std::uint32_t>(50001), std::vector<std::uint32_t>(50001)};
    const int where = radix_sort(front.spans(), back.spans(), 20, pool);
    EXPECT_EQ(where == 0 ? front : back, expected) << static_cast<int>(order);
  }
}

/// What a pass costs decides how many columns there are, so the planner must know how many the sort
/// will take.
TEST(RadixSort, TakesAsManyPassesAsThePlannerExpects) {
  Threads pool(2);
  for (int bits = 0; bits <= 32; ++bits) {
    Items front = make_items(10000, bits, Order::random);
    Items back = {std::vector<std::uint32_t>(10000), std::vector<std::uint32_t>(10000)};
    const int side = radix_sort(front.spans(), back.spans(), bits, pool);
    EXPECT_EQ(side, sort_passes(bits, Costs{}.digit_bits) % 2) << bits << " bits";
  }
}

TEST(Sort, GroupsCellsWithHomesBeforePhantoms) {
  for (const Rule rule : {Rule::lowest_cell, Rule::chapter32, Rule::as_written}) {
    for (const int threads : {1, 3}) {
      const Scene scene = generate("poly:n=20001");
      const auto w = workspace_for(scene.view(), {.rule = rule, .threads = threads});
      bounds(*w);
      cell_ids(*w);
      sort(*w);
      const auto ids = sorted_ids(*w);
      const auto objects = sorted_objects(*w);
      for (std::size_t k = 1; k < ids.size(); ++k) {
        ASSERT_LE(ids[k - 1], ids[k]) << k;
        const bool phantom_before_home = ids[k - 1] == ids[k] && (objects[k - 1] & kPhantom) != 0 &&
                                         (objects[k] & kPhantom) == 0;
        ASSERT_FALSE(phantom_before_home) << k;
      }
    }
  }
}

}  // namespace
}  // namespace octocell::cpu
