// SPDX-License-Identifier: MIT
// Generators: their bits, their promises, and the parameters that they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/overlap.hpp"
#include "harness/files/validate.hpp"
#include "harness/scenes/portable_math.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

/// FNV-1a, 64 bits, over the little-endian bytes of all floats.
std::uint64_t checksum(std::span<const Sphere> spheres) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Sphere& s : spheres) {
    for (const float value : {s.x, s.y, s.z, s.r}) {
      const auto bits = std::bit_cast<std::uint32_t>(value);
      for (int shift = 0; shift < 32; shift += 8) {
        hash = (hash ^ ((bits >> shift) & 0xffU)) * 0x100000001b3u;
      }
    }
  }
  return hash;
}

std::size_t count_pairs(std::span<const Sphere> spheres) {
  std::size_t pairs = 0;
  for (std::size_t j = 0; j < spheres.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) pairs += overlap_exact(spheres[i], spheres[j]);
  }
  return pairs;
}

std::string refusal(const std::string& spec) {
  try {
    generate(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refusal(const std::string& spec, const std::string& reason) {
  EXPECT_NE(refusal(spec).find(reason), std::string::npos) << spec << ": " << refusal(spec);
}

TEST(Scenes, HaveTheSameBitsEverywhere) {
  const std::pair<const char*, std::uint64_t> golden[] = {
      {"gas:n=1000", 0x754a169cf141f02cu},
      {"dense:n=1000", 0xf76c134208765e19u},
      {"poly:n=1000", 0x82a5974d55ed4fcfu},
      {"cluster:n=1000", 0x966479d7ecf888a0u},
      {"lattice:n=1000", 0x2e633854c2c61925u},
      {"shifted:n=1000", 0x09b5fca0cfb2774bu},
      {"giant:n=1000", 0x3846c985a2b250a8u},
      {"discs:n=1000", 0x5496ffad30d34e35u},
      {"identical:n=1000", 0xf58a0f97b24c5c25u},
      {"chain:n=1000", 0x50f731fccfcffeb2u},
      {"fcc:n=1000", 0x5ce490add47e6c5au},
      {"gas:n=1e5", 0xe9e4eaacbd63c926u},
      {"gas:n=1e5,seed=7", 0x8b4601bd7a7a697bu},
      {"lattice:n=1000,shuffle=1,spacing=0.1", 0x2d1e513751247585u},
      {"poly:n=1000,ratio=1000,seed=3", 0x42390096b6228c79u}};
  for (const auto& [spec, expected] : golden) {
    EXPECT_EQ(checksum(generate(spec).spheres), expected) << spec;
  }
}

TEST(Scenes, AllAreValidAndHaveAsManySpheresAsAsked) {
  std::set<std::string_view> names;
  for (const SceneInfo& info : scenes()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.summary.empty());
    for (const std::size_t n : {0, 1, 2, 63, 1000}) {
      const Scene scene = generate(std::string(info.name) + ":n=" + std::to_string(n));
      EXPECT_EQ(scene.spheres.size(), n) << info.name;
      EXPECT_NO_THROW(validate(scene.spheres, scene.spec));
      EXPECT_FALSE(scene.unrounded.has_value());
    }
  }
}

TEST(Scenes, RoundEachNumberOnceAndCanShowWhatItWas) {
  for (const SceneInfo& info : scenes()) {
    const Scene scene = generate(std::string(info.name) + ":n=1000", Unrounded::keep);
    ASSERT_TRUE(scene.unrounded.has_value()) << info.name;
    std::vector<Sphere> once;
    for (const DoubleSphere& s : *scene.unrounded) once.push_back(rounded(s));
    EXPECT_EQ(checksum(once), checksum(scene.spheres)) << info.name;
    const Scene rounded_only = generate(std::string(info.name) + ":n=1000");
    EXPECT_EQ(checksum(rounded_only.spheres), checksum(scene.spheres)) << info.name;
  }
  const Scene far = generate("shifted:n=1000,offset=1e7", Unrounded::keep);
  EXPECT_NE(far.unrounded->at(0).x, far.spheres[0].x);
}

TEST(Scenes, SpecSpeltOutGivesTheSameSceneAgain) {
  for (const SceneInfo& info : scenes()) {
    const Scene scene = generate(std::string(info.name) + ":n=300");
    const Scene again = generate(scene.spec);
    EXPECT_EQ(again.spec, scene.spec);
    EXPECT_EQ(checksum(again.spheres), checksum(scene.spheres)) << scene.spec;
    for (const ParameterInfo& parameter : info.parameters) {
      EXPECT_NE(scene.spec.find(std::string(parameter.name) + "="), std::string::npos);
      EXPECT_LE(parameter.lowest, parameter.preset);
      EXPECT_LE(parameter.preset, parameter.highest);
    }
  }
}

TEST(Scenes, SeedAndPresetsMatter) {
  EXPECT_NE(checksum(generate("gas:n=100,seed=1").spheres),
            checksum(generate("gas:n=100,seed=2").spheres));
  EXPECT_EQ(generate("gas").spheres.size(), 100000U);
  EXPECT_EQ(generate("gas").spec, generate("gas:n=1e5,seed=1,phi=0.1").spec);
}

TEST(Scenes, GasFillsItsBoxAroundTheOrigin) {
  const Scene scene = generate("gas:n=50000,phi=0.2");
  float low = 0;
  float high = 0;
  for (const Sphere& s : scene.spheres) {
    low = std::min({low, s.x, s.y, s.z});
    high = std::max({high, s.x, s.y, s.z});
    ASSERT_EQ(s.r, 0.5F);
  }
  EXPECT_NEAR(low + high, 0.0, 0.05);
  const double side = static_cast<double>(high) - low;
  EXPECT_NEAR(50000 * M_PI / 6 / (side * side * side), 0.2, 0.002);
}

// A sphere of diameter 1 overlaps those whose centres lie in a ball of radius 1, which is 8 phi
// of them on average, less at the border of the box.
TEST(Scenes, DenseHasTheExpectedNumberOfPairs) {
  EXPECT_NEAR(static_cast<double>(count_pairs(generate("dense:n=5000").spheres)) / 5000, 1.6, 0.2);
}

TEST(Scenes, ShiftedByNothingIsGas) {
  EXPECT_EQ(checksum(generate("shifted:n=1000,offset=0").spheres),
            checksum(generate("gas:n=1000").spheres));
  for (const Sphere& s : generate("shifted:n=1000").spheres) {
    ASSERT_NEAR(s.x, 1e6, 10);
    ASSERT_NEAR(s.z, 1e6, 10);
  }
}

TEST(Scenes, PolyHasEachOctaveOfRadiiEquallyOften) {
  const Scene scene = generate("poly:n=20000,ratio=16");
  int octaves[4] = {};
  for (const Sphere& s : scene.spheres) {
    ASSERT_GE(s.r, 0.5F / 16);
    ASSERT_LE(s.r, 0.5F);
    ++octaves[std::min(3, static_cast<int>(std::log2(0.5 / s.r)))];
  }
  for (const int count : octaves) EXPECT_NEAR(count, 5000, 250);
}

TEST(Scenes, DiscsAreFlatAndMostAreSmall) {
  const Scene scene = generate("discs:n=20000");
  int small = 0;
  for (const Sphere& s : scene.spheres) {
    ASSERT_EQ(s.z, 0.0F);
    ASSERT_GE(s.r, 0.005F);
    ASSERT_LE(s.r, 0.5F);
    small += s.r < 0.01F ? 1 : 0;
  }
  EXPECT_NEAR(small, 15000, 300);  // the share below twice the smallest radius is 1 - 1 / 4
}

TEST(Scenes, CloudHasItsPeakDensity) {
  const Scene scene = generate("cluster:n=40000,clusters=1,share=1,peak=0.4");
  double centre[3] = {};
  for (const Sphere& s : scene.spheres) {
    centre[0] += s.x / 40000.0;
    centre[1] += s.y / 40000.0;
    centre[2] += s.z / 40000.0;
  }
  const double reach = 4;  // about a quarter of the cloud's width
  int inside = 0;
  for (const Sphere& s : scene.spheres) {
    inside += std::hypot(s.x - centre[0], s.y - centre[1], s.z - centre[2]) < reach ? 1 : 0;
  }
  EXPECT_NEAR(inside / std::pow(reach / 0.5, 3), 0.4, 0.06);
}

TEST(Scenes, LatticeNeighboursTouchExactly) {
  EXPECT_EQ(count_pairs(generate("lattice:n=27").spheres), 54U);
  EXPECT_EQ(count_pairs(generate("lattice:n=1000").spheres), 2700U);
  EXPECT_EQ(count_pairs(generate("lattice:n=1000,spacing=0.25").spheres), 2700U);
  // A full layer of 4 x 4, and three rows of the next.
  EXPECT_EQ(count_pairs(generate("lattice:n=28").spheres), 24U + 17U + 12U);
}

TEST(Scenes, ShuffledLatticeIsTheSameSetInAnotherOrder) {
  const auto sorted = [](std::vector<Sphere> spheres) {
    std::sort(spheres.begin(), spheres.end(), [](const Sphere& a, const Sphere& b) {
      return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    });
    return spheres;
  };
  const Scene rows = generate("lattice:n=500");
  const Scene shuffled = generate("lattice:n=500,shuffle=1");
  EXPECT_NE(checksum(rows.spheres), checksum(shuffled.spheres));
  EXPECT_EQ(checksum(sorted(rows.spheres)), checksum(sorted(shuffled.spheres)));
  EXPECT_NE(generate("lattice:n=500,shuffle=1,seed=2").spheres.front().x,
            shuffled.spheres.front().x);
}

TEST(Scenes, GiantIsOneSphereInTheMiddle) {
  const Scene scene = generate("giant:n=1001");
  const double side = std::cbrt(1001 * M_PI / 6 / 0.1);
  int giants = 0;
  for (const Sphere& s : scene.spheres) giants += s.r > 0.5F ? 1 : 0;
  EXPECT_EQ(giants, 1);
  EXPECT_NEAR(scene.spheres[500].r, 0.3 * side, 1e-5);
}

TEST(Scenes, ChainAndIdenticalHaveKnownPairs) {
  EXPECT_EQ(count_pairs(generate("chain:n=500").spheres), 499U);
  EXPECT_EQ(count_pairs(generate("chain:n=500,spacing=1.25").spheres), 0U);
  EXPECT_EQ(count_pairs(generate("identical:n=100").spheres), 4950U);
}

/// Of 20^3 / 2 points 3 * 20 * 19^2 couples are neighbours; roundings part some of them.
TEST(Scenes, DensestPackingTouchesUpToRoundings) {
  const auto pairs_if_radii_grow_by = [](float growth) {
    std::vector<Sphere> spheres = generate("fcc:n=4000").spheres;
    for (Sphere& s : spheres) s.r += growth;
    return count_pairs(spheres);
  };
  EXPECT_EQ(pairs_if_radii_grow_by(1e-5F), 21660U);
  EXPECT_EQ(pairs_if_radii_grow_by(-1e-5F), 0U);
  EXPECT_GT(pairs_if_radii_grow_by(0.0F), 5000U);
  EXPECT_LT(pairs_if_radii_grow_by(0.0F), 17000U);
}

TEST(Scenes, UnknownNameIsRefusedWithTheKnownOnes) {
  expect_refusal("gos", "no scene and no file 'gos'");
  expect_refusal("", "no scene and no file ''");
  for (const SceneInfo& info : scenes()) expect_refusal("gos:n=5", std::string(info.name));
}

TEST(Scenes, BadParametersAreRefusedWithTheKnownOnes) {
  expect_refusal("gas:", "'' is not of the form parameter=value");
  expect_refusal("gas:n=5,", "'' is not of the form parameter=value");
  expect_refusal("gas:n", "'n' is not of the form parameter=value");
  expect_refusal("gas:N=5", "no parameter 'N'");
  expect_refusal("gas:m=5", "n (0 to 268435456, default 100000)");
  expect_refusal("gas:n=5,n=5", "n is given twice");
  for (const char* text : {"", "x", "5x", "0x10", " 5", "+5", "5=5"}) {
    expect_refusal(std::string("gas:n=") + text, "is not a number");
  }
  for (const char* text : {"-1", "268435457", "1e300", "inf", "nan"}) {
    expect_refusal(std::string("gas:n=") + text, "is out of range");
  }
  expect_refusal("gas:n=1.5", "n=1.5 is not a whole number");
  expect_refusal("gas:phi=0", "phi=0 is out of range");
  expect_refusal("gas:seed=9007199254740993", "is out of range");
  expect_refusal("identical:seed=1", "no parameter 'seed'");
}

TEST(Scenes, ControlCharactersDoNotReachTheTerminal) {
  EXPECT_EQ(refusal("\x1b[31m").find('\x1b'), std::string::npos);
}

TEST(PortableMath, CubeRootIsRightToAFewUnitsInTheLastPlace) {
  EXPECT_EQ(cube_root(0.0), 0.0);
  EXPECT_EQ(cube_root(27.0), 3.0);
  for (double value = 1e-30; value < 1e30; value *= 1.37) {
    EXPECT_NEAR(cube_root(value) / std::cbrt(value), 1.0, 4e-15) << value;
  }
}

TEST(PortableMath, PowerTableIsRightToFloatPrecision) {
  const PowerTable power_of_ten(10.0);
  for (double t = 0; t < 1; t += 0.01) EXPECT_NEAR(power_of_ten(t) / std::pow(10, t), 1.0, 1e-9);
}

TEST(PortableMath, RandomNumbersStayInTheirRange) {
  Random random(0);
  double mean = 0;
  double variance = 0;
  for (int k = 0; k < 100000; ++k) {
    const double u = random.uniform();
    ASSERT_TRUE(u >= 0 && u < 1);
    ASSERT_LT(random.below(3), 3U);
    const double b = random.bell();
    mean += b / 100000;
    variance += b * b / 100000;
  }
  EXPECT_NEAR(mean, 0, 0.02);
  EXPECT_NEAR(variance, 1, 0.02);
}

}  // namespace
}  // namespace octocell
