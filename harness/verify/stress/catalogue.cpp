// SPDX-License-Identifier: MIT
#include "harness/verify/stress/catalogue.hpp"

namespace octocell::stress {

std::vector<Entry> catalogue() {
  std::vector<Entry> all;
  for (const auto family : {ties, cell_borders, range, size_distribution, concentration, capacity,
                            dynamics, determinism, metamorphic, real}) {
    const std::span<const Entry> entries = family();
    all.insert(all.end(), entries.begin(), entries.end());
  }
  return all;
}

}  // namespace octocell::stress
