// SPDX-License-Identifier: MIT
#include "harness/try/trial_scenes.hpp"

#include <fmt/format.h>

#include <utility>

namespace octocell::hand_in {
namespace {

/// Returns the entries of a slice that ask for the pairs of a scene.
std::vector<stress::Entry>& stress_entries() {
  static std::vector<stress::Entry> entries = [] {
    std::vector<stress::Entry> all = stress::catalogue();
    std::erase_if(all, [](const stress::Entry& entry) {
      return entry.ask != stress::Ask::pairs || entry.sizes.slice == 0 || entry.cases == nullptr;
    });
    return all;
  }();
  return entries;
}

}  // namespace

std::vector<TrialScene> trial_scenes(std::size_t seed) {
  std::vector<TrialScene> all = {{""}, {"gas:n=1"}, {"chain:n=2"}, {"chain:n=3"}};
  Part part = Part::small;
  const auto add = [&](const char* scene, std::size_t n, const char* more = "") {
    all.push_back({fmt::format("{}:n={},seed={}{}", scene, n, seed, more), part});
  };
  const auto add_plain = [&](const char* spec) { all.push_back({spec, part}); };
  add("dense", 33);
  add("dense", 1000);
  ++seed;  // the same size, other spheres: an answer that is kept from the last call is wrong
  add("dense", 1000);
  for (const std::size_t border : {255U, 256U, 257U, 1023U, 1024U, 1025U}) add("dense", border);
  // Around zero, and a list whose room is too small at first.
  add("shifted", 1000, ",offset=0,phi=0.3");
  add("dense", 1500);
  all.back().has_little_room = true;
  part = Part::kinds;
  add("gas", 2000);
  add("poly", 2000);
  add("cluster", 2000);
  add("lattice", 1000);
  add("lattice", 1000, ",shuffle=1,spacing=0.75");
  add("shifted", 2000, ",phi=0.3");
  add("giant", 2000);
  add("discs", 2000);
  add_plain("identical:n=200");
  add_plain("chain:n=2000");
  add_plain("fcc:n=1000");
  for (const stress::Entry& entry : stress_entries()) {
    all.push_back({fmt::format("stress {}", entry.id), Part::stress});
    all.back().stress = &entry;
  }
  part = Part::larger;
  for (const std::size_t n : {5'000U, 20'000U, 70'000U, 200'000U, 1'000'000U}) {
    for (const char* scene : {"gas", "poly", "dense", "cluster"}) {
      add(scene, n);
    }
  }
  return all;
}

std::vector<TrialScene> random_key_scenes(std::size_t seed) {
  std::vector<TrialScene> all;
  const auto add = [&](std::size_t count, std::uint32_t bits) {
    TrialScene scene = {fmt::format("keys:n={},bits={},seed={}", count, bits, seed)};
    scene.keys = {count, bits, seed};
    all.push_back(std::move(scene));
  };
  for (const std::size_t count : {0U, 1U, 2U, 3U, 33U, 1000U}) add(count, 6);
  for (const std::size_t count : {255U, 256U, 257U, 1023U, 1024U, 1025U}) add(count, 8);
  for (const std::uint32_t bits : {0U, 1U, 9U, 17U, 31U, 32U}) add(5000, bits);
  for (const std::size_t count : {65535U, 65536U, 65537U}) add(count, 20);
  return all;
}

std::vector<std::string> telling_scenes(std::size_t seed) {
  return {fmt::format("dense:n=2000,seed={}", seed), fmt::format("poly:n=4000,seed={}", seed),
          fmt::format("lattice:n=1000,seed={},shuffle=1,spacing=0.75", seed), "lattice:n=1000"};
}

}  // namespace octocell::hand_in
