// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/precision.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/try/task.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::hand_in {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t kMostForFloat64 = 6000;
constexpr std::size_t kMostTruePairs = 5'000'000;  // more are too many for a pipe

/// Whether a plain test in float64 finds the exact pairs. Where it does not, the catalogue asks for
/// more than a hand-in must know; `octocell stress --plugin` asks for that.
bool float64_is_enough(const Scene& scene, const std::vector<Pair>& truth) {
  const std::vector<Sphere>& spheres = scene.spheres;
  if (spheres.size() > kMostForFloat64) return false;
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) {
    for (std::uint32_t j = i + 1; j < spheres.size(); ++j) {
      if (pair_tests::within_f64(spheres[i], spheres[j])) pairs.push_back({i, j});
    }
  }
  return pairs == truth;
}

/// All pairs of a scene.
class PairsTask final : public Task {
 public:
  explicit PairsTask(std::size_t seed) : seed_(seed) {}

  [[nodiscard]] std::vector<TrialScene> scenes(std::size_t seed) const override {
    return trial_scenes(seed);
  }

  void try_scene(Child& child, const TrialScene& trial_scene, Seconds limit,
                 Trial& trial) override {
    if (trial_scene.stress != nullptr) return try_stress(child, *trial_scene.stress, limit, trial);
    const Scene scene = make_scene(trial_scene);
    try_one(child, scene, trial_scene.part, trial_scene.has_little_room, limit, trial);
  }

  void look_for_cause(Child& child, Seconds limit, Trial& trial) override {
    for (const std::string& spec : telling_scenes(seed_)) {
      const Scene scene = generate(spec);
      const std::vector<Pair> truth = reference::exact_pairs(scene);
      note_cause(judge::judge(ask(child, scene, false, truth.size(), limit), scene, truth), scene,
                 trial);
      if (trial.cause) return;
    }
  }

 private:
  /// The cases of an entry, except those with flags, which a hand-in does not know, and those that
  /// need more than float64.
  static void try_stress(Child& child, const stress::Entry& entry, Seconds limit, Trial& trial) {
    for (const stress::Case& one : entry.cases(entry.sizes.slice)) {
      if (!one.flags.empty() || one.bad_sphere) continue;
      Scene scene;
      scene.name = scene.spec = fmt::format("stress {}: {}", entry.id, one.name);
      scene.spheres = one.spheres;
      try_one(child, scene, Part::stress, false, limit, trial);
      if (trial.is_wrong()) return;
    }
  }

  static void try_one(Child& child, const Scene& scene, Part part, bool has_little_room,
                      Seconds limit, Trial& trial) {
    trial.at = scene.spec;
    const std::vector<Pair> truth = reference::exact_pairs(scene);
    if (truth.size() > kMostTruePairs) return;
    if (part == Part::stress && !float64_is_enough(scene, truth)) return;
    const auto asked = Clock::now();
    const auto pairs = ask(child, scene, has_little_room, truth.size(), limit);
    const Seconds taken = Clock::now() - asked;
    judge::Judgement judgement = judge::judge(pairs, scene, truth);
    trial.scenes.push_back({scene.spec, scene.spheres.size(), truth.size(), judgement.exact(),
                            1e3 * taken.count(), part});
    if (judgement.exact()) return;
    note_cause(judgement, scene, trial);
    trial.wrong = std::move(judgement);
    trial.wrong_spheres = scene.spheres;
  }

  static std::vector<ListedPair> ask(Child& child, const Scene& scene, bool has_little_room,
                                     std::size_t true_pairs, Seconds limit) {
    const std::uint64_t capacity = has_little_room ? 100 : 16 * scene.spheres.size() + 16;
    const std::uint64_t most = most_entries(true_pairs);
    const Outputs found = child.ask({.capacity = capacity, .most = most}, {bytes_of(scene.spheres)},
                                    most * sizeof(ListedPair), limit);
    return items_of<ListedPair>(found[0]);
  }

  std::size_t seed_;
};

}  // namespace

Scene make_scene(const TrialScene& trial) {
  if (!trial.spec.empty()) return generate(trial.spec);
  Scene scene;
  scene.name = scene.spec = "no spheres";
  return scene;
}

std::unique_ptr<Task> make_pairs_task(std::size_t seed) {
  return std::make_unique<PairsTask>(seed);
}

}  // namespace octocell::hand_in
