// SPDX-License-Identifier: MIT
// What the numbers and the places of two spheres may have to do with the loss of their pair, and
// lists that are full.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/judge/hypotheses.hpp"

namespace octocell::judge {
namespace {

constexpr std::uint32_t kBlocks[] = {32, 64, 128, 192, 256, 384, 512, 768, 1024};

void add(Hypotheses& all, std::string name, std::string text, std::function<bool(Pair)> holds) {
  all.push_back({.name = std::move(name), .text = std::move(text), .holds = std::move(holds)});
}

void add_some(Hypotheses& all, std::string name, std::string text,
              std::function<bool(Pair)> holds) {
  add(all, std::move(name), std::move(text), std::move(holds));
  all.back().spoils_some = true;
}

/// A quantity of a pair that may have a bound.
struct Quantity {
  const char* name;
  const char* text_high;  // with {} for the least value
  const char* text_low;   // with {} for the largest value; null: not tried
  std::function<double(Pair)> of;
};

double relative_depth_of(const SceneFacts& facts, Pair pair) {
  const Sphere& a = facts.spheres[pair.i];
  const Sphere& b = facts.spheres[pair.j];
  const double r = static_cast<double>(a.r) + b.r;
  const double distance = std::hypot(static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y,
                                     static_cast<double>(a.z) - b.z);
  return r > 0.0 ? (r - distance) / r : 0.0;
}

double farthest_of(const Sphere& s) {
  return std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)});
}

std::vector<Quantity> quantities(const SceneFacts& facts) {
  const auto with_both = [&facts](auto value) {
    return [&facts, value](Pair pair) {
      return std::max<double>(value(facts.spheres[pair.i]), value(facts.spheres[pair.j]));
    };
  };
  return {
      {"large spheres", "have a sphere of radius {:g} or more", nullptr,
       with_both([](const Sphere& s) { return s.r; })},
      {"crowded", "have a sphere with {:g} partners or more", nullptr,
       [&facts](Pair pair) { return std::max(facts.partners[pair.i], facts.partners[pair.j]); }},
      {"far from the origin", "have a coordinate of {:g} or more, positive or negative", nullptr,
       with_both(farthest_of)},
      {"depth", "overlap by {:g} of the radii's sum or more",
       "overlap by {:g} of the radii's sum or less",
       [&facts](Pair pair) { return relative_depth_of(facts, pair); }},
      {"high ids", "have an id of {:g} or more", nullptr,
       [](Pair pair) { return static_cast<double>(pair.j); }},
      {"ids far apart", "have ids {:g} or more apart", "have ids {:g} or less apart",
       [](Pair pair) { return static_cast<double>(pair.j - pair.i); }},
  };
}

}  // namespace

void add_ids(Hypotheses& all, const SceneFacts& facts) {
  const std::uint64_t n = facts.spheres.size();
  for (int bits = 8; bits < 28 && n > std::uint64_t{1} << bits; ++bits) {
    const std::uint32_t least = 1U << bits;
    add(all, fmt::format("ids of 2^{} and more", bits),
        fmt::format("have an id of 2^{} = {} or more", bits, least),
        [least](Pair pair) { return pair.j >= least; });
    add(all, fmt::format("ids of 2^{} and more", bits),
        fmt::format("have two ids of 2^{} = {} or more", bits, least),
        [least](Pair pair) { return pair.i >= least; });
  }
  for (const std::uint32_t block : kBlocks) {
    if (n <= block) continue;
    add(all, "block borders", fmt::format("lie across a border of blocks of {} spheres", block),
        [block](Pair pair) { return pair.i / block != pair.j / block; });
    if (n % block == 0) continue;
    const auto first = static_cast<std::uint32_t>(n - n % block);
    add_some(all, "last block",
             fmt::format("have a sphere in the last block of {}, which is not full", block),
             [first](Pair pair) { return pair.j >= first; });
  }
  for (const int bits : {31, 32}) {
    add(all, fmt::format("pair number of {} bits", bits),
        fmt::format("have i n + j of 2^{} or more", bits),
        [n, bits](Pair pair) { return pair.i * n + pair.j >= std::uint64_t{1} << bits; });
  }
  add(all, "first sphere", "have sphere 0", [](Pair pair) { return pair.i == 0; });
  add(all, "last sphere", fmt::format("have the last sphere, {}", n - 1),
      [n](Pair pair) { return pair.j == n - 1; });
  add(all, "next id", "have j = i + 1", [](Pair pair) { return pair.j == pair.i + 1; });
}

void add_coordinates(Hypotheses& all, const SceneFacts& facts) {
  const auto is_negative = [&facts](std::uint32_t id, std::size_t axis) {
    return centre_of(facts.spheres[id])[axis] < 0.0F;
  };
  const auto has_negative = [is_negative](std::uint32_t id) {
    return is_negative(id, 0) || is_negative(id, 1) || is_negative(id, 2);
  };
  add_some(all, "negative coordinates", "have a negative coordinate",
           [=](Pair pair) { return has_negative(pair.i) || has_negative(pair.j); });
  add_some(all, "negative coordinates", "have two spheres with a negative coordinate",
           [=](Pair pair) { return has_negative(pair.i) && has_negative(pair.j); });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add_some(all, "negative coordinates", fmt::format("have a negative {}", "xyz"[axis]),
             [=](Pair pair) { return is_negative(pair.i, axis) || is_negative(pair.j, axis); });
    add_some(all, "both sides of zero", fmt::format("lie on both sides of {} = 0", "xyz"[axis]),
             [=](Pair pair) { return is_negative(pair.i, axis) != is_negative(pair.j, axis); });
  }
}

void add_capacity(Hypotheses& all, const Differences& differences, const SceneFacts& facts) {
  if (differences.found.empty()) return;
  const std::uint64_t rows = differences.listed;
  add(all, "clipped", fmt::format("come behind the last pair of the list, which has {} rows", rows),
      [last = differences.found.back()](Pair pair) { return pair > last; });
  for (const bool of_lower : {true, false}) {
    std::vector<std::uint32_t> found(facts.spheres.size());
    for (const Pair& pair : differences.found) ++found[of_lower ? pair.i : pair.j];
    const std::uint32_t most = *std::ranges::max_element(found);
    add_some(
        all, "clipped per sphere",
        fmt::format("belong to a sphere that has {} pairs as the {} id already, and no sphere has "
                    "more",
                    most, of_lower ? "lower" : "higher"),
        [=](Pair pair) { return found[of_lower ? pair.i : pair.j] == most; });
  }
}

void add_bounds(Hypotheses& all, const SceneFacts& facts, std::span<const Pair> wrong) {
  for (const Quantity& quantity : quantities(facts)) {
    double least = std::numeric_limits<double>::infinity();
    double largest = -least;
    for (const Pair& pair : wrong) {
      least = std::min(least, quantity.of(pair));
      largest = std::max(largest, quantity.of(pair));
    }
    const auto tries = static_cast<double>(facts.truth.size());
    all.push_back({.name = quantity.name,
                   .text = fmt::format(fmt::runtime(quantity.text_high), least),
                   .holds = [of = quantity.of, least](Pair pair) { return of(pair) >= least; },
                   .spoils_some = true,
                   .tries = tries});
    if (quantity.text_low == nullptr) continue;
    all.push_back({.name = quantity.name,
                   .text = fmt::format(fmt::runtime(quantity.text_low), largest),
                   .holds = [of = quantity.of, largest](Pair pair) { return of(pair) <= largest; },
                   .spoils_some = true,
                   .tries = tries});
  }
}

}  // namespace octocell::judge
