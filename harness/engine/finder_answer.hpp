// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/pair.hpp"
#include "core/plan.hpp"

namespace octocell {

/// All that a finder says about a scene.
struct FinderAnswer {
  Counts counts;
  PairDigest digest;
  std::vector<Pair> pairs;
};

}  // namespace octocell
