// SPDX-License-Identifier: MIT
// Why a plan finds a pair of spheres, or does not: where both lie, in which cells they meet, what
// the rule decides there, and whether they overlap.
//
// This follows the rules of docs/exactness.md for two spheres, without running a backend.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/grid.hpp"
#include "core/plan.hpp"
#include "core/sphere.hpp"
#include "harness/trace/text_rule.hpp"

namespace octocell::trace {

/// A cell in which a sphere is listed.
struct ListedCell {
  Cell cell;
  std::uint32_t id;
  bool is_home;
};

struct ListedSphere {
  std::uint32_t id;
  Sphere sphere;
  std::vector<ListedCell> cells;  // the home first; at most kMostShown
  std::uint64_t cell_count = 0;   // all of them
};
inline constexpr std::size_t kMostShown = 32;

/// A cell in which both spheres are listed, and what the rule says of the pair there.
struct Meeting {
  Cell cell;
  std::uint32_t id;
  bool home_of_i;
  bool home_of_j;
  bool tested;
  std::string reason;
};

/// What decides whether two spheres overlap.
enum class DecidedBy : std::uint8_t { lattice, filter, float64_bound, float64, integers, other };

struct Overlap {
  bool answer;
  DecidedBy decided_by;
  std::string distance2;    // |p - q|^2, all decimal digits
  std::string radius_sum2;  // (r + r')^2, likewise
  double distance;
  double radius_sum;
};

struct Account {
  Method method;
  Rule rule;
  std::string cells;  // how space is cut
  ListedSphere i;
  ListedSphere j;
  std::vector<Meeting> meetings;    // at most kMostShown; those in which the pair is tested first
  std::uint64_t meeting_count = 0;  // all of them
  std::uint64_t test_count = 0;     // in how many of them the pair is tested
  bool may_collide = true;          // by the flags of the two
  Overlap overlap;
  std::optional<Flaw> flaw;  // of rule as_written, if the answer is wrong

  /// How often the plan gives this pair.
  [[nodiscard]] std::uint64_t times_found() const {
    return overlap.answer && may_collide ? test_count : 0;
  }
  [[nodiscard]] bool should_be_found() const { return overlap.answer && may_collide; }
};

/// Returns the account of spheres i != j. The plan must be made for the scene.
Account why(const Plan& plan, SceneView scene, std::uint32_t i, std::uint32_t j);

/// Returns lines for a terminal; `scene` is how a user names it.
std::string to_text(const Account& account, std::string_view scene);
nlohmann::ordered_json to_json(const Account& account, std::string_view scene);

}  // namespace octocell::trace
