// SPDX-License-Identifier: MIT
// The one way in which this program writes a file.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace octocell {

/// Takes the next bytes of a file.
using ByteSink = std::function<void(std::span<const std::byte>)>;

struct FileToWrite {
  std::string path;
  std::function<void(const ByteSink&)> write;  // hands on all bytes, piece by piece
};

/// Writes regular files whole or not at all: none takes its place before all are complete, and
/// what stood there keeps its permissions and its owner. Links are followed. Anything else (a
/// device, a pipe) is written directly, and first. Throws InputError "cannot write PATH: reason".
void write_whole_files(std::span<const FileToWrite> files);

void write_whole_file(const std::string& path, std::string_view text);

/// Throws InputError if write_whole_files() would have no chance, and leaves all as it was: for
/// commands that have much to do before they write.
void require_writable(const std::string& path);

}  // namespace octocell
