// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace octocell {

struct FileToWrite {
  std::string path;
  std::vector<std::span<const std::byte>> parts;  // one after another
};

/// Regular files are written whole or not at all: none takes its place before all are complete.
/// Anything else (a device, a pipe) is written directly, and first. Throws InputError "cannot write
/// PATH: reason".
void write_whole_files(std::span<const FileToWrite> files);

inline void write_whole_file(const std::string& path,
                             std::initializer_list<std::span<const std::byte>> parts) {
  const FileToWrite file = {path, parts};
  write_whole_files({&file, 1});
}

}  // namespace octocell
