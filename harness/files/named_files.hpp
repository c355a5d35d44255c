// SPDX-License-Identifier: MIT
// The files of a command line. Each command lists what it reads and writes before it begins. So
// nothing is computed for a file that cannot be written, and no input is lost.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/files/file_identity.hpp"
#include "harness/files/input_file.hpp"
#include "harness/files/load.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {

class NamedFiles {
 public:
  void read_scene(std::string_view argument, const std::optional<std::string>& flags = {}) {
    if (auto path = file_of(argument)) {
      if (*path == kStandardInput) *path = "/dev/stdin";
      read("SCENE", std::move(*path));
    }
    if (flags) read("--flags", *flags);
  }
  void read(std::string_view role, std::string path) { inputs_.push_back({role, std::move(path)}); }
  void write(std::string_view option, const std::optional<std::string>& path) {
    if (path && !path->empty()) outputs_.push_back({option, *path});
  }
  /// Throws InputError if writing would lose a file.
  void require_separate() const { require_separate_files(inputs_, outputs_); }

 private:
  std::vector<NamedFile> inputs_;
  std::vector<NamedFile> outputs_;
};

}  // namespace octocell
