// SPDX-License-Identifier: MIT
// Rule as_written: the course text, word for word.
#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "core/as_written.hpp"
#include "harness/trace/why_rules.hpp"

namespace octocell::trace {
namespace {

Cell shown(const TextEntry& e) {
  return {static_cast<std::uint32_t>(e.cell[0]), static_cast<std::uint32_t>(e.cell[1]),
          static_cast<std::uint32_t>(e.cell[2])};
}

void show(ListedSphere& s, const TextListing& listing) {
  s.cell_count = listing.size();
  for (const TextEntry& e : listing) {
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
  const TextRule text = {.side = as_written::cell_side(plan.facts.r_max)};
  account.cells = fmt::format("cells of side {:g} = 1.5 r_max, eight slots a sphere", text.side);
  const TextListing a = list(text, account.i.sphere);
  const TextListing b = list(text, account.j.sphere);
  show(account.i, a);
  show(account.j, b);
  for_each_meeting(a, b, [&](std::size_t k, std::size_t l) {
    const bool tested = is_tested(text, a, k, b, l);
    account.meetings.push_back({.cell = shown(a[k]),
                                .id = static_cast<std::uint32_t>(a[k].id[2]),
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
