// SPDX-License-Identifier: MIT
#include "harness/bench/sort/sort_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "harness/bench/google_time.hpp"
#include "harness/engine/median.hpp"

namespace octocell::bench {
namespace {

constexpr double kMaxIterations = 1000.0;

}  // namespace

std::vector<SortRow> sort_rows(int threads) {
  std::vector<SortRow> rows;
  for (const Algorithm& how : sort_algorithms()) {
    rows.push_back({&how, 1});
    if (how.parallel && threads > 1) rows.push_back({&how, threads});
  }
  return rows;
}

std::string row_name(const SortRow& row, const SortCase& what) {
  return fmt::format("sort/algorithm:{}/n:{}/bits:{}/order:{}/threads:{}", row.how->name, what.n,
                     what.bits, name_of(what.order), row.threads);
}

SortSubject::SortSubject(const SortCase& c) : what(c), keys(make_keys(c)), values(c.n), work(c.n) {
  std::iota(values.begin(), values.end(), 0u);
  truth = {keys.size(), pairs_checksum(keys, values)};
}

SortRunner::SortRunner(const SortRow& row, SortSubject& subject, std::optional<std::string> skipped)
    : row_(row), subject_(subject), skipped_(std::move(skipped)) {}

double SortRunner::sort_ms() {
  Workspace& work = subject_.work;
  work.front.keys = subject_.keys;  // same size: this copies and allocates nothing
  work.front.values = subject_.values;
  const auto begin = std::chrono::steady_clock::now();
  const PairArrays& sorted = sorter_->sort(work, subject_.what.bits);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  if (!wrong_) {
    wrong_ = fault_of(sorted.keys, sorted.values, subject_.truth, row_.how->stable);
  }
  return taken.count();
}

void SortRunner::verify(double min_time_ms) {
  sorter_ = row_.how->create(row_.threads);
  iterations_ = static_cast<std::uint64_t>(
      std::clamp(std::ceil(min_time_ms / std::max(sort_ms(), 1e-3)), 1.0, kMaxIterations));
}

void SortRunner::measure() {
  total_ms_.push_back(
      average_ms(row_name(row_, subject_.what), iterations_, [this] { return sort_ms(); }));
  if (wrong_) total_ms_.clear();  // a wrong answer has no time
}

nlohmann::ordered_json SortRunner::json() const {
  return sort_row_json({.name = row_name(row_, subject_.what),
                        .algorithm = row_.how->name,
                        .device = "cpu",
                        .threads = row_.threads,
                        .stable = row_.how->stable,
                        .packed = row_.how->packed,
                        .iterations = iterations_,
                        .total_ms = total_ms_,
                        .skipped = skipped_,
                        .wrong = wrong_},
                       subject_.what);
}

nlohmann::ordered_json sort_row_json(const SortReport& row, const SortCase& what) {
  using Json = nlohmann::ordered_json;
  Json rate;
  if (!row.total_ms.empty()) rate = what.n / (median(row.total_ms) / 1e3);
  return {{"name", row.name},
          {"algorithm", row.algorithm},
          {"device", row.device},
          {"n", what.n},
          {"bits", what.bits},
          {"order", name_of(what.order)},
          {"threads", row.threads},
          {"stable", row.stable},
          {"packed", row.packed},
          {"status", row.skipped ? "skipped"
                     : row.wrong ? "wrong"
                                 : "ok"},
          {"reason", row.skipped ? Json(*row.skipped)
                     : row.wrong ? Json(*row.wrong)
                                 : Json()},
          {"iterations", row.iterations},
          {"total_ms", row.total_ms},
          {"items_per_second_median", rate}};
}

}  // namespace octocell::bench
