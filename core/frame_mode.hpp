// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/skips.hpp"

namespace octocell {

/// What a frame does; backends that reuse data from the last frame choose one. Only impl_cpu has
/// few_movers.
enum class FrameMode : std::uint32_t {
  search,         // searches all pairs
  unchanged,      // no sphere has changed: keeps the pairs
  few_movers,     // keeps the pairs of spheres that have not moved, searches the others'
  neighbor_list,  // no sphere has left the skin: tests only the neighbor pairs
};

/// Returns the skip that spares a frame with this mode a search.
constexpr std::optional<Skip> skip_of(FrameMode mode) {
  if (mode == FrameMode::unchanged) return Skip::unchanged;
  if (mode == FrameMode::few_movers) return Skip::few_movers;
  if (mode == FrameMode::neighbor_list) return Skip::skin;
  return std::nullopt;
}

}  // namespace octocell
