// SPDX-License-Identifier: MIT
// The GPU that rows run on. CMake compiles gpu.cu; without nvcc, gpu_missing.cpp.
#pragma once

#include <optional>
#include <string>

namespace octocell::bench {

/// Returns why nothing can run on a GPU here; none if something can.
std::optional<std::string> why_no_gpu();

struct Gpu {
  std::string name;
  std::string driver;                // the CUDA version that the driver supports, such as 13.0
  double copy_gigabytes_per_second;  // bytes read and written: the upper limit for every stage
};
/// Describes the GPU. Measures a copy, so call it once. Throws Error with the reason of
/// why_no_gpu(), if there is one.
Gpu describe_gpu();

}  // namespace octocell::bench
