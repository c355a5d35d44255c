// SPDX-License-Identifier: MIT
// Judges a list of pairs that another program made for a scene: what is wrong with it, and what
// the wrong pairs have in common.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/load_pairs.hpp"
#include "harness/judge/differences.hpp"
#include "harness/judge/evidence.hpp"
#include "harness/scenes/scene.hpp"
#include "harness/trace/why.hpp"

namespace octocell::judge {

/// The first wrong pair of a kind.
struct FirstWrong {
  std::string kind;  // missed, false, duplicates, out_of_range
  ListedPair pair;
  std::optional<std::size_t> row = {};     // of the list, from 0; none for a missed pair
  std::optional<trace::Account> why = {};  // by rule lowest_cell; none if out of range
  std::optional<trace::Flaw> flaw = {};    // by which the course text's rule would lose it
};

struct Judgement {
  std::uint64_t spheres = 0;
  std::uint64_t true_pairs = 0;
  Differences differences = {};
  std::vector<FirstWrong> first = {};
  std::vector<Cause> causes = {};  // the most important first
  bool too_few_to_tell = false;    // for a cause

  [[nodiscard]] bool exact() const { return differences.exact(); }
};

/// The truth comes from the reference.
Judgement judge(std::span<const ListedPair> list, const Scene& scene);
/// The same, if the exact pairs are known, sorted.
Judgement judge(std::span<const ListedPair> list, const Scene& scene, std::span<const Pair> truth);

/// Returns lines for a terminal. `scene` and `list` are how a user names them.
std::string to_text(const Judgement& judgement, std::string_view scene, std::string_view list);
nlohmann::ordered_json to_json(const Judgement& judgement, std::string_view scene,
                               std::string_view list);
std::string to_text(const Cause& cause);
nlohmann::ordered_json to_json(const Cause& cause);
/// Returns the command that explains a pair: "octocell why gas:n=9 1 2".
std::string why_command(const FirstWrong& first, std::string_view scene);

}  // namespace octocell::judge
