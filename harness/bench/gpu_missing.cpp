// SPDX-License-Identifier: MIT
#include <optional>
#include <string>

#include "core/error.hpp"
#include "harness/bench/gpu.hpp"

namespace octocell::bench {

std::optional<std::string> why_no_gpu() { return "built without nvcc"; }
Gpu describe_gpu() { throw Error(*why_no_gpu()); }

}  // namespace octocell::bench
