// SPDX-License-Identifier: MIT
// The list of broad phases in a build without FCL and Bullet (OCTOCELL_DEVELOPER=OFF): empty.
#include <span>

#include "baselines/baselines.hpp"

namespace octocell::baselines {

std::span<const Baseline> all() { return {}; }

}  // namespace octocell::baselines
