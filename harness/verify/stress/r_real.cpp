// SPDX-License-Identifier: MIT
// R. Real scenes: files that people computed or measured, as far as they were downloaded.
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/files/load.hpp"
#include "harness/files/real_scenes.hpp"
#include "harness/verify/stress/catalogue.hpp"

namespace octocell::stress {
namespace {

constexpr std::size_t kMost = 32;  // real scenes

/// Loads scene k of the table; `n` is its number of spheres, or 0.
template <std::size_t k>
std::vector<Case> cases_of(std::size_t n) {
  if (n == 0) return {};
  const RealScene& real = real_scenes()[k];
  return {{.name = std::string(real.name), .spheres = load_scene(std::string(real.path)).spheres}};
}

template <std::size_t... k>
constexpr auto all_cases(std::index_sequence<k...>) {
  return std::array{cases_of<k>...};
}

/// An entry keeps views of texts that are made at run time.
struct Texts {
  std::string id;
  std::string name;
};

std::vector<Entry> entries() {
  static constexpr auto kCases = all_cases(std::make_index_sequence<kMost>());
  static std::vector<Texts> texts;
  texts.reserve(real_scenes().size());
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < real_scenes().size(); ++k) {
    const RealScene& real = real_scenes()[k];
    texts.push_back({fmt::format("R{}", k + 1), fmt::format("{}: {}", real.name, real.about)});
    Entry entry = {.id = texts[k].id, .name = texts[k].name};
    if (is_there(real)) {
      entry.sizes = {0, real.spheres, real.spheres};
      entry.cases = kCases.at(k);
    } else {
      entry.not_run = "the file is not there: make real";
    }
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace

std::span<const Entry> real() {
  static const std::vector<Entry> kReal = entries();
  return kReal;
}

}  // namespace octocell::stress
