// SPDX-License-Identifier: MIT
#include "harness/bench/result_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "core/error.hpp"
#include "harness/files/json_text.hpp"
#include "harness/files/output_file.hpp"

namespace octocell::bench {

void ResultFile::make_folder() const {
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  std::error_code ignored;
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
}

void ResultFile::require_writable() const {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path_, error).type();
  using enum std::filesystem::file_type;
  if (type != regular && type != not_found && type != directory) {
    throw InputError(fmt::format("cannot write {}: not a regular file", path_));
  }
  octocell::require_writable(path_);
}

void ResultFile::write(const nlohmann::ordered_json& document) const {
  write_whole_file(path_, json_text(document, 1) + "\n");
}

}  // namespace octocell::bench
