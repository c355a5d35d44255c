// SPDX-License-Identifier: MIT
#include "harness/bench/sort/gpu_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "harness/bench/sort/sort_rows.hpp"

namespace octocell::bench {
namespace {

constexpr double kSlowMs = 200.0;

}  // namespace

std::string gpu_row_name(std::size_t algorithm, const SortCase& what) {
  return fmt::format("sort/algorithm:{}/n:{}/bits:{}/order:{}/threads:0",
                     gpu_algorithms()[algorithm], what.n, what.bits, name_of(what.order));
}

GpuRows::GpuRows(const SortCase& what, const std::vector<std::size_t>& algorithms)
    : what_(what), case_(make_gpu_sort_case(make_keys(what), what.bits)) {
  for (const std::size_t algorithm : algorithms) rows_.push_back({.algorithm = algorithm});
}

void GpuRows::run(GpuRow& row, bool keep_time) {
  const GpuRun result = case_->run(row.algorithm);
  if (result.fault) {
    row.wrong = result.fault;
    row.total_ms.clear();  // a wrong answer has no time
  } else if (keep_time) {
    row.total_ms.push_back(result.ms);
  } else if (result.ms > kSlowMs) {
    row.skipped = fmt::format("one sort took {:.0f} ms, and more than {:.0f} are not measured",
                              result.ms, kSlowMs);
  }
}

void GpuRows::verify() {
  for (GpuRow& row : rows_) run(row, false);
}

void GpuRows::measure(int round) {
  std::vector<GpuRow*> order;
  for (GpuRow& row : rows_) order.push_back(&row);
  std::shuffle(order.begin(), order.end(), std::mt19937(static_cast<unsigned>(round)));
  for (GpuRow* row : order) {
    if (!row->wrong && !row->skipped) run(*row, true);
  }
}

bool GpuRows::any_wrong() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const GpuRow& row) { return !!row.wrong; });
}

std::vector<nlohmann::ordered_json> GpuRows::json() const {
  std::vector<nlohmann::ordered_json> all;
  for (const GpuRow& row : rows_) {
    all.push_back(sort_row_json({.name = gpu_row_name(row.algorithm, what_),
                                 .algorithm = gpu_algorithms()[row.algorithm],
                                 .device = "gpu",
                                 .threads = 0,
                                 .stable = true,
                                 .packed = false,
                                 .iterations = 1,
                                 .total_ms = row.total_ms,
                                 .skipped = row.skipped,
                                 .wrong = row.wrong},
                                what_));
  }
  return all;
}

}  // namespace octocell::bench
