// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/finder.hpp"

namespace octocell::cuda_custom {

/// Makes the backend that runs the pipeline as our own kernels on the first CUDA device. All stages
/// are queued at once, without waiting. Throws Error with the reason of why_unavailable(), if there
/// is one.
std::unique_ptr<PairFinder> make_backend();

/// Returns why make_backend() cannot work here; none if it can.
std::optional<std::string> why_unavailable();

}  // namespace octocell::cuda_custom
