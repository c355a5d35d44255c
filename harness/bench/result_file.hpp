// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace octocell::bench {

/// The file to which a bench writes its JSON, always as a whole.
class ResultFile {
 public:
  explicit ResultFile(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] const std::string& path() const { return path_; }

  /// Makes the file's folder if there is none; require_writable() reports what went wrong.
  void make_folder() const;

  /// Throws InputError if write() would certainly fail; changes nothing.
  void require_writable() const;

  /// Writes atomically: a temporary file beside the target, then a rename. Throws InputError.
  void write(const nlohmann::ordered_json& document) const;

 private:
  std::string path_;
};

}  // namespace octocell::bench
