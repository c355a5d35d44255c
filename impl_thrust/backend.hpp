// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/finder.hpp"

namespace octocell::on_thrust {

/// Which of Thrust's host systems was compiled in: OpenMP, or (for ThreadSanitizer, which does not
/// know OpenMP's barriers) plain C++.
#ifdef OCTOCELL_THRUST_OPENMP
inline constexpr std::string_view kHostSummary = "Thrust's algorithms on CPU threads (OpenMP)";
inline constexpr bool kHostThreaded = true;
#else
inline constexpr std::string_view kHostSummary = "Thrust's algorithms on one CPU thread (C++)";
inline constexpr bool kHostThreaded = false;
#endif
inline constexpr std::string_view kCudaSummary = "Thrust's algorithms on the GPU (CUDA)";

/// The pipeline in Thrust's words, on this machine's threads.
std::unique_ptr<PairFinder> make_host_backend();

/// The same on the first CUDA device. Throws Error where why_no_cuda() says something.
std::unique_ptr<PairFinder> make_cuda_backend();

/// Nothing if make_cuda_backend() works here, else why not. Looks once.
std::optional<std::string> why_no_cuda();

}  // namespace octocell::on_thrust
