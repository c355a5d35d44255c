// SPDX-License-Identifier: MIT
// Plans for a GPU, with the costs of its kernels; planning needs no GPU.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/planner/planner.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

Plan plan_for(const char* spec, Skips forced = {}, const char* backend = "impl_cuda_custom") {
  const BackendInfo& device = backend_named(backend);
  return make_plan(measure(generate(spec).view()), {.method = {},
                                                    .known = device.skips,
                                                    .allowed = device.skips,
                                                    .forced = forced,
                                                    .costs = device.costs});
}

/// home_phantom queues more kernels, and a hundred thousand spheres do not keep them busy.
TEST(DevicePlans, TakeTheMethodOfFewKernelsWhereSpheresAreFew) {
  for (const char* spec : {"gas:n=1000", "gas:n=100000,phi=1e-4", "chain:n=100000",
                           "poly:n=100000,ratio=1e6", "cluster:n=100000"}) {
    EXPECT_EQ(plan_for(spec).method, Method::half_shell) << spec;
  }
}

/// Its sort allocates and waits, so all pairs of a few are tested sooner; its home_phantom lists
/// the cells of a giant one by one.
TEST(DevicePlans, OfThrustFollowItsOwnTimes) {
  const auto method_for = [](const char* spec) {
    return plan_for(spec, {}, "impl_thrust_cuda").method;
  };
  EXPECT_EQ(method_for("gas:n=100"), Method::brute_force);
  EXPECT_EQ(method_for("gas:n=1000"), Method::brute_force);
  EXPECT_EQ(method_for("gas:n=10000"), Method::home_phantom);
  EXPECT_EQ(method_for("gas:n=100000"), Method::home_phantom);
  EXPECT_EQ(method_for("lattice:n=100000"), Method::half_shell);
  EXPECT_EQ(method_for("giant:n=100000"), Method::half_shell);
}

TEST(DevicePlans, DoNotCountEqualRadiiForASkip) {
  const Plan plan = plan_for("gas:n=1000");
  EXPECT_EQ(plan.test, PairTest::filter_fast);
  EXPECT_FALSE(plan.taken.has(Skip::equal_radii));
  EXPECT_THROW(plan_for("gas:n=1000", Skips().with(Skip::equal_radii)), LimitError);
}

}  // namespace
}  // namespace octocell
