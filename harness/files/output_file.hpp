// SPDX-License-Identifier: MIT
// The only code of this program that writes files.
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
  std::function<void(const ByteSink&)> write;  // passes on all bytes, piece by piece
};

/// Writes each regular file completely or not at all: no file replaces its target before all are
/// complete. A replaced file's permissions and owner are kept. Links are followed. Anything else (a
/// device, a pipe) is written directly, and first. Throws InputError "cannot write PATH: reason".
void write_whole_files(std::span<const FileToWrite> files);

void write_whole_file(const std::string& path, std::string_view text);

/// Throws InputError if write_whole_files() would certainly fail; changes nothing. Commands that
/// work for long before they write call it first.
void require_writable(const std::string& path);

}  // namespace octocell
