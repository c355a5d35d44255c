// SPDX-License-Identifier: MIT
// The scenes on which a hand-in is tried, from the smallest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/verify/stress/catalogue.hpp"

namespace octocell::hand_in {

/// Random keys for a sort, without spheres.
struct RandomKeys {
  std::size_t count;
  std::uint32_t bits;  // every key is below 2^bits
  std::size_t seed;
};

/// Those of the last two are tried as long as there is time.
enum class Part : std::uint8_t { small, kinds, stress, larger };
inline constexpr std::array<std::string_view, 4> kPartNames = {"small", "kinds", "stress",
                                                               "larger"};

struct TrialScene {
  std::string spec;  // of a generator; empty: the scene without spheres
  Part part = Part::small;
  bool has_little_room = false;  // the list of pairs begins too small
  std::optional<RandomKeys> keys = {};
  const stress::Entry* stress = nullptr;  // all cases of this entry of the catalogue

  [[nodiscard]] bool is_within_budget() const { return part >= Part::stress; }
};

/// Returns the sizes 0, 1, 2, 3, 33 and 1000, borders of tiles, and every kind of scene; then a
/// slice of the stress catalogue, and larger ones.
std::vector<TrialScene> trial_scenes(std::size_t seed);

/// Returns keys of several sizes and widths, from none to several blocks.
std::vector<TrialScene> random_key_scenes(std::size_t seed);

/// Returns scenes with so many pairs of different kinds that a flaw shows what it is.
std::vector<std::string> telling_scenes(std::size_t seed);

}  // namespace octocell::hand_in
