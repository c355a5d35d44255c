// SPDX-License-Identifier: MIT
#include "harness/engine/images/image_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "core/flags.hpp"
#include "core/images/image_overlap.hpp"
#include "core/planner/scene_stats.hpp"
#include "harness/engine/images/image_parts.hpp"

namespace octocell::images {
namespace {

/// Returns a float that is at least `value`.
float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) >= value) return nearest;
  return std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

double volume_of_ball(double radius) { return 4.18879 * radius * radius * radius; }

/// Names the first sphere that is not valid; there must be one.
[[noreturn]] void throw_invalid(const Question& question) {
  const auto all = question.scene.spheres;
  const std::uint64_t first = question.second_from.value_or(all.size());
  const bool in_second = first_invalid(all) >= first;
  const auto set = in_second ? all.subspan(first) : all;
  throw InputError((in_second ? "others: " : "") + describe_first_invalid(set),
                   ErrorKind::invalid_sphere, first_invalid(set));
}

}  // namespace

void require_valid(const Question& question) {
  const double gap = question.gap;
  if (!(gap == 0.0 || (gap >= kLeastGap && gap <= std::numeric_limits<float>::max()))) {
    throw InputError(fmt::format("cutoff {}: must be 0, or from {} to {}", gap, kLeastGap,
                                 std::numeric_limits<float>::max()));
  }
  if (question.scene.spheres.size() > kMaxSpheres) {
    throw InputError(fmt::format("{} spheres; this implementation's limit is {}",
                                 question.scene.spheres.size(), kMaxSpheres),
                     ErrorKind::limit);
  }
  require_all_flags(question.scene);
  if (!question.batch.empty() && question.batch.size() != question.scene.spheres.size()) {
    throw InputError(fmt::format("batch: numbers of {} spheres for {}", question.batch.size(),
                                 question.scene.spheres.size()));
  }
}

void Images::place(const Question& question, cpu::Threads& threads) {
  require_valid(question);
  question_ = question;
  box_ = prepare(question.box);
  threads_ = &threads;
  measure();
  choose_homes();
  bound_errors();
  count_images();
  place_batches();
  choose_scale();
}

void Images::measure() {
  const auto spheres = question_.scene.spheres;
  FactsPass all;
  bool is_first = true;
  double radii = 0.0;
  std::mutex mutex;
  threads_->for_blocks(spheres.size(), kBlock, [&](std::uint64_t begin, std::uint64_t end) {
    const auto some = spheres.subspan(begin, end - begin);
    const FactsPass pass = measure_facts(some);
    double sum = 0.0;
    for (const Sphere& s : some) sum += s.r;
    const std::scoped_lock lock(mutex);
    all = is_first ? pass : merge(all, pass);
    is_first = false;
    radii += sum;
  });
  if (!spheres.empty() && !all.valid) throw_invalid(question_);
  r_max_ = all.facts.r_max;
  mean_radius_ = spheres.empty() ? 0.0 : radii / static_cast<double>(spheres.size());
  for (int k = 0; k < 3; ++k) {
    highest_[k] = std::max(std::abs(static_cast<double>(all.facts.lowest[k])),
                           std::abs(static_cast<double>(all.facts.highest[k])));
  }
}

/// Images may lie beyond the largest float32; then the enclosing scene is smaller.
void Images::choose_scale() {
  double farthest = 0.0;
  for (int k = 0; k < 3; ++k) {
    double steps = 0.0;
    for (int a = 0; a < 3; ++a) {
      if (box_.periodic[a]) steps += most_steps_ * std::abs(box_.h[a][k]);
    }
    farthest = std::max(farthest, highest_[k] + steps);
  }
  farthest = std::max(farthest, 2.0 * batches_end_);
  farthest += 2.0 * (r_max_ + question_.gap);
  scale_ = farthest < 0x1p126 ? 1.0 : std::ldexp(1.0, 120 - std::ilogb(farthest));
  exact_homes_ = scale_ == 1.0 && question_.gap == 0.0 && question_.batch.empty();
}

double Images::direct_tests() const {
  const auto n = static_cast<double>(question_.scene.spheres.size());
  double images = 1.0;
  for (int a = 0; a < 3; ++a) {
    if (!box_.periodic[a]) continue;
    images *= std::max(1.0, 2.0 * box_.g_length[a] * (2.0 * mean_radius_ + question_.gap));
  }
  return n * (n + 1.0) / 2.0 * images;
}

double Images::search_tests() const {
  constexpr double kTestsPerSphere = 60.0;  // that cost as much as sorting it in
  const double n = static_cast<double>(question_.scene.spheres.size()) + count_;
  const double reach = 2.0 * mean_radius_ + question_.gap;
  double volume = box_.volume * batches_;
  for (int a = 0; a < 3; ++a) {
    volume *= range_[a].highest - range_[a].lowest + 2.0 * box_.g_length[a] * reach;
  }
  const double part = reach > 0.0 ? std::min(1.0, volume_of_ball(reach) / volume) : 0.0;
  return n * kTestsPerSphere + n * n / 2.0 * part;
}

Sphere Images::enclosing(std::uint32_t i, const Shift& shift) const {
  const Sphere& s = question_.scene.spheres[i];
  if (exact_homes_ && shift == Shift{0, 0, 0}) return s;
  Moved to = moved(i, shift);
  if (!offsets_.empty()) {
    for (int k = 0; k < 3; ++k) {
      to.at[k] += offsets_[question_.batch[i]].along[k];
      to.error[k] += 2.0 * kUnit * std::abs(to.at[k]);
    }
  }
  float at[3];
  double error = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double scaled = to.at[k] * scale_;
    at[k] = static_cast<float>(scaled);
    error += std::abs(scaled - at[k]) + to.error[k] * scale_;
  }
  const double radius = (s.r + question_.gap / 2.0) * scale_ + error;
  return {at[0], at[1], at[2], rounded_up(radius * (1.0 + 16.0 * kUnit))};
}

/// Returns the flags of a home or, if static, of an image. Images among each other are no pairs.
Flags Images::word_of(std::uint64_t i, bool is_static) const {
  if (const auto from = question_.second_from) {
    return i < *from ? make_flags(is_static, 1, 2) : make_flags(is_static, 2, 1);
  }
  const Flags word = question_.scene.flags.empty() ? Flags{} : question_.scene.flags[i];
  return make_flags(is_static, group_of(word), mask_of(word));
}

void Images::enclose() {
  const SceneView given = question_.scene;
  const std::uint64_t homes = given.spheres.size();
  const double all = count_ + static_cast<double>(homes);
  if (all > static_cast<double>(kMaxSpheres)) {
    throw LimitError(fmt::format(
        "box: {:.4g} images of its {} spheres may touch them; this implementation's limit is {}",
        count_, homes, kMaxSpheres - homes));
  }
  require_memory(all * (sizeof(Sphere) + sizeof(Flags)) + count_ * sizeof(Image),
                 fmt::format("{} images of {} spheres", count_, homes));
  const auto size = static_cast<std::uint64_t>(all);
  spheres_.resize(size);
  others_.resize(size - homes);
  flags_.clear();
  if (size > homes || !given.flags.empty() || question_.second_from) flags_.resize(size);

  std::vector<std::uint64_t> first_of_block(at_ends_.size());
  std::uint64_t next = 0;
  for (std::size_t b = 0; b < first_of_block.size(); ++b) {
    first_of_block[b] = next;
    next += static_cast<std::uint64_t>(at_ends_[b].images);
  }
  threads_->for_blocks(homes, kBlock, [&](std::uint64_t begin, std::uint64_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      spheres_[i] = enclosing(i, home_of(i));
      if (!flags_.empty()) flags_[i] = word_of(i, false);
    }
    std::uint64_t image = first_of_block[begin / kBlock];
    for (const std::uint32_t i : at_ends_[begin / kBlock].spheres) {
      for_positive(steps(i, range_, r_max_), [&](const Shift& step) {
        others_[image] = {i, home_of(i) + step};
        spheres_[homes + image] = enclosing(i, others_[image].shift);
        flags_[homes + image] = word_of(i, true);
        ++image;
      });
    }
  });
}

}  // namespace octocell::images
