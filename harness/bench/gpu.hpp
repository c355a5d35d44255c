// SPDX-License-Identifier: MIT
// The GPU that rows run on. CMake compiles gpu.cu, or gpu_missing.cpp where there is no nvcc.
#pragma once

#include <optional>
#include <string>

namespace octocell::bench {

/// Why nothing can run on a GPU here; nothing where something can.
std::optional<std::string> why_no_gpu();

struct Gpu {
  std::string name;
  std::string driver;                // the CUDA version it serves, such as 13.0
  double copy_gigabytes_per_second;  // read and written: what no stage can be faster than
};
/// Measures the copy, so call it once. Throws Error where why_no_gpu() says something.
Gpu describe_gpu();

}  // namespace octocell::bench
