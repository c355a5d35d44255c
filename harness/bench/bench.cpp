// SPDX-License-Identifier: MIT
#include "harness/bench/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <regex>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/bench/interrupts.hpp"
#include "harness/bench/machine.hpp"
#include "harness/bench/memory.hpp"
#include "harness/bench/progress.hpp"
#include "harness/bench/results.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::bench {
namespace {

constexpr int kExitWrongAnswer = 1;
constexpr int kExitInterrupted = 130;
constexpr const char* kExactPairs = "exact pairs";

/// Returns a guess of the seconds per sphere, until a row has been measured.
double guessed_seconds(const BackendInfo& backend) {
  if (backend.kind == Kind::baseline) return 1e-6;
  return backend.device ? 1e-8 : 5e-8;
}

std::regex compile_filter(const BenchOptions& options) {
  try {
    return std::regex(options.filter, std::regex::extended);
  } catch (const std::regex_error&) {
    throw InputError(fmt::format("filter '{}': not a regular expression", options.filter));
  }
}

/// A group and its rows, before any of them runs.
struct PlannedGroup {
  Group group;
  std::vector<RowSpec> rows;
};

/// Returns all groups that the options choose. Reports what is wrong with the options before any
/// file is touched.
std::vector<PlannedGroup> plan_groups(const BenchOptions& options) {
  const std::regex filter = compile_filter(options);
  std::vector<PlannedGroup> planned;
  for (const Group& group : choose_groups(options)) {
    PlannedGroup next = {group, rows_of(group, options.backend, filter)};
    if (!next.rows.empty()) planned.push_back(std::move(next));
  }
  if (planned.empty()) throw InputError(fmt::format("no row matches '{}'", options.filter));
  return planned;
}

/// A row while its group runs: its place in the whole bench, and its runner.
struct ActiveRow {
  std::size_t step;
  std::unique_ptr<RowRunner> runner;
};

/// Returns every frame with its exact pairs. Calls `goes_on` before each frame, which may end this
/// early.
Subject film(const Group& group, const std::function<bool(std::size_t)>& goes_on) {
  Footage footage = footage_of(group);
  Subject subject = {.spec = std::move(footage.spec),
                     .frames = std::move(footage.frames),
                     .flags = std::move(footage.flags),
                     .truth = {},
                     .digests = {}};
  for (const std::vector<Sphere>& spheres : subject.frames) {
    if (!goes_on(subject.digests.size())) return subject;
    std::vector<Pair> truth = reference::exact_pairs(spheres, subject.flags);
    subject.digests.push_back(digest_of(truth));
    if (subject.digests.size() == 1) subject.truth = std::move(truth);
  }
  if (footage.unrounded) {
    subject.rounding = reference::rounding_effect(*footage.unrounded, subject.flags, subject.truth);
  }
  return subject;
}

/// Returns true if a wrong row makes the bench fail. A negative control is kept because it is
/// wrong, and a library may lose pairs by a known issue.
bool is_failure(const RowRunner& runner) {
  const Implementation& how = runner.row().how;
  const bool excused = how.has_known_issues() && runner.result().difference.only_missed();
  return runner.result().wrong() && !how.negative_control() && !excused;
}

nlohmann::ordered_json class_of(const Group& group) {
  if (group.scene_class.empty()) return nullptr;
  return group.scene_class;
}

nlohmann::ordered_json describe_rounding(const std::optional<reference::RoundingEffect>& effect) {
  if (!effect) return nullptr;
  return {{"lost", effect->lost}, {"gained", effect->gained}};
}

nlohmann::ordered_json describe_group(const Group& group, const Subject& subject) {
  return {{"scene", group.scene},
          {"n", group.n},
          {"spec", subject.spec},
          {"real", group.real},
          {"unavailable", nullptr},
          {"frames", subject.frames.size()},
          {"scene_class", class_of(group)},
          {"input_rounding", describe_rounding(subject.rounding)},
          {"truth",
           {{"pairs", subject.digests.front().count},
            {"checksum", fmt::format("{:#018x}", subject.digests.front().checksum)}}}};
}

nlohmann::ordered_json describe_missing(const Group& group) {
  return {{"scene", group.scene},
          {"n", 0},
          {"spec", printable(group.argument)},
          {"real", group.real},
          {"unavailable", group.unavailable},
          {"frames", 0},
          {"scene_class", class_of(group)},
          {"input_rounding", nullptr},
          {"truth", nullptr}};
}

class Bench {
 public:
  explicit Bench(const BenchOptions& options)
      : options_(options),
        groups_(plan_groups(options)),
        results_(options.output, context()),
        progress_(steps()) {}

  int run() {
    require_inputs_kept(groups(), options_.output);
    results_.make_folder();
    results_.require_writable();
    listen_for_interrupts();
    for (const PlannedGroup& planned : groups_) {
      run_group(planned);
      if (interrupted()) break;
      results_.write();
    }
    return finish();
  }

 private:
  nlohmann::ordered_json context() const {
    nlohmann::ordered_json context = describe_build_and_machine();
    context["preset"] = options_.scenes.empty() ? options_.preset : "custom";
    context["rounds"] = groups_.back().group.rounds;
    context["min_time_ms"] = options_.min_time_ms;
    context["candidate_limit"] = candidate_limit(options_);
    context["gpu"] = uses_gpu() ? to_json(describe_gpu()) : nlohmann::ordered_json();
    return context;
  }

  [[nodiscard]] std::vector<Group> groups() const {
    std::vector<Group> groups;
    for (const PlannedGroup& planned : groups_) groups.push_back(planned.group);
    return groups;
  }

  [[nodiscard]] bool uses_gpu() const {
    if (why_no_gpu()) return false;
    return std::ranges::any_of(groups_, [](const PlannedGroup& planned) {
      return std::ranges::any_of(planned.rows,
                                 [](const RowSpec& row) { return row.how.backend->device; });
    });
  }

  std::vector<Progress::Step> steps() const {
    std::vector<Progress::Step> steps;
    for (const auto& [group, rows] : groups_) {
      const auto spheres = static_cast<double>(group.n);
      steps.push_back({kExactPairs, spheres, static_cast<double>(group.frames)});
      for (const RowSpec& row : rows) {
        steps.push_back({row.how.label(), spheres,
                         (2.0 + 2.0 * group.rounds_of(row.how.is_baseline())) * group.frames});
        steps.back().seconds_per_sphere = guessed_seconds(*row.how.backend);
      }
    }
    return steps;
  }

  void run_group(const PlannedGroup& planned) {
    const std::size_t film_step = next_step_;
    next_step_ += 1 + planned.rows.size();
    const Group& group = planned.group;
    if (!group.unavailable.empty()) {
      results_.add_group(describe_missing(group));
      progress_.note(fmt::format("{}: left out: {}", group.scene, group.unavailable));
      return;
    }
    const Subject subject = film_in_sight(group, film_step);
    if (interrupted()) return;
    std::vector<ActiveRow> rows;
    for (const RowSpec& row : planned.rows) {
      const std::size_t step = film_step + 1 + rows.size();
      rows.push_back({step, make_runner(row, subject, candidate_limit(options_))});
    }
    verify_rows(group, rows);
    measure_rounds(group, rows);
    if (interrupted()) return;  // only a complete group counts
    results_.add_group(describe_group(group, subject));
    for (ActiveRow& row : rows) {
      const RowRunner& runner = *row.runner;
      any_wrong_ = any_wrong_ || is_failure(runner);
      results_.add_row(group, runner.row(), runner.result());
    }
  }

  Subject film_in_sight(const Group& group, std::size_t step) {
    auto begin = std::chrono::steady_clock::now();
    const auto learn = [&](std::size_t frames) {
      progress_.learn(step, seconds_since(begin), static_cast<double>(frames) / group.frames);
      begin = std::chrono::steady_clock::now();
    };
    Subject subject = film(group, [&](std::size_t frame) {
      learn(frame);
      progress_.show(step, fmt::format("{} of {} n={}, frame {} of {}", kExactPairs, group.scene,
                                       group.n, frame + 1, group.frames));
      return !interrupted();
    });
    learn(subject.frames.size());
    return subject;
  }

  void verify_rows(const Group& group, std::vector<ActiveRow>& rows) {
    std::map<std::string, std::optional<std::uint64_t>> memory;  // for each implementation and
                                                                 // number of threads
    std::map<std::string, std::optional<std::string>> trials;    // how a baseline failed in its own
                                                                 // process
    for (auto& [step, owned] : rows) {
      RowRunner& runner = *owned;
      if (interrupted()) return;
      show(group, runner, step, "checking");
      const auto begin = std::chrono::steady_clock::now();
      const RowSpec& row = runner.row();
      const std::string key = fmt::format("{} {}", row.how.label(), row.threads);
      if (row.how.is_baseline() && !trials.contains(key)) {
        trials[key] = runner.try_apart(options_.baseline_limit);
      }
      if (trials[key]) {
        runner.skip(*trials[key]);
      } else {
        runner.verify(options_.min_time_ms);
      }
      const bool skipped = runner.result().skipped.has_value();
      // For a row on a GPU, the host's memory says little: most of it belongs to the driver.
      if (options_.memory && !skipped && !group.moves() && !row.how.backend->device) {
        if (!memory.contains(key)) memory[key] = peak_bytes(row, group);
        runner.result().peak_bytes = memory[key];
      }
      progress_.learn(step, seconds_since(begin), skipped ? 1.0 : 1.0 / (1.0 + group.rounds));
    }
  }

  /// Measures every row once in each round; the order differs from round to round.
  void measure_rounds(const Group& group, std::vector<ActiveRow>& rows) {
    std::vector<ActiveRow*> order;
    for (ActiveRow& row : rows) {
      if (!row.runner->result().skipped) order.push_back(&row);
    }
    std::mt19937 shuffler(1);
    for (int round = 0; round < group.rounds; ++round) {
      std::shuffle(order.begin(), order.end(), shuffler);
      for (ActiveRow* row : order) {
        if (interrupted()) return;
        if (!takes_part(round, group, *row->runner)) continue;
        show(group, *row->runner, row->step,
             fmt::format("round {} of {}", round + 1, group.rounds));
        const auto begin = std::chrono::steady_clock::now();
        measure(*row->runner, group);
        progress_.learn(row->step, seconds_since(begin), (2.0 + round) / (1.0 + group.rounds));
      }
    }
  }

  /// Returns true if a row takes part in a round. If it has fewer rounds than its group, they are
  /// spread evenly.
  static bool takes_part(int round, const Group& group, const RowRunner& runner) {
    const int own_rounds = group.rounds_of(runner.row().how.is_baseline());
    return round * own_rounds % group.rounds < own_rounds;
  }

  /// Measures a row, or marks it as skipped. It may run out of memory here although it fitted
  /// before: all rows share the GPU's memory.
  static void measure(RowRunner& runner, const Group& group) {
    if (runner.result().skipped) return;
    try {
      runner.measure(row_name(runner.row(), group));
    } catch (const LimitError& limit) {
      runner.skip(limit.what());
    }
  }

  int finish() {
    if (!interrupted()) results_.finish();
    results_.write();
    progress_.note(fmt::format("{}{}", interrupted() ? "interrupted; finished groups are in " : "",
                               printable(options_.output)));
    if (interrupted()) return kExitInterrupted;
    return any_wrong_ ? kExitWrongAnswer : 0;
  }

  void show(const Group& group, const RowRunner& runner, std::size_t step, std::string_view what) {
    progress_.show(step, fmt::format("{} {} n={} {}, {}", runner.row().how.label(), group.scene,
                                     group.n, bench::name_of(runner.row().run), what));
  }

  static double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  BenchOptions options_;
  std::vector<PlannedGroup> groups_;
  Results results_;
  Progress progress_;
  std::size_t next_step_ = 0;
  bool any_wrong_ = false;
};

int list_rows(const BenchOptions& options) {
  for (const auto& [group, rows] : plan_groups(options)) {
    for (const RowSpec& row : rows) fmt::print("{}\n", row_name(row, group));
  }
  return 0;
}

}  // namespace

int run_bench(const BenchOptions& options) {
  return options.list_only ? list_rows(options) : Bench(options).run();
}

}  // namespace octocell::bench
