// SPDX-License-Identifier: MIT
// Compares the precision modes of impl_cuda_custom with the exact pairs and with impl_cpu.
#include <gtest/gtest.h>

#include <string>

#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/support/ask_finder.hpp"

namespace octocell {
namespace {

constexpr const char* kScenes[] = {"gas:n=0",
                                   "gas:n=1",
                                   "gas:n=5000",
                                   "dense:n=20000",
                                   "poly:n=20000",
                                   "poly:n=5000,ratio=1e6",
                                   "lattice:n=9261",
                                   "lattice:n=9261,spacing=0.1",
                                   "shifted:n=5000,offset=1e4",
                                   "shifted:n=5000,offset=1e7",
                                   "cluster:n=5000",
                                   "giant:n=3000",
                                   "identical:n=300",
                                   "chain:n=3000"};

class CudaPrecision : public testing::TestWithParam<Predicate> {
 protected:
  void SetUp() override {
    if (const auto reason = device().why_unavailable()) GTEST_SKIP() << *reason;
  }
  static const BackendInfo& device() { return backend_named("impl_cuda_custom"); }

  /// Returns true if the method has this predicate on the device.
  static bool has(Method method) {
    return method != Method::tiles || GetParam() == Predicate::exact;
  }

  static PairDigest digest(const BackendInfo& backend, SceneView scene, PlanOptions options) {
    options.predicate = GetParam();
    options.costs = backend.costs;
    const auto finder = backend.create();
    find_completely(*finder, scene, options);
    return finder->digest();
  }
};

TEST_P(CudaPrecision, IsExactWhereItPromisesTo) {
  if (!claims_exact(GetParam())) return;
  for (const char* spec : kScenes) {
    const Scene scene = generate(spec);
    const PairDigest truth = digest_of(reference::exact_pairs(scene));
    for (const Method method : device().methods) {
      if (!has(method)) continue;
      for (const bool count_only : {false, true}) {
        for (const Skips allowed :
             {Skips::all(), Skips::all().without(Skip::uncertain_pairs).without(Skip::equal_radii),
              Skips::all().without(Skip::safe_filter)}) {
          EXPECT_EQ(digest(device(), scene.view(),
                           {.method = method, .count_only = count_only, .allowed = allowed}),
                    truth)
              << name_of(method) << " " << spec << (count_only ? " counted" : "");
        }
      }
    }
  }
}

/// Fused operations may round otherwise: near-tangent pairs f32 and f64 are each machine's own.
TEST_P(CudaPrecision, SaysWhatTheHostSays) {
  if (GetParam() == Predicate::f32 || GetParam() == Predicate::f64) return;
  for (const char* spec : {"gas:n=5000", "poly:n=5000", "lattice:n=9261,spacing=0.1"}) {
    const Scene scene = generate(spec);
    // Two predicates take pairs for overlaps that only some grids look at: there, all pairs.
    const bool far = GetParam() == Predicate::aabb_only || GetParam() == Predicate::gram_f32;
    for (const Method method : backend_named("impl_cpu").methods) {
      if (far && method != Method::brute_force) continue;
      for (const bool count_only : {false, true}) {
        const PlanOptions options = {.method = method, .count_only = count_only};
        EXPECT_EQ(digest(device(), scene.view(), options),
                  digest(backend_named("impl_cpu"), scene.view(), options))
            << name_of(method) << " " << spec << (count_only ? " counted" : "");
      }
    }
  }
}

TEST_P(CudaPrecision, ChecksAgainWhatItsTestRestsOn) {
  if (GetParam() != Predicate::exact) return;
  Scene lattice = generate("lattice:n=1000");
  Scene gas = generate("gas:n=1000");
  const auto finder = device().create();
  for (const Method method : {Method::half_shell, Method::home_phantom}) {
    const Plan on_lattice = roomy_plan(lattice, {.method = method});
    ASSERT_EQ(on_lattice.test, PairTest::f32);
    Scene moved = lattice;
    moved.spheres[500].x += 0x1p-20F;
    EXPECT_FALSE(ask(*finder, on_lattice, lattice.view()).counts.plan_violation);
    EXPECT_TRUE(ask(*finder, on_lattice, moved.view()).counts.plan_violation);
    const Plan equal = roomy_plan(gas, {.method = method});
    ASSERT_EQ(equal.test, PairTest::filter_equal);
    Scene shrunk = gas;
    shrunk.spheres[700].r = 0.0F;
    EXPECT_FALSE(ask(*finder, equal, gas.view()).counts.plan_violation);
    EXPECT_TRUE(ask(*finder, equal, shrunk.view()).counts.plan_violation);
  }
}

std::string predicate_name(const testing::TestParamInfo<Predicate>& info) {
  return std::string(name_of(info.param));
}
INSTANTIATE_TEST_SUITE_P(All, CudaPrecision,
                         testing::ValuesIn(backend_named("impl_cuda_custom").predicates),
                         predicate_name);

}  // namespace
}  // namespace octocell
