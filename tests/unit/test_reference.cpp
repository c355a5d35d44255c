// SPDX-License-Identifier: MIT
// Compares the reference with itself (two methods) and with counts known in closed form.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::reference {
namespace {

std::vector<Sphere> integer_lattice(int side, float radius) {
  std::vector<Sphere> spheres;
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        spheres.push_back(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), radius});
      }
    }
  }
  return spheres;
}

/// Pairs of points of an n^3 lattice at squared distance <= m: half of the sum over all vectors v,
/// 0 < |v|^2 <= m, of the product of (n - |v_i|).
std::uint64_t lattice_pairs(int n, int m) {
  const int reach = static_cast<int>(std::sqrt(m)) + 1;
  std::uint64_t twice = 0;
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const int d2 = x * x + y * y + z * z;
        if (d2 == 0 || d2 > m) continue;
        twice += static_cast<std::uint64_t>(n - std::abs(x)) *
                 static_cast<std::uint64_t>(n - std::abs(y)) *
                 static_cast<std::uint64_t>(n - std::abs(z));
      }
    }
  }
  return twice / 2;
}

TEST(Reference, CountsIntegerLatticesAsTheClosedFormDoes) {
  EXPECT_EQ(lattice_pairs(20, 1), 3U * 20 * 20 * 19);
  // r = 0.5 is tangent (m = 1), r = 0.75 reaches 1.5 (m = 2), r = 1 reaches 2 (m = 4), r = 1.5 (m =
  // 9).
  const std::pair<float, int> kCases[] = {{0.25F, 0}, {0.5F, 1}, {0.75F, 2}, {1.0F, 4}, {1.5F, 9}};
  for (const auto& [radius, m] : kCases) {
    EXPECT_EQ(box_tree(integer_lattice(16, radius)).size(), lattice_pairs(16, m)) << radius;
    EXPECT_EQ(brute_force(integer_lattice(7, radius)).size(), lattice_pairs(7, m)) << radius;
  }
}

TEST(Reference, BothMethodsAgree) {
  for (const char* spec : {"gas:n=3000", "dense:n=2000", "poly:n=3000", "cluster:n=3000",
                           "lattice:n=3000", "shifted:n=3000,offset=1e7", "giant:n=3000",
                           "identical:n=500", "discs:n=3000", "chain:n=1000", "fcc:n=3000"}) {
    const Scene scene = generate(spec);
    EXPECT_EQ(brute_force(scene.spheres), box_tree(scene.spheres)) << spec;
  }
}

TEST(Reference, BothMethodsAgreeOnRandomBits) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<Sphere> spheres;
    while (spheres.size() < 200) {
      float v[4];
      for (float& f : v) f = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
      const Sphere s = {v[0], v[1], v[2], std::fabs(v[3])};
      if (std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.r)) {
        spheres.push_back(s);
      }
    }
    ASSERT_EQ(brute_force(spheres), box_tree(spheres));
  }
}

TEST(Reference, DecidesFloat64SpheresExactly) {
  const DoubleSphere a = {0, 0, 0, 0.5};
  EXPECT_TRUE(overlap(a, DoubleSphere{1.0, 0, 0, 0.5}));
  EXPECT_FALSE(overlap(a, DoubleSphere{std::nextafter(1.0, 2.0), 0, 0, 0.5}));
  EXPECT_FALSE(overlap(DoubleSphere{0, 0, 0, 0}, DoubleSphere{5e-324, 0, 0, 0}));
  EXPECT_TRUE(overlap(DoubleSphere{-1e308, 0, 0, 1e308}, DoubleSphere{1e308, 0, 0, 1e308}));
  EXPECT_FALSE(overlap(DoubleSphere{-1e308, 0, 0, 1e307}, DoubleSphere{1e308, 0, 0, 1e307}));
}

TEST(Reference, NamesWhatAnAnswerGetsWrong) {
  const std::vector<Pair> truth = {{0, 1}, {0, 2}, {3, 4}, {5, 6}};
  const std::vector<Pair> answer = {{0, 1}, {0, 1}, {0, 3}, {3, 4}, {7, 8}, {7, 8}};
  const Comparison difference = compare(answer, truth);
  EXPECT_EQ(difference.missed, 2U);
  EXPECT_EQ(difference.false_pairs, 2U);
  EXPECT_EQ(difference.duplicates, 2U);
  EXPECT_TRUE(compare(truth, truth).exact());
  EXPECT_EQ(compare({}, truth).missed, 4U);
}

TEST(PairDigest, IgnoresOrderAndSeesEverythingElse) {
  const std::vector<Pair> pairs = {{0, 1}, {0, 2}, {3, 4}};
  const PairDigest digest = digest_of(pairs);
  const std::vector<Pair> shuffled = {pairs[2], pairs[0], pairs[1]};
  EXPECT_EQ(digest, digest_of(shuffled));
  const std::vector<Pair> duplicated = {pairs[0], pairs[1], pairs[2], pairs[2]};
  EXPECT_NE(digest, digest_of(duplicated));
  const std::vector<Pair> other = {{0, 1}, {0, 2}, {3, 5}};
  EXPECT_NE(digest, digest_of(other));
  PairDigest merged = digest_of(std::span(pairs).first(1));
  merged.merge(digest_of(std::span(pairs).subspan(1)));
  EXPECT_EQ(digest, merged);
}

}  // namespace
}  // namespace octocell::reference
