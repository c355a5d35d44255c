// SPDX-License-Identifier: MIT
#include "harness/trace/why.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/flags.hpp"
#include "core/overlap.hpp"
#include "harness/trace/exact_decimal.hpp"
#include "harness/trace/why_rules.hpp"

namespace octocell::trace {
namespace {

/// Returns the first level of the predicate that is certain.
DecidedBy deciding_level(const Plan& plan, const Sphere& a, const Sphere& b) {
  if (plan.predicate == Predicate::exact && plan.test == PairTest::f32) return DecidedBy::lattice;
  if (!claims_exact(plan.predicate)) return DecidedBy::other;
  const bool is_fast = plan.test == PairTest::filter_fast;
  const Verdict first =
      is_fast ? filter_verdict<Filter::fast>(a, b) : filter_verdict<Filter::safe>(a, b);
  if (first != Verdict::uncertain) return DecidedBy::filter;
  const exact::Float64Test<double> second(a.x, a.y, a.z, a.r, b.x, b.y, b.z, b.r);
  if (std::abs(second.excess) > second.bound) return DecidedBy::float64_bound;
  return second.rounding == 0.0 ? DecidedBy::float64 : DecidedBy::integers;
}

Overlap overlap_of(const Plan& plan, const Sphere& a, const Sphere& b) {
  const exact::Sides sides = exact::integer_sides(a, b);
  const double dx = static_cast<double>(a.x) - b.x;
  const double dy = static_cast<double>(a.y) - b.y;
  const double dz = static_cast<double>(a.z) - b.z;
  return {.answer = overlap_exact(a, b),
          .decided_by = deciding_level(plan, a, b),
          .distance2 = exact_decimal(sides.distance2),
          .radius_sum2 = exact_decimal(sides.radius_sum2),
          .distance = std::hypot(dx, dy, dz),
          .radius_sum = static_cast<double>(a.r) + b.r};
}

void meet_everywhere(Account& account) {
  account.cells = "every pair is tested";
  account.test_count = 1;
}

void meet(Account& account, const Plan& plan) {
  switch (plan.method) {
    case Method::brute_force:
      return meet_everywhere(account);
    case Method::tiles:
      return meet_in_tiles(account, plan);
    case Method::half_shell:
      return meet_in_rows(account, plan);
    case Method::home_phantom:
      break;
  }
  if (plan.rule == Rule::as_written) return meet_as_written(account, plan);
  meet_in_cells(account, plan);
}

/// Puts the meetings with a test first and keeps no more than are shown.
void shorten(Account& account) {
  std::ranges::stable_partition(account.meetings, &Meeting::tested);
  if (account.meetings.size() > kMostShown) account.meetings.resize(kMostShown);
}

}  // namespace

Account why(const Plan& plan, SceneView scene, std::uint32_t i, std::uint32_t j) {
  if (i > j) std::swap(i, j);
  const Sphere& a = scene.spheres[i];
  const Sphere& b = scene.spheres[j];
  Account account = {.method = plan.method,
                     .rule = plan.rule,
                     .cells = {},
                     .i = {.id = i, .sphere = a, .cells = {}},
                     .j = {.id = j, .sphere = b, .cells = {}},
                     .meetings = {},
                     .overlap = overlap_of(plan, a, b),
                     .flaw = {}};
  account.may_collide = scene.flags.empty() || may_collide(scene.flags[i], scene.flags[j]);
  meet(account, plan);
  shorten(account);
  return account;
}

}  // namespace octocell::trace
