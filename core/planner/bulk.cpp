// SPDX-License-Identifier: MIT
#include "core/planner/bulk.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace octocell {
namespace {

/// The box of all centres must be this many times wider than the bulk, or cells would gain too
/// little.
constexpr double kFar = 16.0;
/// An axis keeps its whole box unless that is this many times wider than the bulk.
constexpr double kNearly = 4.0;
/// This many spheres show whether it is worth sorting the whole sample.
constexpr std::size_t kGlance = 64;
/// Parts of the sample that count as outliers at either end of an axis.
constexpr std::array<double, 3> kOutside = {1.0 / 64, 1.0 / 16, 1.0 / 4};
/// The bulk may extend this many widths beyond the interval between the outliers: that holds a
/// uniform distribution easily, and a Gaussian one except for a few in a million.
constexpr double kSpread = 3.0;
/// Added on either side, as a part of the sample's width: the sample lacks the outermost spheres.
constexpr double kMargin = 0.125;

struct Interval {
  double low;
  double high;
  [[nodiscard]] double width() const { return high - low; }
};

Interval all_of(const PlanFacts& facts, int axis) {
  return {facts.lowest[axis], facts.highest[axis]};
}

double coordinate(const Sphere& s, int axis) { return axis == 0 ? s.x : axis == 1 ? s.y : s.z; }

/// Returns the sorted coordinates of every `stride`-th sphere.
std::vector<double> coordinates(const std::vector<Sphere>& sample, int axis, std::size_t stride) {
  std::vector<double> values;
  values.reserve(sample.size() / stride + 1);
  for (std::size_t k = 0; k < sample.size(); k += stride) {
    values.push_back(coordinate(sample[k], axis));
  }
  std::ranges::sort(values);
  return values;
}

/// Returns the interval without the part `outside` of the values at either end.
Interval middle(const std::vector<double>& sorted, double outside) {
  const auto cut = static_cast<std::size_t>(outside * static_cast<double>(sorted.size()));
  return {sorted[cut], sorted[sorted.size() - 1 - cut]};
}

/// Returns true if half of the spheres lie very close together compared with the box of all.
bool is_worth_a_look(const PlanFacts& facts, const std::vector<Sphere>& sample) {
  for (int a = 0; a < 3; ++a) {
    const std::vector<double> few =
        coordinates(sample, a, std::max<std::size_t>(sample.size() / kGlance, 1));
    if (all_of(facts, a).width() > 2.0 * kFar * middle(few, 0.25).width()) return true;
  }
  return false;
}

/// Returns the interval of the bulk along an axis.
Interval bulk_of_axis(const Interval& all, const std::vector<double>& sorted, double outside) {
  const Interval core = middle(sorted, outside);
  const double spread = kSpread * core.width();
  const double lowest = *std::ranges::lower_bound(sorted, core.low - spread);
  const double highest = *(std::ranges::upper_bound(sorted, core.high + spread) - 1);
  const double margin = kMargin * (highest - lowest);
  const Interval bulk = {std::max(lowest - margin, all.low), std::min(highest + margin, all.high)};
  return all.width() > kNearly * bulk.width() ? bulk : all;
}

}  // namespace

std::vector<Bulk> find_bulk(const PlanFacts& facts, const std::vector<Sphere>& sample) {
  if (sample.size() < kGlance || !is_worth_a_look(facts, sample)) return {};
  std::array<std::vector<double>, 3> sorted;
  for (int a = 0; a < 3; ++a) sorted[static_cast<std::size_t>(a)] = coordinates(sample, a, 1);
  std::vector<Bulk> boxes;
  for (const double outside : kOutside) {
    Bulk box;
    bool is_far_smaller = false;
    for (int a = 0; a < 3; ++a) {
      const Interval all = all_of(facts, a);
      const Interval bulk = bulk_of_axis(all, sorted[static_cast<std::size_t>(a)], outside);
      box.lowest[a] = static_cast<float>(bulk.low);
      box.highest[a] = static_cast<float>(bulk.high);
      is_far_smaller = is_far_smaller || all.width() > kFar * bulk.width();
    }
    if (is_far_smaller && (boxes.empty() || !(boxes.back() == box))) boxes.push_back(box);
  }
  return boxes;
}

SceneStats only_bulk(SceneStats stats, const Bulk& bulk) {
  std::ranges::copy(bulk.lowest, stats.facts.lowest);
  std::ranges::copy(bulk.highest, stats.facts.highest);
  stats.bulk.clear();
  return stats;
}

double share_of_axis(const SceneStats& stats, int axis, double width) {
  const double low = stats.bulk.empty() ? stats.facts.lowest[axis] : stats.bulk[0].lowest[axis];
  const double high = stats.bulk.empty() ? stats.facts.highest[axis] : stats.bulk[0].highest[axis];
  return high - low > width ? width / (high - low) : 1.0;
}

}  // namespace octocell
