// SPDX-License-Identifier: MIT
// Hand-ins that are right: solutions of the first lab (course/labs), which CMake puts into
// samples.cpp.
#pragma once

namespace octocell::doctor {

extern const char* const kSample_cpp;
extern const char* const kSample_cu;
extern const char* const kSample_py;

}  // namespace octocell::doctor
