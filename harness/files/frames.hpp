// SPDX-License-Identifier: MIT
// Recorded frames: a folder with one file per frame.
#pragma once

#include <string>
#include <vector>

#include "harness/scenes/motion.hpp"

namespace octocell {

/// Returns every *.npy and *.npy.gz of a folder that is not hidden, in the natural order of names:
/// f2 before f10. Throws InputError if there is none.
std::vector<std::string> frame_files(const std::string& folder);

/// Returns the spheres of all frames. Their number may differ from frame to frame.
Frames load_frames(const std::string& folder);

/// Does the same for spheres that move and so keep their number and their ids. Throws InputError
/// that names the first frame with another number.
Frames load_trajectory(const std::string& folder);

}  // namespace octocell
