// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "harness/try/task.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::hand_in {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// All pairs of a scene.
class PairsTask final : public Task {
 public:
  explicit PairsTask(std::size_t seed) : seed_(seed) {}

  [[nodiscard]] std::vector<TrialScene> scenes(std::size_t seed) const override {
    return trial_scenes(seed);
  }

  void try_scene(Child& child, const TrialScene& trial_scene, Seconds limit,
                 Trial& trial) override {
    const Scene scene = make_scene(trial_scene);
    trial.at = scene.spec;
    const std::vector<Pair> truth = reference::exact_pairs(scene);
    const auto asked = Clock::now();
    const auto pairs = ask(child, scene, trial_scene.has_little_room, truth.size(), limit);
    const Seconds taken = Clock::now() - asked;
    judge::Judgement judgement = judge::judge(pairs, scene, truth);
    trial.scenes.push_back(
        {scene.spec, scene.spheres.size(), truth.size(), judgement.exact(), 1e3 * taken.count()});
    if (judgement.exact()) return;
    note_cause(judgement, scene, trial);
    trial.wrong = std::move(judgement);
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
  static std::vector<ListedPair> ask(Child& child, const Scene& scene, bool has_little_room,
                                     std::size_t true_pairs, Seconds limit) {
    const std::uint64_t capacity = has_little_room ? 100 : 16 * scene.spheres.size() + 16;
    const std::uint64_t most = most_entries(true_pairs);
    const Outputs found =
        child.ask({.capacity = capacity, .most = most, .key_bits = 0, .bytes = {}},
                  {bytes_of(scene.spheres)}, most * sizeof(ListedPair), limit);
    return items_of<ListedPair>(found[0]);
  }

  static void note_cause(const judge::Judgement& judgement, const Scene& scene, Trial& trial) {
    if (judgement.causes.empty()) return;
    trial.cause = judgement.causes.front();
    trial.cause_at = scene.spec;
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
