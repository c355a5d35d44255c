// SPDX-License-Identifier: MIT
// The parts of examine(), in the order of the report.
#pragma once

#include <string>
#include <vector>

#include "harness/doctor/doctor.hpp"

namespace octocell::doctor {

/// Tries a right hand-in in C++, Python and CUDA, as `octocell try` does.
std::vector<Way> try_ways(const std::string& python);

Check compiler(const Way& cpp);
std::vector<Check> python_packages(const std::string& python);
/// nvcc, the driver, and the GPUs.
std::vector<Check> cuda(const Way& way);
/// Memory, disk and limits.
std::vector<Check> machine();

}  // namespace octocell::doctor
