// SPDX-License-Identifier: MIT
#include "harness/engine/memory_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "core/planner/planner.hpp"

namespace octocell {
namespace {

double bytes_of(const Capacities& lists, const HostBytes& bytes) {
  return bytes.per_id * static_cast<double>(lists.ids) +
         bytes.per_cell * static_cast<double>(lists.cells) +
         bytes.per_pair * static_cast<double>(lists.uncertain_pairs + lists.pairs);
}

/// Shortens `room`: only `share` of what exceeds `certain` remains.
std::uint64_t shortened(std::uint64_t room, std::uint64_t certain, double share) {
  if (room <= certain) return room;
  return certain + static_cast<std::uint64_t>(share * static_cast<double>(room - certain));
}

/// Removes the pair lists if the plan keeps no pairs.
Capacities without_pairs(Capacities lists, bool count_only) {
  if (count_only) lists.uncertain_pairs = lists.pairs = 0;
  return lists;
}

/// Returns the plan with lists that fit. `certain` will be written anyway. `held` is memory that
/// the finder already has and will write again.
Plan fitted(Plan plan, const HostBytes& bytes, const Capacities& certain, double held) {
  const std::optional<double> available = available_bytes();
  const double wanted = bytes.fixed + bytes_of(plan.capacity, bytes);
  if (!available || wanted <= *available + held) return plan;
  const double needed = bytes.fixed + bytes_of(certain, bytes);
  const double left = *available + held - needed;
  if (left < 0.0) {
    const std::string what = fmt::format("{} spheres, {} cell ids and {} pairs",
                                         plan.facts.sphere_count, certain.ids, certain.pairs);
    throw MemoryError(lack_of_memory(what, needed, *available + held) +
                      (certain.pairs > 0 ? "; counting needs no memory for pairs" : ""));
  }
  const double share = left / (wanted - needed);
  Capacities& room = plan.capacity;
  room.ids = shortened(room.ids, certain.ids, share);
  room.cells = shortened(room.cells, certain.cells, share);
  room.uncertain_pairs = shortened(room.uncertain_pairs, certain.uncertain_pairs, share);
  room.pairs = shortened(room.pairs, certain.pairs, share);
  return plan;
}

}  // namespace

Plan within_memory(const Plan& plan, const HostBytes& bytes) {
  constexpr double kUnasked = kGiB / 4.0;  // smaller plans are not checked: that would take too
                                           // long
  if (bytes.fixed + bytes_of(plan.capacity, bytes) < kUnasked) return plan;
  Capacities certain;
  if (plan.method != Method::home_phantom) certain.ids = plan.capacity.ids;
  return fitted(plan, bytes, certain, 0.0);
}

Plan grow_within_memory(const Plan& plan, const HostBytes& bytes, const Counts& found) {
  const Capacities& room = plan.capacity;
  const Capacities written = {
      .ids = std::min(found.ids, room.ids),
      .cells = std::min(found.cells, room.cells),
      .uncertain_pairs = std::min(found.uncertain_pairs, room.uncertain_pairs),
      .pairs = std::min(found.pairs, room.pairs)};
  const Capacities certain = {.ids = found.ids,
                              .cells = found.cells,
                              .uncertain_pairs = found.uncertain_pairs,
                              .pairs = found.pairs};
  return fitted(grow(plan, found), bytes, without_pairs(certain, plan.count_only),
                bytes.fixed + bytes_of(without_pairs(written, plan.count_only), bytes));
}

}  // namespace octocell
