// SPDX-License-Identifier: MIT
// What one stage reads and what it should write: the arrays of a run of impl_cpu.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/scenes/scene.hpp"
#include "include/octocell/octocell_stage.h"

namespace octocell::hand_in {

/// Cell ids with their objects.
struct Entries {
  std::vector<std::uint32_t> ids;
  std::vector<std::uint32_t> objects;
  [[nodiscard]] std::size_t size() const { return ids.size(); }
};

struct StageArrays {
  octocell_grid grid = {};
  std::uint32_t key_bits = 0;  // every id is below 2^key_bits
  Entries unsorted;            // after stage 2
  Entries sorted;              // after stage 3
  std::vector<octocell_cell> cells;
};

/// Returns the arrays of rule lowest_cell, with cells of the largest diameter. None for a scene so
/// wide that cell ids repeat.
std::optional<StageArrays> arrays_of(const Scene& scene);

/// Returns `n` random keys below 2^bits as entries, and the same sorted.
StageArrays random_keys(std::size_t n, std::uint32_t bits, std::size_t seed);

/// Returns what a stable sort makes of the entries, by the bits of the ids that `mask` has.
Entries stably_sorted(const Entries& entries, std::uint32_t mask = ~0U);

}  // namespace octocell::hand_in
