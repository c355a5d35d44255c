// SPDX-License-Identifier: MIT
// What a caller may say about a file if the file itself does not say it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/files/format.hpp"

namespace octocell {

struct LoadOptions {
  std::optional<std::string> flags = {};  // path of a separate NPY file with flags
  /// Accepts float64 arrays and rounds them to float32. Stores them, or the float64 numbers that a
  /// generator rounds, in Scene::unrounded.
  bool round_input = false;
  std::optional<Format> format = {};        // none: the suffix tells it
  std::optional<float> radius = {};         // of all spheres, for a file without radii
  std::optional<std::string> columns = {};  // of a table, spelled as in a header: "id,x,y,z,r"
  bool decimal_comma = false;               // "0,5" in a table is a half
  std::uint64_t frame = 0;                  // of a file with several frames
  bool drop_invalid = false;                // leaves out spheres that are not finite or have r < 0
};

/// Returns the options about a file's contents as on the command line: {"--radius", "0.5"}.
std::vector<std::string> words_about_file(const LoadOptions& options);

/// Returns all options in the same form.
std::vector<std::string> words_of(const LoadOptions& options);

}  // namespace octocell
