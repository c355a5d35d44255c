// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/finder.hpp"

namespace octocell::on_thrust {

/// Says which of Thrust's host systems was compiled in: OpenMP, or plain C++ (for ThreadSanitizer,
/// which does not understand OpenMP's barriers).
#ifdef OCTOCELL_THRUST_OPENMP
inline constexpr std::string_view kHostSummary = "Thrust's algorithms on CPU threads (OpenMP)";
inline constexpr bool kHostThreaded = true;
#else
inline constexpr std::string_view kHostSummary = "Thrust's algorithms on one CPU thread (C++)";
inline constexpr bool kHostThreaded = false;
#endif
inline constexpr std::string_view kCudaSummary = "Thrust's algorithms on the GPU (CUDA)";

/// Makes the backend that runs Thrust's algorithms on this machine's threads.
std::unique_ptr<PairFinder> make_host_backend();

/// Makes the same on the first CUDA device. Throws Error with the reason of why_no_cuda(), if there
/// is one.
std::unique_ptr<PairFinder> make_cuda_backend();

/// Returns why make_cuda_backend() cannot work here; none if it can. Looks only once.
std::optional<std::string> why_no_cuda();

}  // namespace octocell::on_thrust
