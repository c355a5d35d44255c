// SPDX-License-Identifier: MIT
// Recorded frames: a folder of files, one a frame.
#pragma once

#include <string>
#include <vector>

#include "harness/scenes/motion.hpp"

namespace octocell {

/// Every *.npy of a folder that is not hidden, in the natural order of their names: f2 before f10.
/// Throws InputError if there is none.
std::vector<std::string> frame_files(const std::string& folder);

/// What they hold. Throws InputError if the frames hold different numbers of spheres.
Frames load_frames(const std::string& folder);

}  // namespace octocell
