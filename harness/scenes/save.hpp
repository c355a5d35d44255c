// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "harness/interface/pair.hpp"
#include "harness/interface/sphere.hpp"

namespace octocell {

/// Both write NPY, version 1.0, C order, little-endian: float32 (n, 4) or uint32 (m, 2).
///
/// A regular file appears whole or not at all: it is written beside the target, synced, and
/// renamed; after a failure an existing target is as it was, and nothing else is left. Devices
/// and pipes (/dev/stdout) are written to directly. Throws InputError with path and reason; the
/// name of a regular file must end in .npy, so that it can be loaded again.
void save_scene(const std::string& path, std::span<const Sphere> spheres);
void save_pairs(const std::string& path, std::span<const Pair> pairs);

}  // namespace octocell
