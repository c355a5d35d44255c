// SPDX-License-Identifier: MIT
#include "harness/try/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "harness/engine/find_completely.hpp"
#include "harness/engine/median.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/try/board.hpp"
#include "harness/try/child.hpp"
#include "harness/try/compile.hpp"
#include "harness/try/task.hpp"
#include "harness/try/try.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::hand_in {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t kMostSpheres = 100'000;
constexpr std::size_t kMostPairs = 8'000'000;
constexpr std::size_t kMostForBruteForce = 10'000;
constexpr std::size_t kLeastIterations = 3;
constexpr std::size_t kMostIterations = 11;
constexpr const char* kKinds[] = {"gas", "poly"};
constexpr std::size_t kSizes[] = {1'000, 10'000, 100'000};

/// Someone whose time stands in the table.
class Contestant {
 public:
  explicit Contestant(std::string name) : name_(std::move(name)) {}
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;
  virtual ~Contestant() = default;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] virtual bool takes(std::size_t /*spheres*/) const { return true; }
  /// Finds the pairs. Returns milliseconds from spheres in memory to pairs in memory. If the answer
  /// is wrong, the trial says so. Throws CannotJudge; LimitError for a row of ours that cannot
  /// find them, or finds others.
  virtual double time(const Scene& scene, const std::vector<Pair>& truth, Trial& trial) = 0;

 private:
  std::string name_;
};

class HandIn final : public Contestant {
 public:
  HandIn(const Program& program, const Options& options)
      : Contestant("mine"),
        board_(kMostSpheres, kMostPairs),
        timeout_(options.timeout_s),
        child_(program, limits_of(options), &board_) {}

  double time(const Scene& scene, const std::vector<Pair>& truth, Trial& trial) override {
    trial.at = scene.spec;
    const std::uint64_t capacity = 2 * truth.size() + 1000;
    const Question question = {
        .capacity = capacity, .is_timed = 1, .timed_spheres = scene.spheres.size()};
    const Seconds taken = child_.time(
        question, [&] { board_.set(scene.spheres, capacity); }, Seconds(timeout_));
    // It is stopped now, and nothing of it can write.
    const std::uint64_t count = board_.count();
    if (!board_.red_zones_are_whole())
      throw CannotJudge("fails",
                        fmt::format("it wrote around pairs, which has room for {}", capacity));
    if (!board_.holds(scene.spheres)) throw CannotJudge("fails", "it changed the spheres");
    if (count > capacity) {
      throw CannotJudge("fails", fmt::format("it counts {} pairs; there is room for {}, and there "
                                             "are {}",
                                             count, capacity, truth.size()));
    }
    judge(scene, truth, count, trial);
    return 1e3 * taken.count();
  }

 private:
  void judge(const Scene& scene, const std::vector<Pair>& truth, std::uint64_t count,
             Trial& trial) const {
    std::vector<ListedPair> pairs;
    for (const octocell_pair p : board_.first(count)) pairs.push_back({p.i, p.j});
    judge::Judgement judgement = judge::judge(pairs, scene, truth);
    if (judgement.exact()) return;
    note_cause(judgement, scene, trial);
    trial.wrong = std::move(judgement);
  }

  Board board_;
  double timeout_;
  Child child_;
};

/// A row of the registry: planned, uploaded and run within the time, as the hand-in has only the
/// spheres.
class Builtin final : public Contestant {
 public:
  explicit Builtin(const Implementation& how)
      : Contestant(how.is_baseline() ? std::string(how.backend->name)
                                     : fmt::format("{} {}", how.backend->name, how.method_name())),
        how_(how),
        finder_(how.backend->create()) {}

  [[nodiscard]] bool takes(std::size_t spheres) const override {
    return how_.method != Method::brute_force || spheres <= kMostForBruteForce;
  }

  double time(const Scene& scene, const std::vector<Pair>& truth, Trial&) override {
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const auto begin = Clock::now();
    find_completely(*finder_, scene.view(), how_.plan_options(threads));
    const Seconds taken = Clock::now() - begin;
    const reference::Comparison found = reference::compare(finder_->sorted_pairs(), truth);
    if (!found.exact()) {
      throw LimitError(fmt::format("wrong: missed {}, false {}, duplicates {}", found.missed,
                                   found.false_pairs, found.duplicates));
    }
    return 1e3 * taken.count();
  }

 private:
  Implementation how_;
  std::unique_ptr<PairFinder> finder_;
};

std::vector<std::unique_ptr<Contestant>> contestants(const Program& program,
                                                     const Options& options) {
  std::vector<std::unique_ptr<Contestant>> all;
  all.push_back(std::make_unique<HandIn>(program, options));
  const auto add = [&](const Implementation& how) {
    if (!how.backend->why_unavailable()) all.push_back(std::make_unique<Builtin>(how));
  };
  for (const BackendInfo& backend : backends()) {
    const bool is_ours = backend.name == "impl_cpu";
    for (const Method method : {Method::brute_force, Method::home_phantom, Method::half_shell}) {
      if (is_ours) add({.backend = &backend, .method = method});
    }
    if (backend.kind == Kind::backend && backend.device) add({.backend = &backend});
    if (backend.name == "fcl_dynamic_aabb_tree" || backend.name == "bullet_dbvt")
      add({.backend = &backend});
  }
  return all;
}

class Bench {
 public:
  Bench(const Program& program, const Options& options, Trial& trial)
      : options_(options), trial_(trial), all_(contestants(program, options)) {}

  std::vector<TimedScene> run() {
    for (const std::size_t n : kSizes) {
      for (const char* kind : kKinds) {
        if (trial_.is_wrong()) return std::move(scenes_);
        time_scene(kind, n);
      }
    }
    return std::move(scenes_);
  }

 private:
  void time_scene(const char* kind, std::size_t n) {
    TimedScene timed = {kind, n, {}};
    for (const auto& contestant : all_) {
      timed.rows.push_back({contestant->name()});
      TimedRow& row = timed.rows.back();
      if (!contestant->takes(n)) row.ended = "not at this size";
      if (row.ended.empty() && is_too_slow(row.name, kind)) row.ended = "too slow for the budget";
    }
    // Each of the six scenes has the same part of the budget.
    const auto enough = Clock::now() + Seconds(options_.budget_s / 6);
    for (std::size_t k = 0; k < kMostIterations && !trial_.is_wrong(); ++k) {
      if (k >= kLeastIterations && Clock::now() > enough) break;
      const Scene scene = generate(fmt::format("{}:n={},seed={}", kind, n, ++seed_));
      const std::vector<Pair> truth = reference::exact_pairs(scene);
      for (std::size_t c = 0; c < all_.size() && !trial_.is_wrong(); ++c)
        time_one((c + k) % all_.size(), scene, truth, timed);
    }
    scenes_.push_back(std::move(timed));
  }

  /// By its times for the smaller scenes of this kind.
  [[nodiscard]] bool is_too_slow(const std::string& name, std::string_view kind) const {
    double before = 0.0;
    double last = 0.0;
    for (const TimedScene& scene : scenes_) {
      for (const TimedRow& row : scene.rows) {
        if (scene.kind != kind || row.name != name) continue;
        if (!row.ended.empty()) return true;
        before = std::exchange(last, median(row.milliseconds));
      }
    }
    const double growth = before > 0.0 ? std::max(10.0, last / before) : 10.0;
    return kLeastIterations * growth * last > 1e3 * options_.budget_s / 2;
  }

  void time_one(std::size_t which, const Scene& scene, const std::vector<Pair>& truth,
                TimedScene& timed) {
    TimedRow& row = timed.rows[which];
    if (!row.ended.empty()) return;
    try {
      row.milliseconds.push_back(all_[which]->time(scene, truth, trial_));
    } catch (const LimitError& limit) {
      row.ended = limit.what();
    }
  }

  const Options& options_;
  Trial& trial_;
  std::vector<std::unique_ptr<Contestant>> all_;
  std::vector<TimedScene> scenes_ = {};
  std::size_t seed_ = 1'000'000 + 1000 * options_.seed;  // not those of `try`
};

}  // namespace

std::vector<TimedScene> bench(const Program& program, const Options& options, Trial& trial) {
  return Bench(program, options, trial).run();
}

}  // namespace octocell::hand_in
