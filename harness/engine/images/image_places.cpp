// SPDX-License-Identifier: MIT
// Where homes and images are: in boxes, along each axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "harness/engine/images/image_parts.hpp"
#include "harness/engine/images/image_scene.hpp"

namespace octocell::images {

Images::Moved Images::moved(std::uint32_t i, const Shift& shift) const {
  const Sphere& s = question_.scene.spheres[i];
  Moved to = {{s.x, s.y, s.z}, {0.0, 0.0, 0.0}};
  if (shift == Shift{0, 0, 0}) return to;
  for (int k = 0; k < 3; ++k) {
    double size = std::abs(to.at[k]);
    for (int a = 0; a < 3; ++a) {
      if (component(shift, a) == 0) continue;
      const double step = component(shift, a) * box_.h[a][k];
      to.at[k] += step;
      size += std::abs(step);
    }
    to.error[k] = 8.0 * kUnit * size;
  }
  return to;
}

void Images::place_of(std::uint32_t i, double (&along)[3]) const {
  const Moved home = moved(i, home_of(i));
  for (int a = 0; a < 3; ++a) {
    const auto& g = box_.g[a];
    along[a] = g[0] * home.at[0] + g[1] * home.at[1] + g[2] * home.at[2];
  }
}

void Images::measure_homes() {
  std::mutex mutex;
  for (Range& range : range_) range = kNothing;
  threads_->for_blocks(question_.scene.spheres.size(), kBlock,
                       [&](std::uint64_t begin, std::uint64_t end) {
                         Range some[3] = {kNothing, kNothing, kNothing};
                         for (std::uint64_t i = begin; i < end; ++i) {
                           double at[3];
                           place_of(static_cast<std::uint32_t>(i), at);
                           for (int a = 0; a < 3; ++a) widen(some[a], at[a], at[a]);
                         }
                         const std::scoped_lock lock(mutex);
                         for (int a = 0; a < 3; ++a) {
                           widen(range_[a], some[a].lowest, some[a].highest);
                         }
                       });
  if (question_.scene.spheres.empty()) std::ranges::fill(range_, Range{0.0, 0.0});
}

/// Spheres stay where they are along an axis on which all lie within one box; else they are moved
/// into the box around the middle.
void Images::choose_homes() {
  homes_.clear();
  measure_homes();
  bool moves[3];
  double from[3];
  for (int a = 0; a < 3; ++a) {
    moves[a] = box_.periodic[a] && range_[a].highest - range_[a].lowest > 1.0;
    from[a] = (range_[a].lowest + range_[a].highest) / 2.0 - 0.5;
    if (moves[a] && !(range_[a].highest - range_[a].lowest < kMostBoxes)) {
      throw LimitError(fmt::format(
          "box: the spheres lie {:.3g} boxes apart along vector {}; this implementation's limit is "
          "{}",
          range_[a].highest - range_[a].lowest, "abc"[a], static_cast<std::int64_t>(kMostBoxes)));
    }
  }
  if (!moves[0] && !moves[1] && !moves[2]) return;
  std::vector<Shift> homes(question_.scene.spheres.size());
  threads_->for_blocks(homes.size(), kBlock, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) {
      double at[3];
      place_of(static_cast<std::uint32_t>(i), at);
      const auto steps = [&](int a) {
        return moves[a] ? -static_cast<std::int32_t>(std::floor(at[a] - from[a])) : 0;
      };
      homes[i] = {steps(0), steps(1), steps(2)};
    }
  });
  homes_ = std::move(homes);
  measure_homes();
}

void Images::bound_errors() {
  double most[3] = {0, 0, 0};
  for (const Shift& home : homes_) {
    for (int a = 0; a < 3; ++a) most[a] = std::max(most[a], std::abs(1.0 * component(home, a)));
  }
  for (int k = 0; k < 3; ++k) {
    for (int a = 0; a < 3; ++a) {
      if (box_.periodic[a]) highest_[k] += most[a] * std::abs(box_.h[a][k]);
    }
  }
  double off[3];
  double farthest = 0.0;
  for (int a = 0; a < 3; ++a) {
    const auto& g = box_.g[a];
    off[a] = 16.0 * kUnit *
             (std::abs(g[0]) * highest_[0] + std::abs(g[1]) * highest_[1] +
              std::abs(g[2]) * highest_[2]);
    if (!box_.periodic[a]) continue;
    farthest = std::max(farthest, range_[a].highest - range_[a].lowest + 2.0 * off[a] +
                                      box_.g_length[a] * (2.0 * r_max_ + question_.gap));
  }
  const double steps = 1.5 * farthest + 1.0;
  if (!(steps < kMostBoxes)) {
    throw LimitError(fmt::format(
        "box: a sphere may meet images {:.3g} boxes away; this implementation's limit is {}", steps,
        static_cast<std::int64_t>(kMostBoxes)));
  }
  most_steps_ = static_cast<std::int32_t>(steps);
  for (int a = 0; a < 3; ++a) {
    slack_[a] = 2.0 * off[a] + box_.skew[a] * steps +
                0x1p-45 * (std::abs(range_[a].lowest) + std::abs(range_[a].highest) + steps);
  }
}

Images::Steps Images::steps(std::uint32_t i, const Range (&places)[3], double other_radius) const {
  double at[3];
  place_of(i, at);
  const double reach = question_.scene.spheres[i].r + other_radius + question_.gap;
  Steps steps = {};
  for (int a = 0; a < 3; ++a) {
    if (!box_.periodic[a]) continue;
    const double margin = box_.g_length[a] * reach * (1.0 + 8.0 * kUnit) + slack_[a];
    steps.first[a] = static_cast<std::int32_t>(std::ceil(places[a].lowest - at[a] - margin));
    steps.last[a] = static_cast<std::int32_t>(std::floor(places[a].highest - at[a] + margin));
  }
  return steps;
}

/// Lists the spheres whose images may be near the scene: those near an end of the homes' range. A
/// sphere needs a step down if lowest - at - margin <= -1, and a step up if highest - at + margin
/// >= 1.
void Images::count_images() {
  const std::uint64_t size = question_.scene.spheres.size();
  at_ends_.assign(size / kBlock + 1, {});
  count_ = 0.0;
  if (!box_.repeats()) return;
  double from[3];
  double to[3];
  for (int a = 0; a < 3; ++a) {
    const double reach = 2.0 * r_max_ + question_.gap;
    const double margin = box_.g_length[a] * reach * (1.0 + 8.0 * kUnit) + slack_[a];
    constexpr double kAll = std::numeric_limits<double>::infinity();
    from[a] = box_.periodic[a] ? range_[a].highest + margin - 1.0 : -kAll;
    to[a] = box_.periodic[a] ? range_[a].lowest - margin + 1.0 : kAll;
  }
  threads_->for_blocks(size, kBlock, [&](std::uint64_t begin, std::uint64_t end) {
    AtEnds& at_ends = at_ends_[begin / kBlock];
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      double at[3];
      place_of(i, at);
      const bool is_inside = (at[0] > from[0]) & (at[0] < to[0]) & (at[1] > from[1]) &
                             (at[1] < to[1]) & (at[2] > from[2]) & (at[2] < to[2]);
      if (is_inside) continue;
      at_ends.spheres.push_back(i);
      at_ends.images += count_positive(steps(i, range_, r_max_));
    }
  });
  for (const AtEnds& at_ends : at_ends_) count_ += at_ends.images;
}

}  // namespace octocell::images
