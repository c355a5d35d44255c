// SPDX-License-Identifier: MIT
// What a hand-in is asked, scene by scene: for all pairs, or for the arrays of one stage.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "harness/try/child.hpp"
#include "harness/try/trial_scenes.hpp"
#include "harness/try/try.hpp"

namespace octocell::hand_in {

class Task {
 public:
  virtual ~Task() = default;
  [[nodiscard]] virtual std::vector<TrialScene> scenes(std::size_t seed) const = 0;
  /// Makes the scene, asks about it, and adds it to the trial. If it is wrong, says there what and
  /// why. Throws CannotJudge.
  virtual void try_scene(Child& child, const TrialScene& scene, std::chrono::duration<double> limit,
                         Trial& trial) = 0;
  /// A small scene may be too little to tell a cause: asks about larger ones. Throws CannotJudge.
  virtual void look_for_cause(Child& /*child*/, std::chrono::duration<double> /*limit*/,
                              Trial& /*trial*/) {}
};

std::unique_ptr<Task> make_pairs_task(std::size_t seed);
std::unique_ptr<Task> make_stage_task(Function stage);

/// More entries than any hand-in with a reasonable mistake gives.
constexpr std::uint64_t most_entries(std::size_t truth) { return 20 * truth + 2'000'000; }

Scene make_scene(const TrialScene& trial);

/// Writes the cause of a wrong answer into the trial, if one was found.
void note_cause(const judge::Judgement& judgement, const Scene& scene, Trial& trial);

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T>& items) {
  return std::as_bytes(std::span(items));
}
template <typename T>
std::vector<T> items_of(const Bytes& bytes) {
  std::vector<T> items(bytes.size() / sizeof(T));
  std::memcpy(items.data(), bytes.data(), items.size() * sizeof(T));
  return items;
}

}  // namespace octocell::hand_in
