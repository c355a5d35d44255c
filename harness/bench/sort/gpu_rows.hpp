// SPDX-License-Identifier: MIT
// The rows of one case on the GPU.
#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/bench/sort/gpu_sorts.hpp"
#include "harness/bench/sort/sort_cases.hpp"

namespace octocell::bench {

/// Returns a name such as "sort/algorithm:cub/n:4096/bits:8/order:random/threads:0".
std::string gpu_row_name(std::size_t algorithm, const SortCase& what);

class GpuRows {
 public:
  /// Makes the input and copies it to the GPU. `algorithms` are indices into gpu_algorithms().
  GpuRows(const SortCase& what, const std::vector<std::size_t>& algorithms);

  /// Sorts once with each algorithm. Wrong or very slow ones are not measured.
  void verify();

  /// Measures each row once, in an order that depends on the round.
  void measure(int round);

  [[nodiscard]] bool any_wrong() const;
  [[nodiscard]] std::vector<nlohmann::ordered_json> json() const;

 private:
  struct GpuRow {
    std::size_t algorithm;
    std::vector<double> total_ms = {};
    std::optional<std::string> skipped = {};
    std::optional<std::string> wrong = {};
  };
  void run(GpuRow& row, bool keep_time);

  SortCase what_;
  std::unique_ptr<GpuSortCase> case_;
  std::vector<GpuRow> rows_;
};

}  // namespace octocell::bench
