// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/finder.hpp"

namespace octocell::cpu {

/// Makes the backend that runs the pipeline on this machine's threads.
std::unique_ptr<PairFinder> make_backend();

}  // namespace octocell::cpu
