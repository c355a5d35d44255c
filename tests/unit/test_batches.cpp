// SPDX-License-Identifier: MIT
// Many systems in one call: the pairs are those of each system alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "include/octocell/octocell.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

using List = std::vector<Pair>;

struct Systems {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> batch;
};

/// Systems of different kinds, all about the same place, with numbers that are not all used.
Systems systems(int count, bool shuffled) {
  Systems all;
  const char* const specs[] = {"gas:n=60", "lattice:n=27", "poly:n=40", "identical:n=5",
                               "chain:n=9"};
  for (int k = 0; k < count; ++k) {
    const Scene scene = generate(specs[k % 5]);
    for (const Sphere& s : scene.spheres) {
      all.spheres.push_back(s);
      all.batch.push_back(static_cast<std::uint32_t>(3 * k + 1));
    }
  }
  if (!shuffled) return all;
  std::vector<std::size_t> order(all.spheres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  Systems mixed;
  for (const std::size_t k : order) {
    mixed.spheres.push_back(all.spheres[k]);
    mixed.batch.push_back(all.batch[k]);
  }
  return mixed;
}

/// Searches each system alone.
List one_by_one(const Systems& all, const Options& options) {
  List list;
  const std::uint32_t last = *std::ranges::max_element(all.batch);
  for (std::uint32_t b = 0; b <= last; ++b) {
    std::vector<Sphere> some;
    std::vector<std::uint32_t> ids;
    for (std::uint32_t i = 0; i < all.batch.size(); ++i) {
      if (all.batch[i] != b) continue;
      some.push_back(all.spheres[i]);
      ids.push_back(i);
    }
    for (const Pair& pair : find_pairs(some, options)) list.push_back({ids[pair.i], ids[pair.j]});
  }
  std::ranges::sort(list);
  return list;
}

List listed(const Pairs& pairs) { return {pairs.begin(), pairs.end()}; }

TEST(Batches, PairsAreThoseOfEachSystemAlone) {
  for (const bool shuffled : {false, true}) {
    for (const int count : {1, 2, kSanitized ? 20 : 100}) {
      const Systems all = systems(count, shuffled);
      const List truth = one_by_one(all, {});
      ASSERT_FALSE(truth.empty());
      const Options options = {.threads = 2, .batch = all.batch};
      EXPECT_EQ(listed(find_pairs(all.spheres, options)), truth);
      EXPECT_EQ(octocell::count(all.spheres, options), truth.size());
      Finder finder(options);
      EXPECT_EQ(finder.find(all.spheres).size(), truth.size());
    }
  }
}

TEST(Batches, ABoxAndACutoffHoldForEachSystem) {
  const Systems all = systems(kSanitized ? 10 : 30, true);
  const Box box = {.vector = {{7, 0, 0}, {1, 7, 0}, {0, 2, 8}}};
  const Options options = {.box = box, .cutoff = 0.25};
  Options batches = options;
  batches.batch = all.batch;
  EXPECT_EQ(listed(find_pairs(all.spheres, batches)), one_by_one(all, options));
}

TEST(Batches, SystemsFarApartAndOfAnySizeAreExact) {
  Systems all = systems(20, false);
  for (std::size_t i = 0; i < all.spheres.size(); ++i) {
    const float scale = all.batch[i] % 2 == 0 ? 0x1p-20F : 0x1p20F;
    Sphere& s = all.spheres[i];
    s = {s.x * scale, s.y * scale + 0x1p30F, s.z * scale, s.r * scale};
  }
  EXPECT_EQ(listed(find_pairs(all.spheres, {.batch = all.batch})), one_by_one(all, {}));
}

TEST(Batches, TheNumbersMustFit) {
  const std::vector<Sphere> two = {{0, 0, 0, 1}, {1, 0, 0, 1}};
  const std::vector<std::uint32_t> one = {7};
  const std::vector<std::uint32_t> large = {0, 1U << 28};
  EXPECT_THROW(count(two, {.batch = one}), Error);
  EXPECT_THROW(count(two, {.batch = large}), Error);
}

}  // namespace
}  // namespace octocell
