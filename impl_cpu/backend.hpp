// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/finder.hpp"

namespace octocell::cpu {

/// The pipeline on this machine's threads: readable, exact, and no slouch.
std::unique_ptr<PairFinder> make_backend();

}  // namespace octocell::cpu
