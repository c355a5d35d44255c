// SPDX-License-Identifier: MIT
// The sorts that a build may lack. CMake compiles either tbb.cpp or tbb_missing.cpp, and either
// highway.cpp or highway_missing.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "harness/bench/sort/algorithms.hpp"

namespace octocell::bench {

Algorithm tbb_parallel_sort();
std::optional<std::string> tbb_version();

Algorithm highway_vqsort();
std::optional<std::string> highway_version();

}  // namespace octocell::bench
