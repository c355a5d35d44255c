// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace octocell::bench {

/// Where a bench writes its JSON, whole each time.
class ResultFile {
 public:
  explicit ResultFile(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] const std::string& path() const { return path_; }

  /// Makes the folder of the file if there is none; require_writable() says what went wrong.
  void make_folder() const;

  /// Throws InputError if write() would have no chance; leaves everything as it was.
  void require_writable() const;

  /// Atomic: a temporary file beside the target, then a rename. Throws InputError.
  void write(const nlohmann::ordered_json& document) const;

 private:
  std::string path_;
};

}  // namespace octocell::bench
