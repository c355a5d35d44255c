// SPDX-License-Identifier: MIT
// Tells whether two paths lead to the same file. One file can have many names: ./a, a link to it,
// another path to its folder. So files are compared, not names.
#pragma once

#include <sys/types.h>

#include <span>
#include <string>
#include <string_view>

namespace octocell {

/// The file that a path leads to, whether it exists or not. Two paths lead to one file if their
/// identities are equal.
struct FileIdentity {
  dev_t device = 0;  // of the file; if it does not exist, of its folder
  ino_t inode = 0;
  std::string name;  // in that folder; empty if the file exists
  friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};
FileIdentity identity_of(const std::string& path);

/// Returns the path behind symbolic links, even if nothing exists there yet.
std::string follow_links(const std::string& path);

/// A path that was given on the command line, and its purpose.
struct NamedFile {
  std::string_view role;  // "--output"
  std::string path;
};

/// Throws InputError if an output is one of the inputs, or the same file as another output: one
/// would be lost. Devices and pipes may be given twice.
void require_separate_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

}  // namespace octocell
