// SPDX-License-Identifier: MIT
// Rule as_written, and which mistake of the text loses a pair: the one without which the rule would
// find it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/as_written.hpp"
#include "harness/trace/why_rules.hpp"

namespace octocell::trace {
namespace {

/// The text's rule, or the rule with some of its mistakes mended.
struct Text {
  float side;
  bool has_signed_cells = false;  // floor instead of a cast to unsigned
  bool has_all_slots = false;     // room for every phantom
};

/// Ids in their order. The text joins three coordinates into one number; signed ones are z, y, x.
using Id = std::array<long, 3>;

struct Entry {
  long cell[3];
  Id id;
};

struct Listing {
  std::vector<Entry> cells;  // the home first
};

Id id_of(const Text& text, const long (&c)[3]) {
  if (text.has_signed_cells) return {c[2], c[1], c[0]};
  const auto number = [](long at) { return static_cast<std::uint32_t>(at); };
  return {0, 0, as_written::hash({number(c[0]), number(c[1]), number(c[2])})};
}

long coordinate(const Text& text, float p) {
  if (!text.has_signed_cells) return as_written::saturated(p / text.side);
  return static_cast<long>(std::clamp(std::floor(p / text.side), -4e9F, 4e9F));
}

float gap(const Text& text, float p, long c) {
  const float low = static_cast<float>(c) * text.side;
  const float high = low + text.side;
  if (p < low) return low - p;
  return p > high ? p - high : 0.0F;
}

bool ball_meets(const Text& text, const Sphere& s, const long (&c)[3]) {
  const float x = gap(text, s.x, c[0]);
  const float y = gap(text, s.y, c[1]);
  const float z = gap(text, s.z, c[2]);
  return x * x + y * y + z * z <= s.r * s.r;
}

bool is_outside(const Text& text, const long (&c)[3]) {
  if (text.has_signed_cells) return false;
  return std::ranges::any_of(c, [](long at) { return at < 0 || at > 0xffffffffL; });
}

Listing list(const Text& text, const Sphere& s) {
  const long home[3] = {coordinate(text, s.x), coordinate(text, s.y), coordinate(text, s.z)};
  Listing listing = {{Entry{{home[0], home[1], home[2]}, id_of(text, home)}}};
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const long c[3] = {home[0] + neighbour % 3 - 1, home[1] + neighbour / 3 % 3 - 1,
                       home[2] + neighbour / 9 - 1};
    if (neighbour == 13 || is_outside(text, c) || !ball_meets(text, s, c)) continue;
    if (!text.has_all_slots && listing.cells.size() > as_written::kMaxPhantoms) break;
    listing.cells.push_back({{c[0], c[1], c[2]}, id_of(text, c)});
  }
  return listing;
}

/// Home with home; home with phantom if the phantom's home id is the larger.
bool is_tested(const Listing& a, std::size_t k, const Listing& b, std::size_t l) {
  if (k != 0 && l != 0) return false;
  if (k == 0 && l == 0) return true;
  const Listing& home = k == 0 ? a : b;
  const Listing& phantom = k == 0 ? b : a;
  return phantom.cells[0].id > home.cells[0].id;
}

/// How often a rule tests the pair, and in which kinds of cell they meet.
struct Meetings {
  int tested = 0;
  int with_a_home = 0;
  int all = 0;
};

template <typename Use>
void for_each_meeting(const Listing& a, const Listing& b, Use use) {
  for (std::size_t k = 0; k < a.cells.size(); ++k) {
    for (std::size_t l = 0; l < b.cells.size(); ++l) {
      if (a.cells[k].id == b.cells[l].id) use(k, l);
    }
  }
}

Meetings count(const Listing& a, const Listing& b) {
  Meetings found;
  for_each_meeting(a, b, [&](std::size_t k, std::size_t l) {
    ++found.all;
    found.with_a_home += k == 0 || l == 0 ? 1 : 0;
    found.tested += is_tested(a, k, b, l) ? 1 : 0;
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

/// Mends one mistake after the other, the cheapest first.
Flaw flaw_of(const Text& text, const Sphere& a, const Sphere& b) {
  const auto meetings = [&](Text mended) { return count(list(mended, a), list(mended, b)); };
  const Meetings as_it_is = meetings(text);
  if (as_it_is.tested > 1) return kSharedIds;
  Text with_slots = text;
  with_slots.has_all_slots = true;
  if (meetings(with_slots).tested > 0) return kEightSlots;
  Text with_sign = text;
  with_sign.has_signed_cells = true;
  if (meetings(with_sign).tested > 0) return kUnsignedCells;
  if (as_it_is.with_a_home > 0) return kSmallerHome;
  if (as_it_is.all > 0) return kBothPhantoms;
  with_sign.has_all_slots = true;
  const Meetings mended = meetings(with_sign);
  return mended.all > 0 ? kSeveral : kNoCell;
}

Cell shown(const Entry& e) {
  return {static_cast<std::uint32_t>(e.cell[0]), static_cast<std::uint32_t>(e.cell[1]),
          static_cast<std::uint32_t>(e.cell[2])};
}

void show(ListedSphere& s, const Listing& listing) {
  s.cell_count = listing.cells.size();
  for (const Entry& e : listing.cells) {
    const bool is_home = s.cells.empty();
    s.cells.push_back({shown(e), static_cast<std::uint32_t>(e.id[2]), is_home});
  }
}

std::string reason_of(bool home_of_i, bool home_of_j, bool tested) {
  if (home_of_i && home_of_j) return "home of both: tested";
  if (!home_of_i && !home_of_j) return "both are phantoms here: not tested";
  return tested ? "the phantom's home has the larger id: tested"
                : "the phantom's home has the smaller id: not tested";
}

}  // namespace

void meet_as_written(Account& account, const Plan& plan) {
  const Text text = {.side = as_written::cell_side(plan.facts.r_max)};
  account.cells = fmt::format("cells of side {:g} = 1.5 r_max, eight slots a sphere", text.side);
  const Listing a = list(text, account.i.sphere);
  const Listing b = list(text, account.j.sphere);
  show(account.i, a);
  show(account.j, b);
  for_each_meeting(a, b, [&](std::size_t k, std::size_t l) {
    const bool tested = is_tested(a, k, b, l);
    account.meetings.push_back({.cell = shown(a.cells[k]),
                                .id = static_cast<std::uint32_t>(a.cells[k].id[2]),
                                .home_of_i = k == 0,
                                .home_of_j = l == 0,
                                .tested = tested,
                                .reason = reason_of(k == 0, l == 0, tested)});
    ++account.meeting_count;
    account.test_count += tested ? 1 : 0;
  });
  if (account.should_be_found() && account.test_count != 1) {
    account.flaw = flaw_of(text, account.i.sphere, account.j.sphere);
  }
}

}  // namespace octocell::trace
