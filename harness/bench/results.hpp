// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "harness/bench/result_file.hpp"
#include "harness/bench/row_runner.hpp"

namespace octocell::bench {

/// The JSON that reports/ reads (docs/measuring.md describes its fields). It is written as a whole
/// after every group, so that an interrupted run keeps its results.
class Results {
 public:
  Results(std::string path, nlohmann::ordered_json context);

  void add_group(nlohmann::ordered_json group);
  void add_row(const Group& group, const RowSpec& row, const RowResult& result);
  void finish() { document_["context"]["finished"] = true; }

  /// See ResultFile.
  void make_folder() const { file_.make_folder(); }
  void require_writable() const { file_.require_writable(); }
  void write() const { file_.write(document_); }

 private:
  ResultFile file_;
  nlohmann::ordered_json document_;
};

}  // namespace octocell::bench
