// SPDX-License-Identifier: MIT
#include "core/planner/scene_stats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "core/error.hpp"
#include "core/flags.hpp"
#include "core/lattice.hpp"
#include "core/pair.hpp"
#include "core/planner/bulk.hpp"
#include "core/planner/lattice.hpp"
#include "core/simd.hpp"

namespace octocell {
namespace {

constexpr std::size_t kSmallestSample = 64;  // planning must not take longer than the work
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Four spheres side by side, x y z r each; compilers keep each array in one or a few registers.
constexpr std::size_t kAbreast = 4;
struct Lanes {
  static constexpr std::size_t kLanes = 4 * kAbreast;
  float lowest[kLanes];  // for radii, the lowest above zero
  float highest[kLanes];
  float taint[kLanes];  // becomes NaN at the first value that is not finite
  float least[kLanes];

  Lanes() {
    std::ranges::fill(lowest, kInfinity);
    std::ranges::fill(highest, -kInfinity);
    std::ranges::fill(taint, 0.0F);
    std::ranges::fill(least, kInfinity);
  }
  /// `above_zero` is minus infinity for coordinates and zero for radii.
  void add(const Sphere* spheres, const float (&above_zero)[kLanes]) {
    float value[kLanes];
    std::memcpy(value, spheres, sizeof value);
    for (std::size_t k = 0; k < kLanes; ++k) {
      highest[k] = value[k] > highest[k] ? value[k] : highest[k];
      taint[k] += value[k] - value[k];
      least[k] = value[k] < least[k] ? value[k] : least[k];
      const float counted = value[k] > above_zero[k] ? value[k] : kInfinity;
      lowest[k] = counted < lowest[k] ? counted : lowest[k];
    }
  }
};

bool is_valid(const Sphere& s) {
  return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.r) &&
         s.r >= 0.0F;
}

std::vector<RadiusClass> classify_radii(SceneView scene, const PlanFacts& facts) {
  const auto count = static_cast<std::uint64_t>(scene.spheres.size());
  if (count == 0) return {};
  if (facts.r_min == facts.r_max) {
    return {{.count = count,
             .radius_sum = static_cast<double>(facts.r_max) * static_cast<double>(count),
             .largest = facts.r_max}};
  }
  // Uses several tables in turn: most spheres are of one class, and so no update waits for the one
  // before. Zeros have the first entry; numbers below 2^-126 have the second.
  std::array<std::array<RadiusClass, 257>, kAbreast> tables = {};
  for (std::size_t i = 0; i < count; ++i) {
    const float r = scene.spheres[i].r;
    const std::uint32_t exponent = std::bit_cast<std::uint32_t>(r) >> 23 & 0xffU;
    RadiusClass& c = tables[i % kAbreast][exponent + (r > 0.0F ? 1 : 0)];
    ++c.count;
    c.radius_sum += r;
    c.largest = std::max(c.largest, r);
  }
  std::vector<RadiusClass> found;
  for (std::size_t k = 0; k < tables[0].size(); ++k) {
    RadiusClass all;
    for (const auto& table : tables) {
      all.count += table[k].count;
      all.radius_sum += table[k].radius_sum;
      all.largest = std::max(all.largest, table[k].largest);
    }
    if (all.count != 0) found.push_back(all);
  }
  return found;
}

/// Takes one sphere of each part of the input, so that none is taken twice (it would be its own
/// neighbour). A hash chooses it, so that no order of the input (rows of a lattice) repeats in the
/// sample.
std::vector<Sphere> take_sample(SceneView scene) {
  const std::span<const Sphere> spheres = scene.spheres;
  const std::size_t size = std::clamp(spheres.size() / 16, kSmallestSample, kSampleSize);
  if (spheres.size() <= size) return {spheres.begin(), spheres.end()};
  std::vector<Sphere> sample;
  sample.reserve(size);
  for (std::uint32_t k = 0; k < size; ++k) {
    const std::size_t begin = k * spheres.size() / size;
    const std::size_t end = (k + 1) * spheres.size() / size;
    sample.push_back(spheres[begin + mix_pair({0, k}) % (end - begin)]);
  }
  return sample;
}

}  // namespace

FactsPass measure_facts(std::span<const Sphere> spheres) {
  FactsPass pass;
  pass.facts.sphere_count = spheres.size();
  if (spheres.empty()) return pass;
  Lanes lanes;
  float above_zero[Lanes::kLanes];
  for (std::size_t k = 0; k < Lanes::kLanes; ++k) above_zero[k] = k % 4 == 3 ? 0.0F : -kInfinity;
  std::size_t i = 0;
  for (; i + kAbreast <= spheres.size(); i += kAbreast) lanes.add(&spheres[i], above_zero);
  Sphere rest[kAbreast];
  for (std::size_t k = 0; k < kAbreast; ++k) rest[k] = spheres[std::min(i + k, spheres.size() - 1)];
  lanes.add(rest, above_zero);

  float lowest[4] = {kInfinity, kInfinity, kInfinity, kInfinity};
  float highest[4] = {-kInfinity, -kInfinity, -kInfinity, -kInfinity};
  float least[4] = {kInfinity, kInfinity, kInfinity, kInfinity};
  for (std::size_t k = 0; k < Lanes::kLanes; ++k) {
    lowest[k % 4] = std::min(lowest[k % 4], lanes.lowest[k]);
    highest[k % 4] = std::max(highest[k % 4], lanes.highest[k]);
    least[k % 4] = std::min(least[k % 4], lanes.least[k]);
    pass.valid = pass.valid && lanes.taint[k] == 0.0F;
  }
  pass.valid = pass.valid && least[3] >= 0.0F;
  for (int a = 0; a < 3; ++a) {
    pass.facts.lowest[a] = lowest[a];
    pass.facts.highest[a] = highest[a];
  }
  pass.facts.r_min = least[3];
  pass.facts.r_max = highest[3];
  pass.facts.r_min_nonzero = lowest[3] == kInfinity ? 0.0F : lowest[3];
  return pass;
}

FactsPass merge(const FactsPass& a, const FactsPass& b) {
  FactsPass both = a;
  both.valid = a.valid && b.valid;
  PlanFacts& f = both.facts;
  f.sphere_count += b.facts.sphere_count;
  for (int axis = 0; axis < 3; ++axis) {
    f.lowest[axis] = std::min(f.lowest[axis], b.facts.lowest[axis]);
    f.highest[axis] = std::max(f.highest[axis], b.facts.highest[axis]);
  }
  f.r_min = std::min(f.r_min, b.facts.r_min);
  f.r_max = std::max(f.r_max, b.facts.r_max);
  const float other = b.facts.r_min_nonzero;
  if (other != 0.0F && (f.r_min_nonzero == 0.0F || other < f.r_min_nonzero)) {
    f.r_min_nonzero = other;
  }
  return both;
}

/// Uses explicit vectors: floor() and != may trap, so compilers do not vectorise them.
bool lie_on_lattice(std::span<const Sphere> spheres, double units_per_length) {
  constexpr std::size_t kAtOnce = 2;
  static_assert(sizeof(Sphere[kAtOnce]) == 4 * kAtOnce * sizeof(float), "read as numbers in a row");
  using Numbers = Vector<double, 4 * kAtOnce>;
  Numbers::mask_type amiss(false);
  for (; spheres.size() >= kAtOnce; spheres = spheres.subspan(kAtOnce)) {
    const Numbers numbers(&spheres.front().x, stdx::element_aligned);
    const Numbers units = numbers * units_per_length;
    amiss = amiss || units != stdx::floor(units);
  }
  return stdx::none_of(amiss) &&
         (spheres.empty() || lies_on_lattice(spheres.front(), units_per_length));
}

std::size_t first_invalid(std::span<const Sphere> spheres) {
  std::size_t i = 0;
  while (i + 1 < spheres.size() && is_valid(spheres[i])) ++i;
  return i;
}

std::string describe_first_invalid(std::span<const Sphere> spheres) {
  const std::size_t i = first_invalid(spheres);
  const Sphere& s = spheres[i];
  return fmt::format("sphere {}: x={} y={} z={} r={}; all four must be finite and r >= 0", i, s.x,
                     s.y, s.z, s.r);
}

void require_all_flags(SceneView scene) {
  if (scene.flags.empty() || scene.flags.size() == scene.spheres.size()) return;
  throw InputError(
      fmt::format("flags of {} spheres for {}", scene.flags.size(), scene.spheres.size()));
}

SceneStats measure(SceneView scene) {
  if (scene.spheres.size() > kMaxSpheres) {
    throw InputError(fmt::format("{} spheres; this implementation's limit is {}",
                                 scene.spheres.size(), kMaxSpheres),
                     ErrorKind::limit);
  }
  require_all_flags(scene);
  SceneStats stats;
  if (scene.spheres.empty()) return stats;
  const FactsPass pass = measure_facts(scene.spheres);
  if (!pass.valid) {
    throw InputError(describe_first_invalid(scene.spheres), ErrorKind::invalid_sphere,
                     first_invalid(scene.spheres));
  }
  stats.facts = pass.facts;
  stats.some_may_collide = some_may_collide(scene.flags);
  stats.static_share =
      static_cast<float>(count_static(scene.flags)) / static_cast<float>(scene.spheres.size());
  stats.radii = classify_radii(scene, stats.facts);
  stats.sample = take_sample(scene);
  stats.bulk = find_bulk(stats.facts, stats.sample);
  stats.facts.lattice_units_per_length =
      find_lattice(stats.sample, scene.spheres, stats.facts.r_max);
  return stats;
}

}  // namespace octocell
