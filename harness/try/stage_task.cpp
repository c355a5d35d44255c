// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/try/judge_stage.hpp"
#include "harness/try/task.hpp"
#include "harness/verify/reference/reference.hpp"

namespace octocell::hand_in {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// The arrays of one stage; those before it are ours.
class StageTask final : public Task {
 public:
  explicit StageTask(Function stage) : stage_(stage) {}

  [[nodiscard]] std::vector<TrialScene> scenes(std::size_t seed) const override {
    std::vector<TrialScene> scenes;
    if (stage_ == Function::sort) scenes = random_key_scenes(seed);
    for (TrialScene& scene : trial_scenes(seed)) {
      if (scene.part != Part::stress) scenes.push_back(std::move(scene));
    }
    return scenes;
  }

  void try_scene(Child& child, const TrialScene& trial_scene, Seconds limit,
                 Trial& trial) override {
    part_ = trial_scene.part;
    if (const auto& keys = trial_scene.keys) {
      trial.at = trial_scene.spec;
      const StageArrays arrays = random_keys(keys->count, keys->bits, keys->seed);
      return try_sort(child, arrays, limit, trial);
    }
    const Scene scene = make_scene(trial_scene);
    trial.at = scene.spec;
    const std::optional<StageArrays> arrays = arrays_of(scene);
    if (!arrays) return;
    if (stage_ == Function::sort) return try_sort(child, *arrays, limit, trial);
    const std::uint64_t room = trial_scene.has_little_room ? 100 : 8 * scene.spheres.size() + 16;
    if (stage_ == Function::cell_ids)
      return try_cell_ids(child, scene, *arrays, room, limit, trial);
    if (stage_ == Function::cell_index) return try_cell_index(child, *arrays, room, limit, trial);
    try_pair_tests(child, scene, *arrays, room, limit, trial);
  }

 private:
  void try_sort(Child& child, const StageArrays& arrays, Seconds limit, Trial& trial) {
    const Entries& entries = arrays.unsorted;
    Question question = with_room(0, entries.size());
    question.key_bits = arrays.key_bits;
    const Outputs found = ask(child, question, {bytes_of(entries.ids), bytes_of(entries.objects)},
                              limit, entries.size());
    note(judge_sort(entries_of(found), arrays), entries.size(), entries.size(), trial);
  }

  void try_cell_ids(Child& child, const Scene& scene, const StageArrays& arrays, std::uint64_t room,
                    Seconds limit, Trial& trial) {
    const std::vector<octocell_grid> grid = {arrays.grid};
    const std::size_t truth = arrays.unsorted.size();
    const Outputs found =
        ask(child, with_room(room, truth), {bytes_of(scene.spheres), bytes_of(grid)}, limit, truth);
    note(judge_cell_ids(entries_of(found), scene, arrays), scene.spheres.size(), truth, trial);
  }

  void try_cell_index(Child& child, const StageArrays& arrays, std::uint64_t room, Seconds limit,
                      Trial& trial) {
    const Entries& sorted = arrays.sorted;
    const std::size_t truth = arrays.cells.size();
    const Outputs found = ask(child, with_room(room, truth),
                              {bytes_of(sorted.ids), bytes_of(sorted.objects)}, limit, truth);
    note(judge_cell_index(items_of<octocell_cell>(found[0]), arrays), sorted.size(), truth, trial);
  }

  /// The pairs of this stage are those of the scene.
  void try_pair_tests(Child& child, const Scene& scene, const StageArrays& arrays,
                      std::uint64_t room, Seconds limit, Trial& trial) {
    const Entries& sorted = arrays.sorted;
    const std::vector<Pair> truth = reference::exact_pairs(scene);
    const Outputs found = ask(child, with_room(room, truth.size()),
                              {bytes_of(scene.spheres), bytes_of(sorted.ids),
                               bytes_of(sorted.objects), bytes_of(arrays.cells)},
                              limit, truth.size());
    judge::Judgement judgement = judge::judge(items_of<ListedPair>(found[0]), scene, truth);
    trial.scenes.push_back(
        {trial.at, sorted.size(), truth.size(), judgement.exact(), taken_ms_, part_});
    if (judgement.exact()) return;
    if (!judgement.causes.empty()) note_cause(judgement.causes.front(), trial);
    trial.wrong = std::move(judgement);
  }

  Outputs ask(Child& child, const Question& question, const Inputs& inputs, Seconds limit,
              std::size_t truth) {
    const auto asked = Clock::now();
    Outputs found = child.ask(question, inputs, most_entries(truth) * sizeof(ListedPair), limit);
    taken_ms_ = 1e3 * Seconds(Clock::now() - asked).count();
    return found;
  }

  void note(StageJudgement judgement, std::size_t n, std::size_t found, Trial& trial) const {
    trial.scenes.push_back({trial.at, n, found, !judgement.first, taken_ms_, part_});
    trial.wrong_entry = std::move(judgement.first);
    if (judgement.cause) note_cause(*judgement.cause, trial);
  }

  static void note_cause(const judge::Cause& cause, Trial& trial) {
    trial.cause = cause;
    trial.cause_at = trial.at;
  }

  static Question with_room(std::uint64_t capacity, std::size_t truth) {
    return {.capacity = capacity, .most = most_entries(truth)};
  }

  static Entries entries_of(const Outputs& found) {
    return {items_of<std::uint32_t>(found[0]), items_of<std::uint32_t>(found[1])};
  }

  Function stage_;
  double taken_ms_ = 0.0;
  Part part_ = Part::small;
};

}  // namespace

std::string object_text(std::uint32_t object) {
  std::string lowest = "---";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((object & OCTOCELL_LOWEST_X << axis) != 0) lowest[axis] = "xyz"[axis];
  }
  const char kind = (object & OCTOCELL_PHANTOM) != 0 ? 'P' : 'H';
  return fmt::format("{}{} {} ({:08x})", object & OCTOCELL_SPHERE, kind, lowest, object);
}

judge::Cause list_cause(std::string name, std::string text) {
  judge::Cause cause;
  cause.kind = "arrays";
  cause.name = std::move(name);
  cause.text = std::move(text);
  return cause;
}

std::unique_ptr<Task> make_stage_task(Function stage) { return std::make_unique<StageTask>(stage); }

}  // namespace octocell::hand_in
