// SPDX-License-Identifier: MIT
#include "harness/bench/stage_bytes.hpp"

#include "core/pair.hpp"
#include "core/sphere.hpp"

namespace octocell::bench {

std::map<Stage, std::uint64_t> stage_bytes(Method method, std::uint64_t spheres,
                                           const Counts& counts) {
  constexpr std::uint64_t kIdBytes = 4;
  constexpr std::uint64_t kEntryBytes = 8;  // a cell id and its object
  const std::uint64_t scene = spheres * sizeof(Sphere);
  const std::uint64_t entries = counts.ids * kEntryBytes;
  const std::uint64_t sure_pairs = counts.pairs * sizeof(Pair);  // includes the few that resolve
                                                                 // adds
  std::map<Stage, std::uint64_t> bytes = {
      {Stage::bounds, scene},
      {Stage::pair_tests, scene + sure_pairs},
      {Stage::resolve, counts.uncertain_pairs * (2 * sizeof(Sphere) + sizeof(Pair))}};
  if (method == Method::brute_force) return bytes;
  if (method == Method::tiles) {  // a record is as long as a sphere; there are more, by the copies
    bytes[Stage::cell_ids] = 2 * scene;
    return bytes;
  }
  bytes[Stage::cell_ids] = scene + entries;
  bytes[Stage::sort] = 2 * entries;
  bytes[Stage::cell_index] = counts.ids * kIdBytes;
  if (method == Method::half_shell) {  // the spheres are put in order, then read in that order
    bytes[Stage::cell_index] = entries + 2 * scene;
    bytes[Stage::pair_tests] = scene + counts.ids * kIdBytes + sure_pairs;
    return bytes;
  }
  bytes[Stage::pair_tests] += entries;
  return bytes;
}

}  // namespace octocell::bench
