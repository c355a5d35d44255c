// SPDX-License-Identifier: MIT
#include "library/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/error.hpp"
#include "harness/engine/fast_backends.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/memory_guard.hpp"
#include "harness/engine/threads_for.hpp"

namespace octocell {

/// The library's way into a list.
struct PairsAccess {
  static Pairs make(Pair* first, std::size_t size) {
    Pairs pairs;
    pairs.first_ = first;
    pairs.size_ = size;
    return pairs;
  }
};

Pairs::~Pairs() { std::free(first_); }

}  // namespace octocell

namespace octocell::library {

const BackendInfo& backend_of(Device device) {
  return device == Device::cuda ? kImplCudaCustom : kImplCpu;
}

PlanOptions plan_options_of(const Options& options) {
  const BackendInfo& backend = backend_of(options.device);
  if (const auto reason = backend.why_unavailable()) {
    throw Error(fmt::format("{} cannot run here: {}", backend.name, *reason),
                ErrorKind::unavailable);
  }
  return {.method = std::nullopt,
          .threads = threads_for("threads =", options.threads),
          .known = backend.skips,
          .allowed = backend.skips,
          .costs = backend.costs};
}

Search::Search(const Options& options)
    : how(plan_options_of(options)),
      is_sorted_(options.sorted),
      finder_(backend_of(options.device).create()),
      clock_(finder_->make_clock(Marks::off)) {
  finder_->stop_when(options.stop);
}

void Search::run(SceneView scene) {
  has_answer_ = false;
  plan_.reset();
  plan_ = complete(*finder_, scene, plan_scene(scene, how), *clock_).plan;
  has_answer_ = true;
}

void Search::run_frame(SceneView scene) {
  if (!plan_ || plan_->facts.sphere_count != scene.spheres.size()) return run(scene);
  has_answer_ = false;
  const Plan plan = *std::exchange(plan_, std::nullopt);
  finder_->update(scene);
  finder_->find_pairs(*clock_);
  clock_->stop();
  const Counts counts = finder_->counts();
  if (counts.plan_violation || !fits(counts, plan.capacity, plan.count_only)) return run(scene);
  plan_ = plan;
  has_answer_ = true;
}

Search::Bounded Search::run_bounded(SceneView scene, std::uint64_t most_pairs) {
  has_answer_ = false;
  plan_.reset();
  Plan plan = plan_scene(scene, how);
  const HostBytes bytes = finder_->host_bytes(plan, scene);
  plan.capacity.pairs = plan.capacity.uncertain_pairs = most_pairs;
  plan = within_memory(plan, bytes);
  for (;;) {
    finder_->upload(plan, scene);
    finder_->find_pairs(*clock_);
    clock_->stop();
    Counts counts = finder_->counts();
    if (counts.plan_violation) throw LimitError(*counts.plan_violation);
    const Bounded run = {.found = std::max(counts.pairs, counts.uncertain_pairs),
                         .room = std::min(plan.capacity.pairs, plan.capacity.uncertain_pairs)};
    counts.pairs = counts.uncertain_pairs = 0;
    if (fits(counts, plan.capacity, plan.count_only)) {
      has_answer_ = run.found <= run.room;
      return run;
    }
    plan = grow_within_memory(plan, bytes, counts);
  }
}

std::span<const Pair> Search::pairs() {
  if (!has_answer_) return {};
  return is_sorted_ ? finder_->sorted_pairs() : finder_->pairs();
}

OwnedPairs Search::take() {
  if (pairs().empty()) return {};
  has_answer_ = false;
  return finder_->take_pairs();
}

Pairs handed_over(OwnedPairs pairs) {
  if (pairs.count == 0) return {};
  Pair* const all = pairs.items.release();
  // The list had room to spare. Giving that back moves nothing, unless the list is small.
  void* const cut = std::realloc(all, pairs.count * sizeof(Pair));
  return PairsAccess::make(cut != nullptr ? static_cast<Pair*>(cut) : all, pairs.count);
}

}  // namespace octocell::library
