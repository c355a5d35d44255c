// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/finder.hpp"

namespace octocell::cuda_custom {

/// The pipeline as kernels of our own, on the first CUDA device: queued as a whole, without a wait.
/// Throws Error where why_unavailable() says something.
std::unique_ptr<PairFinder> make_backend();

/// Nothing if make_backend() works here, else why not.
std::optional<std::string> why_unavailable();

}  // namespace octocell::cuda_custom
