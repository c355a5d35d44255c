// SPDX-License-Identifier: MIT
#include "harness/trace/text_rule.hpp"

#include <algorithm>
#include <cmath>

#include "core/as_written.hpp"

namespace octocell::trace {
namespace {

CellKey id_of(const TextRule& rule, std::array<long, 3> c) {
  if (rule.has_unique_ids) return {c[2], c[1], c[0]};
  if (rule.box) {
    for (std::size_t axis = 0; axis < 3; ++axis) c[axis] -= rule.box->first[axis];
  }
  const auto number = [](long at) { return static_cast<std::uint32_t>(at); };
  return {0, 0, as_written::hash({number(c[0]), number(c[1]), number(c[2])})};
}

long coordinate(const TextRule& rule, float p) {
  constexpr float kMost = 4e9F;
  const float cell = p / rule.side;
  switch (rule.number) {
    case CellNumber::saturated:
      return as_written::saturated(cell);
    case CellNumber::truncated:
      return static_cast<long>(std::clamp(cell, -kMost, kMost));
    case CellNumber::floored:
      return static_cast<long>(std::clamp(std::floor(cell), -kMost, kMost));
  }
  return 0;
}

float gap(const TextRule& rule, float p, long c) {
  const float low = static_cast<float>(c) * rule.side;
  const float high = low + rule.side;
  if (p < low) return low - p;
  return p > high ? p - high : 0.0F;
}

bool ball_meets(const TextRule& rule, const Sphere& s, const std::array<long, 3>& c) {
  const float x = gap(rule, s.x, c[0]);
  const float y = gap(rule, s.y, c[1]);
  const float z = gap(rule, s.z, c[2]);
  const float r = rule.scale * s.r;
  return x * x + y * y + z * z <= r * r;
}

bool is_outside(const TextRule& rule, const std::array<long, 3>& c) {
  if (rule.number == CellNumber::saturated)
    return std::ranges::any_of(c, [](long at) { return at < 0 || at > 0xffffffffL; });
  if (!rule.box) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (c[axis] < rule.box->first[axis] || c[axis] > rule.box->last[axis]) return true;
  }
  return false;
}

/// How often a rule tests the pair, and in which kinds of cell they meet.
struct Meetings {
  int tested = 0;
  int with_a_home = 0;
  int all = 0;
};

Meetings count(const TextRule& rule, const TextListing& a, const TextListing& b) {
  Meetings found;
  for_each_meeting(a, b, [&](std::size_t k, std::size_t l) {
    ++found.all;
    found.with_a_home += k == 0 || l == 0 ? 1 : 0;
    found.tested += is_tested(rule, a, k, b, l) ? 1 : 0;
  });
  return found;
}

constexpr Flaw kSharedIds = {"shared ids",
                             "two cells have one id, since fields of 10 bits are joined by OR; the "
                             "pair is met in both"};
constexpr Flaw kUnsignedCells = {
    "unsigned cells",
    "a negative coordinate becomes cell 0 when it is cast to unsigned; "
    "with floor the pair would be found"};
constexpr Flaw kTruncatedCells = {
    "truncated cells",
    "a negative coordinate is rounded toward zero when it is cast to int, so that cells -1 and 0 "
    "are one; with floor the pair would be found"};
constexpr Flaw kEightSlots = {"eight slots",
                              "a ball of this size meets more than eight cells, and those beyond "
                              "the eighth are dropped; with room for all the pair would be found"};
constexpr Flaw kSmallerHome = {"smaller home only",
                               "the pair meets in the home of one of the two, but is tested only "
                               "if the phantom's home has the larger id"};
constexpr Flaw kBothPhantoms = {"both phantoms",
                                "the pair meets only in cells that are the home of neither, and "
                                "phantoms are not tested with phantoms"};
constexpr Flaw kNoCell = {"no common cell",
                          "the two balls are listed in no common cell, for float32 rounds where "
                          "they meet"};
constexpr Flaw kSeveral = {"several", "more than one of the text's mistakes stands in the way"};

}  // namespace

std::array<long, 3> home_cell(const TextRule& rule, const Sphere& s) {
  return {coordinate(rule, s.x), coordinate(rule, s.y), coordinate(rule, s.z)};
}

TextListing list(const TextRule& rule, const Sphere& s) {
  const std::array<long, 3> home = home_cell(rule, s);
  TextListing listing = {{home, id_of(rule, home)}};
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const std::array<long, 3> c = {home[0] + neighbour % 3 - 1, home[1] + neighbour / 3 % 3 - 1,
                                   home[2] + neighbour / 9 - 1};
    if (neighbour == 13 || is_outside(rule, c) || !ball_meets(rule, s, c)) continue;
    if (!rule.has_all_slots && listing.size() > as_written::kMaxPhantoms) break;
    listing.push_back({c, id_of(rule, c)});
  }
  return listing;
}

bool is_tested(const TextRule& rule, const TextListing& a, std::size_t k, const TextListing& b,
               std::size_t l) {
  if (rule.tested == TestedWhere::any_cell) return true;
  if (k != 0 && l != 0) return false;
  if (rule.tested == TestedWhere::any_home || (k == 0 && l == 0)) return true;
  const TextListing& home = k == 0 ? a : b;
  const TextListing& phantom = k == 0 ? b : a;
  return phantom[0].id > home[0].id;
}

int times_tested(const TextRule& rule, const Sphere& a, const Sphere& b) {
  return count(rule, list(rule, a), list(rule, b)).tested;
}

/// Mends one mistake after the other, the cheapest first.
Flaw flaw_of(const TextRule& rule, const Sphere& a, const Sphere& b) {
  const auto meetings = [&](const TextRule& mended) {
    return count(mended, list(mended, a), list(mended, b));
  };
  const Meetings as_it_is = meetings(rule);
  if (as_it_is.tested > 1) return kSharedIds;
  TextRule with_slots = rule;
  with_slots.has_all_slots = true;
  if (meetings(with_slots).tested > 0) return kEightSlots;
  TextRule with_sign = rule;
  with_sign.number = CellNumber::floored;
  with_sign.has_unique_ids = true;
  if (meetings(with_sign).tested > 0)
    return rule.number == CellNumber::truncated ? kTruncatedCells : kUnsignedCells;
  if (as_it_is.with_a_home > 0) return kSmallerHome;
  if (as_it_is.all > 0) return kBothPhantoms;
  with_sign.has_all_slots = true;
  const Meetings mended = meetings(with_sign);
  return mended.all > 0 ? kSeveral : kNoCell;
}

}  // namespace octocell::trace
