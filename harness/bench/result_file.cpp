// SPDX-License-Identifier: MIT
#include "harness/bench/result_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <span>
#include <system_error>

#include "harness/interface/error.hpp"
#include "harness/scenes/output_file.hpp"

namespace octocell::bench {

void ResultFile::make_folder() const {
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  std::error_code ignored;
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
}

void ResultFile::require_writable() const {
  struct stat target = {};
  if (stat(path_.c_str(), &target) == 0) {
    if (!S_ISREG(target.st_mode)) refuse("not a regular file");
    if (access(path_.c_str(), W_OK) != 0) refuse(std::strerror(errno));
    return;
  }
  if (errno != ENOENT) refuse(std::strerror(errno));
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0) refuse(std::strerror(errno));
}

void ResultFile::refuse(const char* reason) const {
  throw InputError(fmt::format("cannot write {}: {}", path_, reason));
}

void ResultFile::write(const nlohmann::ordered_json& document) const {
  const std::string text = document.dump(1) + "\n";
  write_whole_file(path_, {std::as_bytes(std::span(text))});
}

}  // namespace octocell::bench
