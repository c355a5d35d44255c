// SPDX-License-Identifier: MIT
// One file has many names: ./a, a link to it, its folder's other path. Files are compared, not
// names.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>
#include <string_view>

namespace octocell {

/// The file that a path leads to, whether it exists or not. Equal identities are one file.
struct FileIdentity {
  dev_t device = 0;  // of the file or, if there is none yet, of its folder
  ino_t inode = 0;
  std::string name;  // in that folder; empty if the file exists
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};
FileIdentity identity_of(const std::string& path);

/// The path behind symbolic links, also if nothing exists there yet.
std::string follow_links(const std::string& path);

/// A path that was named on the command line, and what for.
struct NamedFile {
  std::string_view role;  // "--output"
  std::string path;
};

/// Throws InputError if an output is one of the inputs, or the same file as another output: one
/// would be lost. Devices and pipes may be named twice.
void require_separate_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

}  // namespace octocell
