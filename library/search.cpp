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
  static Pairs make(Pair* first, Shift* shifts, std::size_t size) {
    Pairs pairs;
    pairs.first_ = first;
    pairs.shifts_ = shifts;
    pairs.size_ = size;
    return pairs;
  }
};

Pairs::~Pairs() {
  std::free(first_);
  std::free(shifts_);
}

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

images::Question question_of(SceneView scene, const std::optional<Box>& box, double cutoff) {
  images::Question question = {.scene = scene, .gap = cutoff};
  if (box) question.box = *box;
  return question;
}

Search::Search(const Options& options)
    : how(plan_options_of(options)),
      batch(options.batch),
      is_sorted_(options.sorted),
      box_(options.box),
      cutoff_(options.cutoff),
      finder_(backend_of(options.device).create()),
      clock_(finder_->make_clock(Marks::off)) {
  finder_->stop_when(options.stop);
}

void Search::run(SceneView scene) {
  has_answer_ = false;
  plan_.reset();
  if (has_images()) {
    images::Question question = question_of(scene, box_, cutoff_);
    question.batch = batch;
    run_images(question);
  } else {
    run_open(scene, how);
    answer_is_of_images_ = false;
  }
  has_answer_ = true;
}

void Search::run_between(std::span<const Sphere> spheres, std::span<const Sphere> others) {
  has_answer_ = false;
  plan_.reset();
  both_.assign(spheres.begin(), spheres.end());
  both_.insert(both_.end(), others.begin(), others.end());
  images::Question question = question_of({both_}, box_, cutoff_);
  question.second_from = spheres.size();
  question.batch = batch;
  run_images(question);
  has_answer_ = true;
}

void Search::run_open(SceneView scene, const PlanOptions& options) {
  plan_ = complete(*finder_, scene, plan_scene(scene, options), *clock_).plan;
}

void Search::run_images(const images::Question& question) {
  if (!images_) images_.emplace(how.threads);
  answer_is_of_images_ = true;
  PlanOptions open = how;  // finds candidates, of a scene that is new each time
  open.count_only = open.moving = false;
  image_pairs_ = {};
  image_pairs_ = images_->find(question, {.sorted = is_sorted_, .count_only = how.count_only},
                               [&](SceneView enclosing) {
                                 run_open(enclosing, open);
                                 return finder_->take_pairs();
                               });
  plan_.reset();
}

void Search::run_frame(SceneView scene) {
  if (has_images() || !plan_ || plan_->facts.sphere_count != scene.spheres.size())
    return run(scene);
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
  if (answer_is_of_images_) return {image_pairs_.pairs.items.data(), image_pairs_.pairs.count};
  return is_sorted_ ? finder_->sorted_pairs() : finder_->pairs();
}

std::span<const Shift> Search::shifts() const {
  if (!has_answer_ || !box_) return {};
  return {image_pairs_.shifts.data(), image_pairs_.pairs.count};
}

OwnedPairs Search::take() {
  if (pairs().empty()) return {};
  has_answer_ = false;
  return answer_is_of_images_ ? std::move(image_pairs_.pairs) : finder_->take_pairs();
}

Pairs Search::handed_over() {
  OwnedPairs taken = take();
  if (!box_ || taken.count == 0) return library::handed_over(std::move(taken));
  return library::handed_over(std::move(taken), std::move(image_pairs_.shifts));
}

std::uint64_t Search::count() {
  return answer_is_of_images_ ? image_pairs_.count : finder_->digest().count;
}

namespace {

/// Returns the list's memory, as long as the list is. The list had room to spare; giving that back
/// moves nothing, unless the list is small.
template <typename T>
T* cut(Buffer<T>& list, std::uint64_t count) {
  T* const all = list.release();
  void* const shorter = all != nullptr ? std::realloc(all, count * sizeof(T)) : nullptr;
  return shorter != nullptr ? static_cast<T*>(shorter) : all;
}

}  // namespace

Pairs handed_over(OwnedPairs pairs, Buffer<Shift> shifts) {
  if (pairs.count == 0) return {};
  Shift* const all_shifts = cut(shifts, pairs.count);
  return PairsAccess::make(cut(pairs.items, pairs.count), all_shifts, pairs.count);
}

}  // namespace octocell::library
