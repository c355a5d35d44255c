// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/bench/sort/algorithms.hpp"
#include "harness/bench/sort/sort_cases.hpp"
#include "harness/bench/sort/sort_check.hpp"

namespace octocell::bench {

struct SortRow {
  const Algorithm* how;
  int threads;
};

/// Returns each sort on one thread; those that can use more, also on `threads`.
std::vector<SortRow> sort_rows(int threads);

/// Returns a name such as "sort/algorithm:impl_cpu/n:4096/bits:8/order:random/threads:1".
std::string row_name(const SortRow& row, const SortCase& what);

/// The fields of a row's JSON, without its case.
struct SortReport {
  std::string name;
  std::string_view algorithm;
  std::string_view device;  // cpu or gpu
  int threads;              // 0 on a GPU
  bool stable;
  bool packed;
  std::uint64_t iterations;
  std::vector<double> total_ms;
  std::optional<std::string> skipped;
  std::optional<std::string> wrong;
};
nlohmann::ordered_json sort_row_json(const SortReport& row, const SortCase& what);

/// The input of a case, and the memory in which its rows work.
struct SortSubject {
  explicit SortSubject(const SortCase& what);

  SortCase what;
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> values;  // 0, 1, 2, ...
  SortTruth truth;
  Workspace work;
};

/// Runs one row of a case: first checks whether it is right, then measures it round by round. Every
/// answer is checked, outside the timed part.
class SortRunner {
 public:
  /// `skipped` says why the row will not run; none if it will.
  SortRunner(const SortRow& row, SortSubject& subject, std::optional<std::string> skipped);

  /// Sorts once. The time decides how often a measurement repeats it.
  void verify(double min_time_ms);

  /// Measures once with Google Benchmark.
  void measure();

  [[nodiscard]] const SortRow& row() const { return row_; }
  [[nodiscard]] bool runs() const { return !skipped_ && !wrong_; }
  [[nodiscard]] bool wrong() const { return wrong_.has_value(); }
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  /// Sorts the input once; checks the answer after the time was taken.
  double sort_ms();

  SortRow row_;
  SortSubject& subject_;
  std::unique_ptr<Sorter> sorter_;
  std::uint64_t iterations_ = 0;
  std::vector<double> total_ms_;  // one per round
  std::optional<std::string> skipped_;
  std::optional<std::string> wrong_;  // what is wrong
};

}  // namespace octocell::bench
