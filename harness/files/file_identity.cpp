// SPDX-License-Identifier: MIT
#include "harness/files/file_identity.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "core/error.hpp"

namespace octocell {
namespace {

namespace fs = std::filesystem;

std::optional<struct stat> status_of(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

/// Returns true if writing to the path replaces its contents. A pipe or a device loses nothing.
bool keeps_what_is_written(const std::string& path) {
  const std::optional<struct stat> status = status_of(path);
  return !status || S_ISREG(status->st_mode);
}

[[noreturn]] void refuse(const NamedFile& output, const NamedFile& other, bool is_input) {
  const std::string why =
      is_input
          ? fmt::format("it is the file of {} ({}), which would be lost", other.role, other.path)
          : fmt::format("{} and {} need a file each", other.role, output.role);
  throw InputError(fmt::format("cannot write {}: {}", output.path, why));
}

}  // namespace

std::string follow_links(const std::string& path) {
  constexpr int kMostLinks = 40;  // Linux's own limit
  std::error_code error;
  fs::path target = path;
  for (int links = 0; links < kMostLinks && fs::is_symlink(target, error); ++links) {
    target = target.parent_path() / fs::read_symlink(target, error);  // replaces the whole path if
                                                                      // absolute
  }
  return target.string();
}

FileIdentity identity_of(const std::string& path) {
  if (const auto status = status_of(path)) return {status->st_dev, status->st_ino, {}};
  std::error_code error;
  const fs::path target = fs::absolute(follow_links(path), error);
  if (const auto folder = status_of(target.parent_path().string())) {
    return {folder->st_dev, folder->st_ino, target.filename().string()};
  }
  return {0, 0, fs::weakly_canonical(target, error).string()};
}

void require_separate_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    if (!keeps_what_is_written(outputs[k].path)) continue;
    const FileIdentity written = identity_of(outputs[k].path);
    for (const NamedFile& input : inputs) {
      if (identity_of(input.path) == written) refuse(outputs[k], input, true);
    }
    for (const NamedFile& other : outputs.first(k)) {
      if (identity_of(other.path) == written) refuse(outputs[k], other, false);
    }
  }
}

}  // namespace octocell
