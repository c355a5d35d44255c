// SPDX-License-Identifier: MIT
// Every set of skips that a plan may be given: the pairs are the exact ones, and a forbidden skip
// is not taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cpu/backend.hpp"

namespace octocell {
namespace {

/// The skips of single frames; those between frames have sequences of frames for tests.
constexpr auto kSkipsOfAFrame = static_cast<std::size_t>(Skip::unchanged);
constexpr std::uint32_t kSubsets = 1U << kSkipsOfAFrame;

Skips subset(std::uint32_t number) {
  Skips skips = Skips::all();
  for (std::size_t k = 0; k < kSkipsOfAFrame; ++k) {
    if ((number >> k & 1U) == 0) skips = skips.without(static_cast<Skip>(k));
  }
  return skips;
}

std::string names_of(Skips skips) {
  std::string names;
  for (std::size_t k = 0; k < kSkipsOfAFrame; ++k) {
    if (skips.has(static_cast<Skip>(k))) names.append(" ").append(kSkips[k].name);
  }
  return names;
}

/// Times a power of two, which leaves all pairs as they are unless numbers become subnormal.
Scene scaled(const char* spec, int exponent) {
  Scene scene = generate(spec);
  for (Sphere& s : scene.spheres) {
    s = {std::ldexp(s.x, exponent), std::ldexp(s.y, exponent), std::ldexp(s.z, exponent),
         std::ldexp(s.r, exponent)};
  }
  return scene;
}

/// As large as float32 allows.
Scene huge(const char* spec) {
  float farthest = 0.0F;
  for (const Sphere& s : generate(spec).spheres) {
    farthest = std::max({farthest, std::fabs(s.x), std::fabs(s.y), std::fabs(s.z), s.r});
  }
  return scaled(spec, 127 - std::ilogb(farthest));
}

/// Flat, at that height. Where it is great, steps of float32 are wider than the spheres.
Scene flat_at(float z) {
  Scene scene = generate("discs:n=40");
  for (Sphere& s : scene.spheres) s.z = z;
  return scene;
}

struct Case {
  const char* name;
  Scene (*make)();
};
constexpr Case kCases[] = {
    {"poly", [] { return generate("poly:n=50"); }},
    {"giant", [] { return generate("giant:n=50"); }},
    {"lattice", [] { return generate("lattice:n=64"); }},
    {"chain", [] { return generate("chain:n=40"); }},
    {"flat", [] { return generate("discs:n=50"); }},
    {"identical", [] { return generate("identical:n=12"); }},
    {"gas_with_flags", [] { return generate("gas:n=60,static=0.5"); }},
    {"all_static", [] { return generate("gas:n=30,static=1"); }},
    {"huge", [] { return huge("gas:n=40"); }},
    {"huge_poly", [] { return huge("poly:n=40"); }},
    {"huge_flat", [] { return huge("discs:n=40"); }},
    {"tiny", [] { return scaled("gas:n=40", -140); }},
    {"tiny_flat", [] { return scaled("discs:n=40", -135); }},
    {"flat_on_high", [] { return flat_at(1e30F); }},
    {"flat_at_the_end", [] { return flat_at(kFloatMax); }},
    {"flat_at_the_other_end", [] { return flat_at(-kFloatMax); }},
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// What the plan or the run left out although it must not. A level with one layer of cells has left
/// out the layers above and below, whether or not the plan says so.
Skips disobeyed(const Outcome& outcome, Skips allowed) {
  Skips left_out = outcome.plan.taken.either(outcome.counts.used);
  for (int k = 0; k < outcome.plan.levels.count; ++k) {
    const Grid& grid = outcome.plan.levels.level[k].grid;
    if (grid.cell_count[1] == 1 || grid.cell_count[2] == 1) {
      left_out = allowed.has(Skip::layers) ? left_out : left_out.with(Skip::layers);
    }
  }
  Skips found;
  for (std::size_t k = 0; k < kSkipCount; ++k) {
    const auto skip = static_cast<Skip>(k);
    if (left_out.has(skip) && !allowed.has(skip)) found = found.with(skip);
  }
  return found;
}

class SkipSubsets : public testing::TestWithParam<Case> {
 protected:
  void expect_exact(std::optional<Method> method, Skips allowed) {
    const Outcome outcome =
        find_completely(*finder_, scene_.view(), {.method = method, .allowed = allowed});
    EXPECT_EQ(finder_->digest(), truth_) << "allowed:" << names_of(allowed);
    EXPECT_EQ(disobeyed(outcome, allowed), Skips())
        << "allowed:" << names_of(allowed)
        << "; left out all the same:" << names_of(disobeyed(outcome, allowed));
  }

  const Scene scene_ = GetParam().make();
  const PairDigest truth_ = digest_of(reference::exact_pairs(scene_.spheres, scene_.flags));
  const std::unique_ptr<PairFinder> finder_ = cpu::make_backend();
};

TEST_P(SkipSubsets, HaveTheExactPairsAndAreObeyed) {
  for (std::uint32_t number = 0; number < kSubsets && !HasFailure(); ++number) {
    expect_exact(std::nullopt, subset(number));
  }
}

/// Scenes as small as these are tested without cells where that may be.
TEST_P(SkipSubsets, OfHalfShellHaveTheExactPairsAndAreObeyed) {
  for (std::uint32_t number = 0; number < kSubsets && !HasFailure(); ++number) {
    const Skips allowed = subset(number);
    if (!allowed.has(Skip::phantoms) || allowed.has(Skip::grid)) continue;
    expect_exact(Method::half_shell, allowed);
  }
}

INSTANTIATE_TEST_SUITE_P(SkipSubsets, SkipSubsets, testing::ValuesIn(kCases),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(ForbiddenSkips, ThatAMethodIsMadeOfAreRefusedWithIt) {
  const Scene scene = generate("gas:n=100");
  const auto expect_refusal = [&](Method method, Skip skip) {
    const PlanOptions options = {.method = method, .allowed = Skips::all().without(skip)};
    try {
      make_plan(measure(scene.view()), options);
      ADD_FAILURE() << name_of(method) << " without " << name_of(skip);
    } catch (const LimitError& refusal) {
      EXPECT_EQ(refusal.what(), "skip " + std::string(name_of(skip)) +
                                    " cannot be forbidden here: the method is " +
                                    std::string(name_of(method)));
    }
  };
  expect_refusal(Method::half_shell, Skip::phantoms);
  expect_refusal(Method::brute_force, Skip::grid);
}

/// Two layers of cells that are wider than all of float32.
TEST(ForbiddenSkips, ThatLeaveNoRoomForTwoLayersAreRefused) {
  const std::vector<Sphere> spheres = {{0, 0, 0, kFloatMax}, {1, 2, 3, kFloatMax}};
  PlanOptions options = {.method = Method::half_shell,
                         .allowed = Skips::all().without(Skip::layers)};
  EXPECT_THROW(make_plan(measure({spheres}), options), LimitError);
  options.method.reset();
  options.allowed = options.allowed.without(Skip::grid);
  const Plan plan = make_plan(measure({spheres}), options);
  EXPECT_FALSE(plan.taken.has(Skip::layers));
  EXPECT_EQ(plan.method, Method::home_phantom);
}

}  // namespace
}  // namespace octocell
