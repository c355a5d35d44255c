// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "harness/bench/row_runner.hpp"

namespace octocell::bench {

/// The JSON that reports/ reads (docs/measuring.md describes the fields). It is written whole after
/// every group, so that an interrupted run keeps what it has.
class Results {
 public:
  Results(std::string path, nlohmann::ordered_json context);

  void add_group(nlohmann::ordered_json group);
  void add_row(const Group& group, const RowSpec& row, const RowResult& result);
  void finish() { document_["context"]["finished"] = true; }

  /// Throws InputError if write() would have no chance; leaves everything as it was.
  void require_writable() const;

  /// Atomic: a temporary file beside the target, then a rename. Throws InputError.
  void write() const;

 private:
  [[noreturn]] void refuse(const char* reason) const;

  std::string path_;
  nlohmann::ordered_json document_;
};

}  // namespace octocell::bench
