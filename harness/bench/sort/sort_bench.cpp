// SPDX-License-Identifier: MIT
#include "harness/bench/sort/sort_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "harness/bench/gpu.hpp"
#include "harness/bench/interrupts.hpp"
#include "harness/bench/machine.hpp"
#include "harness/bench/progress.hpp"
#include "harness/bench/result_file.hpp"
#include "harness/bench/sort/gpu_rows.hpp"
#include "harness/bench/sort/sort_rows.hpp"

namespace octocell::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 2;
constexpr int kGpuRounds = 21;
constexpr int kExitWrongAnswer = 1;
constexpr int kExitInterrupted = 130;
constexpr double kMinTimeMs = 3.0;  // a measurement repeats short sorts for at least this long

// Progress counts in spheres; sorting a pair costs much less than finding the pairs of a sphere.
constexpr double kSpheresPerPair = 0.05;

/// A case and its rows, before any of them runs.
struct PlannedCase {
  SortCase what;
  std::vector<SortRow> rows;
};

/// The same for the GPU, with indices into gpu_algorithms().
struct PlannedGpuCase {
  SortCase what;
  std::vector<std::size_t> algorithms;
};

std::regex filter_of(const SortBenchOptions& options) {
  try {
    return std::regex(options.filter, std::regex::extended);
  } catch (const std::regex_error&) {
    throw InputError(fmt::format("filter '{}': not a regular expression", options.filter));
  }
}

std::vector<PlannedCase> plan_cases(const SortBenchOptions& options) {
  std::vector<PlannedCase> planned;
  if (options.device == "gpu") return planned;
  const std::regex filter = filter_of(options);
  for (const SortCase& what : sort_cases(options.preset)) {
    PlannedCase next = {what, sort_rows(options.threads)};
    std::erase_if(next.rows, [&](const SortRow& row) {
      return !std::regex_search(row_name(row, what), filter);
    });
    if (!next.rows.empty()) planned.push_back(std::move(next));
  }
  return planned;
}

std::vector<PlannedGpuCase> plan_gpu_cases(const SortBenchOptions& options) {
  std::vector<PlannedGpuCase> planned;
  if (options.device == "cpu") return planned;
  if (const auto reason = why_no_gpu()) {
    if (options.device == "gpu") throw LimitError(fmt::format("--device gpu: {}", *reason));
    return planned;
  }
  const std::regex filter = filter_of(options);
  for (const SortCase& what : gpu_sort_cases(options.preset)) {
    PlannedGpuCase next = {what, {}};
    for (std::size_t a = 0; a < gpu_algorithms().size(); ++a) {
      if (std::regex_search(gpu_row_name(a, what), filter)) next.algorithms.push_back(a);
    }
    if (!next.algorithms.empty()) planned.push_back(std::move(next));
  }
  return planned;
}

/// Reports what is wrong with the options before any file is touched.
void require_sound(const SortBenchOptions& options) {
  for (const std::string_view known : {"cpu", "gpu", "all"}) {
    if (options.device == known) return;
  }
  throw InputError(fmt::format("unknown device '{}'; known: cpu, gpu, all", options.device));
}

/// For the input, two pairs of arrays, one packed array, and the memory of std::stable_sort.
constexpr double kBytesPerPair = 40.0;

/// Throws LimitError before the work starts. Otherwise the kernel might kill the program in the
/// middle.
void require_memory(const std::vector<PlannedCase>& cases) {
  if (cases.empty()) return;
  const double n = cases.back().what.n;  // the largest comes last
  octocell::require_memory(kBytesPerPair * n,
                           fmt::format("n={} (--filter chooses smaller cases)", n));
}

std::optional<std::string> why_skipped(const SortRow& row, const SortCase& what) {
  if (row.how->create == nullptr) return std::string(row.how->why_missing);
  if (row.how->slow && !what.slow_rows)
    return "a comparison sort would take too long at this size; --preset full runs it";
  return std::nullopt;
}

/// A row while its case runs: its place in the whole bench, and its runner.
struct ActiveRow {
  std::size_t step;
  SortRunner runner;
};

class SortBench {
 public:
  explicit SortBench(const SortBenchOptions& options)
      : options_(options),
        rounds_(options.rounds.value_or(options.preset == "full" ? 5 : 3)),
        cases_((require_sound(options), plan_cases(options))),
        gpu_cases_(plan_gpu_cases(options)),
        file_(options.output),
        document_({{"schema", kSchema},
                   {"kind", "sort"},
                   {"context", context()},
                   {"rows", Json::array()}}),
        progress_(steps()) {
    if (cases_.empty() && gpu_cases_.empty()) {
      throw InputError(fmt::format("no row matches '{}'", options.filter));
    }
  }

  int run() {
    require_memory(cases_);
    file_.make_folder();
    file_.require_writable();
    listen_for_interrupts();
    for (const PlannedCase& planned : cases_) {
      run_case(planned);
      if (interrupted()) break;
      file_.write(document_);
    }
    run_gpu_cases();
    return finish();
  }

 private:
  [[nodiscard]] Json context() const {
    Json context = describe_build_and_machine();
    context["libraries"] = Json::object();
    for (const auto& [name, version] : sort_libraries()) {
      context["libraries"][std::string(name)] = version ? Json(*version) : Json();
    }
    describe_device(context);
    context["preset"] = options_.preset;
    context["device"] = options_.device;
    context["filter"] = options_.filter;
    context["rounds"] = rounds_;
    context["gpu_rounds"] = gpu_rounds();
    context["min_time_ms"] = kMinTimeMs;
    context["finished"] = false;
    return context;
  }

  /// "gpu" is null if no row runs on one; "gpu_reason" says why, unless the caller excluded it.
  void describe_device(Json& context) const {
    context["gpu"] = Json();
    context["gpu_reason"] = Json();
    if (!gpu_cases_.empty()) {
      context["gpu"] = to_json(describe_gpu());
      context["libraries"]["cub"] = cub_version();
    } else if (const auto reason = why_no_gpu(); reason && options_.device == "all") {
      context["gpu_reason"] = *reason;
    }
  }

  [[nodiscard]] int gpu_rounds() const { return options_.rounds.value_or(kGpuRounds); }

  [[nodiscard]] std::vector<Progress::Step> steps() const {
    std::vector<Progress::Step> steps;
    for (const auto& [what, rows] : cases_) {
      for (const SortRow& row : rows) {
        // Short sorts are repeated, so the time does not shrink with their size.
        const double pairs = why_skipped(row, what) ? 0.0 : std::max(what.n, 1u << 17);
        steps.push_back({label(row), pairs * kSpheresPerPair, 1.0 + rounds_});
      }
    }
    for (const PlannedGpuCase& planned : gpu_cases_) {
      steps.push_back({"gpu", planned.what.n * kSpheresPerPair, 1.0});
    }
    return steps;
  }

  static std::string label(const SortRow& row) {
    return fmt::format("{} threads={}", row.how->name, row.threads);
  }

  void run_case(const PlannedCase& planned) {
    SortSubject subject(planned.what);
    std::vector<ActiveRow> rows;
    for (const SortRow& row : planned.rows) {
      rows.push_back({next_step_++, SortRunner(row, subject, why_skipped(row, planned.what))});
    }
    for (ActiveRow& row : rows) {
      if (!row.runner.runs()) continue;
      step(planned.what, row, "checking", 1.0, [&] { row.runner.verify(kMinTimeMs); });
    }
    measure_rounds(planned.what, rows);
    if (interrupted()) return;  // only a complete case counts
    for (const ActiveRow& row : rows) {
      any_wrong_ = any_wrong_ || row.runner.wrong();
      document_["rows"].push_back(row.runner.json());
    }
  }

  /// Runs after the other cases, so that the GPU's threads and copies disturb none of them.
  void run_gpu_cases() {
    const Json& reason = document_["context"]["gpu_reason"];
    if (!reason.is_null()) {
      progress_.note(fmt::format("no rows on a GPU: {}", reason.get<std::string>()));
    }
    for (const PlannedGpuCase& planned : gpu_cases_) {
      if (interrupted()) return;
      const SortCase& what = planned.what;
      progress_.show(next_step_,
                     fmt::format("gpu n={} bits={} {}", what.n, what.bits, name_of(what.order)));
      const auto begin = std::chrono::steady_clock::now();
      run_gpu_case(planned);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      progress_.learn(next_step_++, taken.count(), 1.0);
    }
  }

  void run_gpu_case(const PlannedGpuCase& planned) {
    GpuRows rows(planned.what, planned.algorithms);
    rows.verify();
    for (int round = 0; round < gpu_rounds() && !interrupted(); ++round) rows.measure(round);
    if (interrupted()) return;  // only a complete case counts
    any_wrong_ = any_wrong_ || rows.any_wrong();
    for (Json& row : rows.json()) document_["rows"].push_back(std::move(row));
    file_.write(document_);
  }

  /// Measures every row once in each round; the order differs from round to round.
  void measure_rounds(const SortCase& what, std::vector<ActiveRow>& rows) {
    std::vector<ActiveRow*> order;
    for (ActiveRow& row : rows) order.push_back(&row);
    std::mt19937 shuffler(1);
    for (int round = 0; round < rounds_; ++round) {
      std::shuffle(order.begin(), order.end(), shuffler);
      const std::string title = fmt::format("round {} of {}", round + 1, rounds_);
      for (ActiveRow* row : order) {
        if (!row->runner.runs()) continue;
        step(what, *row, title, 2.0 + round, [&] { row->runner.measure(); });
      }
    }
  }

  /// Runs one piece of work, with progress before and after, unless Ctrl-C came.
  template <typename Work>
  void step(const SortCase& what, const ActiveRow& row, std::string_view title, double passes,
            const Work& work) {
    if (interrupted()) return;
    progress_.show(row.step, fmt::format("{} n={} bits={} {}, {}", label(row.runner.row()), what.n,
                                         what.bits, name_of(what.order), title));
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    progress_.learn(row.step, taken.count(), passes / (1.0 + rounds_));
  }

  int finish() {
    document_["context"]["finished"] = !interrupted();
    file_.write(document_);
    progress_.note(fmt::format("{}{}", interrupted() ? "interrupted; finished cases are in " : "",
                               options_.output));
    if (interrupted()) return kExitInterrupted;
    return any_wrong_ ? kExitWrongAnswer : 0;
  }

  SortBenchOptions options_;
  int rounds_;
  std::vector<PlannedCase> cases_;
  std::vector<PlannedGpuCase> gpu_cases_;
  ResultFile file_;
  Json document_;
  Progress progress_;
  std::size_t next_step_ = 0;
  bool any_wrong_ = false;
};

}  // namespace

int run_sort_bench(const SortBenchOptions& options) { return SortBench(options).run(); }

}  // namespace octocell::bench
