// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "core/pair.hpp"
#include "core/sphere.hpp"
#include "include/octocell/box.hpp"

namespace octocell {

/// Functions that write NPY, version 1.0, C order, little-endian: float32 (n, 4) or uint32 (m, 2).
/// A scene whose name ends in .csv becomes CSV, with columns for its flags if it has any.
/// `flags_path` names another NPY for them, uint32 (n,); without it, NPY cannot hold a scene with
/// flags.
///
/// A regular file is written completely or not at all: it is written beside the target, synced and
/// renamed (both files, if there are two). After a failure an existing target is unchanged, and no
/// other file is left. Devices and pipes (/dev/stdout) are written directly. Throws InputError with
/// path and reason. The name of a regular file must have the extension of its format, so that it
/// can be loaded again.
void save_scene(const std::string& path, SceneView scene, const std::string& flags_path = {});
inline void save_scene(const std::string& path, std::span<const Sphere> spheres) {
  save_scene(path, SceneView{spheres});
}
void save_pairs(const std::string& path, std::span<const Pair> pairs);

/// Writes pairs and their shifts, int32 (m, 3); either is left out if its path is empty.
void save_image_pairs(const std::string& path, std::span<const Pair> pairs,
                      const std::string& shifts_path, std::span<const Shift> shifts);

/// Writes the depth of each pair, in the order of pairs, float32 (m,), and also the pairs unless
/// `pairs_path` is empty. Depths are computed while they are written, so they need no memory.
void save_depths(const std::string& path, std::span<const Sphere> spheres,
                 std::span<const Pair> pairs, const std::string& pairs_path = {});

/// Throw what the functions above would throw for this path, as far as that is known beforehand.
void require_savable_scene(const std::string& path);
void require_savable_list(const std::string& path);  // pairs, depths or flags

}  // namespace octocell
