// SPDX-License-Identifier: MIT
// Precision modes: what each promises and does, and tests that are proved to be enough.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/planner/choose_test.hpp"
#include "core/planner/scene_stats.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cpu/backend.hpp"
#include "impl_cpu/lanes.hpp"
#include "tests/support/ask_finder.hpp"

namespace octocell {
namespace {

constexpr const char* kScenes[] = {"gas:n=5000",
                                   "dense:n=5000",
                                   "poly:n=5000",
                                   "poly:n=5000,ratio=1e6",
                                   "lattice:n=4913",
                                   "lattice:n=4913,spacing=0.1",
                                   "shifted:n=5000,offset=1e4",
                                   "shifted:n=5000,offset=1e7",
                                   "cluster:n=5000",
                                   "giant:n=3000",
                                   "chain:n=3000",
                                   "identical:n=100",
                                   "discs:n=3000"};

std::vector<Pair> found_by(Implementation how, SceneView scene, int threads = 1) {
  const auto finder = how.backend->create();
  find_completely(*finder, scene, how.plan_options(threads));
  return finder->download();
}

/// Lenses: spheres a hair apart, and a hair within reach.
Scene near_tangent_pairs() {
  Scene scene;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  for (int k = 0; k < 2000; ++k) {
    const Sphere s = {20.0F * static_cast<float>(k % 50), 20.0F * static_cast<float>(k / 50), 0.0F,
                      1.0F + 0.4F * unit(random)};
    const float r = 1.0F + 0.4F * unit(random);
    const float angle = 3.0F * unit(random);
    const float distance = (s.r + r) * (1.0F + 0x1p-23F * static_cast<float>(k % 9 - 4));
    const float y = s.y + distance * std::sin(angle);
    scene.spheres.insert(scene.spheres.end(), {s, {s.x + distance * std::cos(angle), y, 0.0F, r}});
  }
  return scene;
}

/// A sphere of radius one and a tiny one that it just does not touch: too many bits for float64.
Scene wide_spans() {
  Scene scene;
  for (int k = 0; k < 100; ++k) {
    const auto tiny = std::ldexp(1.0F, -40 - k % 20);
    const float y = 4.0F * static_cast<float>(k);
    scene.spheres.insert(scene.spheres.end(),
                         {{-1.0F, y, 0.0F, 1.0F}, {tiny, y, 0.0F, std::nextafter(tiny, 0.0F)}});
  }
  return scene;
}

class EachPredicate : public testing::TestWithParam<Predicate> {};

TEST_P(EachPredicate, IsExactOnEverySceneOrWrongOnSome) {
  reference::Comparison all;
  const auto judge = [&](const Scene& scene) {
    const std::vector<Pair> truth = reference::exact_pairs(scene);
    for (const Method method : backend_named("impl_cpu").methods) {
      const Implementation how = {&backend_named("impl_cpu"), method, Rule::lowest_cell,
                                  GetParam()};
      const reference::Comparison difference =
          reference::compare(found_by(how, scene.view()), truth);
      all.missed += difference.missed;
      all.false_pairs += difference.false_pairs;
      EXPECT_EQ(difference.duplicates, 0U) << name_of(method) << " " << scene.spec;
    }
  };
  for (const char* spec : kScenes) judge(generate(spec));
  judge(near_tangent_pairs());
  judge(wide_spans());
  EXPECT_EQ(all.missed + all.false_pairs == 0, claims_exact(GetParam()))
      << all.missed << " missed, " << all.false_pairs << " false";
  if (GetParam() == Predicate::aabb_only) {
    EXPECT_EQ(all.missed, 0U);
  }
}

/// The grid proposes, the predicate decides: what it says of two spheres depends on nothing else.
/// (Two predicates take pairs for overlaps that are further apart than a grid looks.)
class GridPredicate : public testing::TestWithParam<Predicate> {};

TEST_P(GridPredicate, SaysTheSameWhateverTheMethodAndTheThreads) {
  for (const char* spec : {"gas:n=3000", "poly:n=3000", "lattice:n=3375,spacing=0.1"}) {
    const Scene scene = generate(spec);
    std::map<std::string, PairDigest> digests;
    for (const Method method : backend_named("impl_cpu").methods) {
      for (const int threads : {1, 3}) {
        const Implementation how = {&backend_named("impl_cpu"), method, Rule::lowest_cell,
                                    GetParam()};
        digests[std::string(name_of(method)) + std::to_string(threads)] =
            digest_of(found_by(how, scene.view(), threads));
      }
    }
    for (const auto& [how, digest] : digests) {
      EXPECT_EQ(digest, digests.begin()->second) << spec << " " << how;
    }
  }
}

std::string predicate_name(const testing::TestParamInfo<Predicate>& info) {
  return std::string(name_of(info.param));
}
INSTANTIATE_TEST_SUITE_P(All, EachPredicate,
                         testing::ValuesIn(backend_named("impl_cpu").predicates), predicate_name);

std::vector<Predicate> grid_predicates() {
  const std::span<const Predicate> all = backend_named("impl_cpu").predicates;
  std::vector<Predicate> some(all.begin(), all.end());
  std::erase(some, Predicate::aabb_only);
  std::erase(some, Predicate::gram_f32);
  return some;
}
INSTANTIATE_TEST_SUITE_P(All, GridPredicate, testing::ValuesIn(grid_predicates()), predicate_name);

TEST(OtherBackends, AgreeOnWhatAPredicateSays) {
  for (const Predicate predicate : backend_named("impl_thrust").predicates) {
    for (const char* spec : {"gas:n=3000", "lattice:n=3375,spacing=0.1", "poly:n=3000"}) {
      const Scene scene = generate(spec);
      const auto digest = [&](std::string_view backend) {
        return digest_of(
            found_by({.backend = &backend_named(backend), .predicate = predicate}, scene.view()));
      };
      EXPECT_EQ(digest("impl_thrust"), digest("impl_cpu")) << name_of(predicate) << " " << spec;
    }
  }
}

/// Each lane says what the scalar function says, of the very same sphere.
template <PairTest test>
void expect_lanes_agree(const Scene& scene) {
  constexpr std::uint32_t kCount = 16;
  const Packing packing = choose_packing(measure(scene.view()).facts, test);
  std::vector<cpu::NumberOf<test>> numbers[4];
  const auto read_back = [&](std::size_t k) {
    if constexpr (is_packed(test)) {
      return PackedSphere{numbers[0][k], numbers[1][k], numbers[2][k], numbers[3][k]};
    } else {
      return Sphere{numbers[0][k], numbers[1][k], numbers[2][k], numbers[3][k]};
    }
  };
  for (const Sphere& s : scene.spheres) {
    const auto keep = [&](const auto& stored) {
      numbers[0].push_back(stored.x);
      numbers[1].push_back(stored.y);
      numbers[2].push_back(stored.z);
      numbers[3].push_back(stored.r);
    };
    if constexpr (is_packed(test)) {
      keep(pack<test>(s, packing));
    } else {
      keep(stored<test>(s));
    }
  }
  const cpu::FieldsOf<test> fields = {numbers[0].data(), numbers[1].data(), numbers[2].data(),
                                      numbers[3].data()};
  int hits = 0;
  for (std::size_t begin = 0; begin + kCount <= scene.spheres.size(); begin += kCount) {
    const cpu::Lanes<test, kCount> lanes(fields, begin);
    for (std::size_t j = 0; j < scene.spheres.size(); j += 7) {
      const cpu::LaneBits bits = lanes.may_overlap(fields, j);
      for (std::size_t lane = 0; lane < kCount; ++lane) {
        bool expected = false;
        if constexpr (test == PairTest::f16) {
          expected = f16::may_overlap(read_back(begin + lane), read_back(j));
        } else if constexpr (test == PairTest::q16) {
          expected = q16::may_overlap(read_back(begin + lane), read_back(j));
        } else if constexpr (test == PairTest::q16_exact) {
          expected = q16::may_overlap_exactly(read_back(begin + lane), read_back(j));
        } else {
          expected = may_overlap<test>(read_back(begin + lane), read_back(j));
        }
        ASSERT_EQ((bits >> lane & 1) != 0, expected) << begin + lane << " and " << j;
        hits += expected ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 0);
}

TEST(Lanes, AgreeWithTheScalarTests) {
  for (const char* spec : {"dense:n=1600", "lattice:n=1600,spacing=0.1"}) {
    const Scene scene = generate(spec);
    for (int t = 0; t <= static_cast<int>(PairTest::gram); ++t) {
      with_pair_test(static_cast<PairTest>(t),
                     [&]<PairTest test>() { expect_lanes_agree<test>(scene); });
    }
  }
}

TEST(F16, RoundsAsIeee754Says) {
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const float value = f16::to_float(half);
    ASSERT_EQ(f16::from_float(value), half);
    ASSERT_EQ(f16::from_float(-value), half | 0x8000U);
    if (bits + 1 == 0x7c00) break;
    const float next = f16::to_float(static_cast<std::uint16_t>(bits + 1));
    ASSERT_GT(next, value);
    const float middle = 0.5F * (value + next);  // exact: one bit more
    ASSERT_EQ(f16::from_float(middle), bits % 2 == 0 ? bits : bits + 1) << "ties go to even";
    ASSERT_EQ(f16::from_float(std::nextafter(middle, 0.0F)), bits);
    ASSERT_EQ(f16::from_float(std::nextafter(middle, 1e9F)), bits + 1);
  }
}

/// |dq| - 1 <= |p - q| in units, and the radius in units is above r: what q16_exact rests on.
TEST(Q16, NeverTakesTwoForFurtherApartThanTheyAre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double offset : {0.0, 1.0, -3.0, 1e4, -1e7, 3e30}) {
    for (const double r_max : {0.5, 1e-30, 3e8, 1e37}) {
      PlanFacts facts;
      facts.r_max = static_cast<float>(r_max);
      const Packing packing = choose_packing(facts, PairTest::q16_exact);
      const double units = packing.units_per_length;
      for (int k = 0; k < 2000; ++k) {
        const auto p = static_cast<float>(offset + 4.0 * r_max * unit(random));
        const auto q = static_cast<float>(p + 2.0 * r_max * unit(random));
        const double apart = std::abs(static_cast<double>(p) - static_cast<double>(q)) * units;
        if (apart > 2.0 * r_max * units) continue;
        const auto least = q16::least_distance(q16::place(p, packing), q16::place(q, packing));
        ASSERT_LE(least, apart) << p << " " << q;
        ASSERT_GE(least, apart - 2.0) << p << " " << q;
        const auto r = static_cast<float>(r_max * std::abs(unit(random)));
        ASSERT_GT(q16::upper_radius(r, packing), static_cast<double>(r) * units);
      }
    }
  }
}

PairTest test_for(const Scene& scene, PlanOptions options = {}) {
  options.method = std::nullopt;
  return make_plan(measure(scene.view()), options).test;
}

TEST(Certificates, AreTakenWhereTheyHold) {
  EXPECT_EQ(test_for(generate("lattice:n=1000")), PairTest::f32);
  const Skips allowed = Skips::all().without(Skip::uncertain_pairs);
  EXPECT_EQ(test_for(generate("lattice:n=1000"), {.allowed = allowed}), PairTest::filter_equal);
  EXPECT_EQ(test_for(generate("lattice:n=1000,spacing=0.1")), PairTest::filter_equal);
  EXPECT_EQ(test_for(generate("gas:n=1000")), PairTest::filter_equal);
  EXPECT_EQ(test_for(generate("poly:n=1000")), PairTest::filter_fast);
  EXPECT_EQ(test_for(generate("lattice:n=1000"), {.moving = true}), PairTest::filter_equal);
}

/// 2^12 units is where float32 stops being exact.
TEST(Certificates, EndAtTheirBounds) {
  const auto with_radius = [](float r) {
    Scene scene;
    scene.spheres = {{0, 0, 0, r}, {1, 0, 0, r}};
    return scene;
  };
  EXPECT_EQ(test_for(with_radius(0x1p11F - 1)), PairTest::f32);
  EXPECT_EQ(test_for(with_radius(0x1p11F)), PairTest::filter_equal);
  const auto of_unit = [](float unit) {
    Scene scene;
    scene.spheres = {{0, 0, 0, unit}, {unit, 0, 0, 0}};
    return scene;
  };
  EXPECT_EQ(test_for(of_unit(0x1p-74F)), PairTest::f32);
  EXPECT_EQ(test_for(of_unit(0x1p-75F)), PairTest::filter_safe);
}

/// Within the certificate every pair is decided rightly; one step beyond, float32 fails on some.
TEST(Certificates, AreSharp) {
  std::mt19937 random(11);
  const auto wrong_with = [&](int radius_bits) {
    std::uniform_int_distribution<int> coordinate(-(2 << radius_bits), 2 << radius_bits);
    const auto r = static_cast<float>((1 << radius_bits) - 1);
    int wrong = 0;
    for (int k = 0; k < 300'000; ++k) {
      const Sphere a = {0, 0, 0, r};
      Sphere b = {static_cast<float>(coordinate(random)), static_cast<float>(coordinate(random)), 0,
                  r};
      const double rest =
          4.0 * r * r - b.x * static_cast<double>(b.x) - b.y * static_cast<double>(b.y);
      if (rest < 0) continue;
      b.z = static_cast<float>(std::lround(std::sqrt(rest)));  // as near to a tie as can be
      wrong += may_overlap<PairTest::f32>(a, b) != reference::overlap(a, b) ? 1 : 0;
    }
    return wrong;
  };
  EXPECT_EQ(wrong_with(11), 0);
  EXPECT_GT(wrong_with(13), 0);
}

TEST(Certificates, LookAtEveryNumber) {
  for (std::size_t count = 0; count < 10; ++count) {
    std::vector<Sphere> spheres(count, Sphere{-1.5F, 2.0F, 0.0F, 0.5F});
    EXPECT_TRUE(lie_on_lattice(spheres, 2.0)) << count;
    for (Sphere& s : spheres) {
      for (float Sphere::*const part : {&Sphere::x, &Sphere::y, &Sphere::z, &Sphere::r}) {
        const float whole = s.*part;
        for (const float other : {whole + 0.25F, 0x1p-149F, std::nanf("")}) {
          s.*part = other;
          EXPECT_FALSE(lie_on_lattice(spheres, 2.0)) << count << " spheres, " << other;
        }
        s.*part = whole;
      }
    }
  }
}

TEST(Certificates, AreCheckedAgainOnWhatIsGiven) {
  for (const char* name : {"impl_cpu", "impl_thrust"}) {
    Scene scene = generate("lattice:n=1000");
    const auto finder = backend_named(name).create();
    const Plan plan = roomy_plan(scene, {.method = Method::half_shell});
    ASSERT_EQ(plan.test, PairTest::f32);
    EXPECT_FALSE(ask(*finder, plan, scene.view()).counts.plan_violation) << name;
    scene.spheres[500].x += 0x1p-20F;
    EXPECT_TRUE(ask(*finder, plan, scene.view()).counts.plan_violation) << name;

    Scene gas = generate("gas:n=1000");
    const Plan equal = roomy_plan(gas, {.method = Method::half_shell});
    ASSERT_EQ(equal.test, PairTest::filter_equal);
    EXPECT_FALSE(ask(*finder, equal, gas.view()).counts.plan_violation) << name;
    gas.spheres[700].r = 0.0F;
    EXPECT_TRUE(ask(*finder, equal, gas.view()).counts.plan_violation) << name;
  }
}

}  // namespace
}  // namespace octocell
