// SPDX-License-Identifier: MIT
// M. Metamorphic relations that are exact in floating point: a scene is changed so that its pairs
// follow from those of the original. The reference decides only about the original.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/reference/reference.hpp"
#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

struct Base {
  std::string name;
  Spheres spheres;
  std::vector<Pair> pairs;
};

Spheres near_tangent(std::size_t n) {
  Random random(50);
  const auto coordinate = [&] {
    const float place = static_cast<float>(step(random, 6)) * 0.7F;
    const int nudge = step(random, 3);
    return place == 0.0F ? place : nudged(place, nudge);  // the neighbours of zero are all
                                                          // subnormal
  };
  return repeated(n, [&](std::size_t) {
    const float x = coordinate();
    const float y = coordinate();
    return Sphere{x, y, coordinate(), nudged(0.35F, step(random, 2))};
  });
}

/// Scenes in which a wrong predicate or wrong cells would show. A factor of 2^40 neither overflows
/// their numbers nor makes them subnormal.
std::vector<Base> bases(std::size_t n) {
  std::vector<Base> bases = {
      {"near-tangent pairs", near_tangent(n), {}},
      {"poly", scene("poly", n, "phi=0.3"), {}},
      {"lattice of 0.1", scene("lattice", n, "spacing=0.1"), {}},
      {"two clouds",
       joined(scene("dense", n / 2), moved(scene("dense", n / 2, "seed=3"), 1e6, -1e6, 77)),
       {}}};
  for (Base& base : bases) base.pairs = reference::exact_pairs(base.spheres);
  return bases;
}

/// Changes each sphere by itself; the pairs stay the same.
template <typename Change>
std::vector<Case> changed(std::size_t n, Change change) {
  std::vector<Case> cases;
  for (Base& base : bases(n)) {
    for (Sphere& s : base.spheres) s = change(s);
    cases.push_back({.name = base.name, .spheres = base.spheres, .pairs = base.pairs});
  }
  return cases;
}

/// Puts sphere old_id[k] at place k; the pairs change accordingly.
Case renumbered(const Base& base, const std::vector<std::uint32_t>& old_id) {
  std::vector<std::uint32_t> new_id(base.spheres.size());
  Case result = {.name = base.name, .pairs = std::vector<Pair>()};
  for (std::uint32_t k = 0; k < old_id.size(); ++k) {
    result.spheres.push_back(base.spheres[old_id[k]]);
    new_id[old_id[k]] = k;
  }
  for (const Pair& pair : base.pairs) {
    result.pairs->push_back(make_pair_of(new_id[pair.i], new_id[pair.j]));
  }
  std::sort(result.pairs->begin(), result.pairs->end());
  return result;
}

std::vector<std::uint32_t> ids(std::size_t n) {
  std::vector<std::uint32_t> ids(n);
  std::iota(ids.begin(), ids.end(), 0U);
  return ids;
}

std::vector<Case> swapped(std::size_t n) {
  std::vector<Case> cases;
  for (const Base& base : bases(n)) {
    std::vector<std::uint32_t> backwards = ids(base.spheres.size());
    std::reverse(backwards.begin(), backwards.end());
    cases.push_back(renumbered(base, backwards));
  }
  return cases;
}

std::vector<Case> permuted_ids(std::size_t n) {
  std::vector<Case> cases;
  Random random(51);
  for (const Base& base : bases(n)) {
    std::vector<std::uint32_t> order = ids(base.spheres.size());
    for (std::size_t left = order.size(); left > 1; --left) {
      std::swap(order[left - 1], order[random.below(left)]);
    }
    cases.push_back(renumbered(base, order));
  }
  return cases;
}

std::vector<Case> scaled_by_powers(std::size_t n) {
  std::vector<Case> cases;
  for (const float factor : {0x1p40F, 0x1p-40F, 2.0F}) {
    const auto more = changed(n, [factor](const Sphere& s) {
      return Sphere{s.x * factor, s.y * factor, s.z * factor, s.r * factor};
    });
    cases.insert(cases.end(), more.begin(), more.end());
  }
  return cases;
}

std::vector<Case> reflected(std::size_t n) {
  std::vector<Case> cases = changed(n, [](const Sphere& s) { return Sphere{-s.x, s.y, s.z, s.r}; });
  const auto all = changed(n, [](const Sphere& s) { return Sphere{-s.x, -s.y, -s.z, s.r}; });
  cases.insert(cases.end(), all.begin(), all.end());
  return cases;
}

std::vector<Case> axes_permuted(std::size_t n) {
  std::vector<Case> cases = changed(n, [](const Sphere& s) { return Sphere{s.y, s.z, s.x, s.r}; });
  const auto two = changed(n, [](const Sphere& s) { return Sphere{s.z, s.y, s.x, s.r}; });
  cases.insert(cases.end(), two.begin(), two.end());
  return cases;
}

std::vector<Case> rotated(std::size_t n) {
  return changed(n, [](const Sphere& s) { return Sphere{-s.y, s.x, s.z, s.r}; });
}

/// A copy has the partners of its original, and the original itself.
std::vector<Case> duplicated(std::size_t n) {
  std::vector<Case> cases;
  for (Base& base : bases(n)) {
    const auto original = static_cast<std::uint32_t>(base.spheres.size() / 3);
    const auto copy = static_cast<std::uint32_t>(base.spheres.size());
    const std::vector<Pair> before = base.pairs;
    for (const Pair& pair : before) {
      if (pair.i == original) base.pairs.push_back({pair.j, copy});
      if (pair.j == original) base.pairs.push_back({pair.i, copy});
    }
    base.pairs.push_back({original, copy});
    base.spheres.push_back(base.spheres[original]);
    std::sort(base.pairs.begin(), base.pairs.end());
    cases.push_back({.name = base.name, .spheres = base.spheres, .pairs = base.pairs});
  }
  return cases;
}

/// Takes the spheres whose ids have one parity: of all pairs, only those between such spheres
/// remain.
std::vector<Case> split(std::size_t n) {
  std::vector<Case> cases;
  for (const Base& base : bases(n)) {
    for (const std::uint32_t parity : {0U, 1U}) {
      Case part = {.name = base.name + (parity == 0 ? ", A" : ", B"), .pairs = std::vector<Pair>()};
      for (std::size_t k = parity; k < base.spheres.size(); k += 2) {
        part.spheres.push_back(base.spheres[k]);
      }
      for (const Pair& pair : base.pairs) {
        if (pair.i % 2 == parity && pair.j % 2 == parity)
          part.pairs->push_back({pair.i / 2, pair.j / 2});
      }
      cases.push_back(std::move(part));
    }
  }
  return cases;
}

/// Adds far points of radius 0: they change the box and the cells, but no pair.
std::vector<Case> inert(std::size_t n) {
  std::vector<Case> cases;
  for (Base& base : bases(n)) {
    for (const float far : {1e3F, 1e12F, 1e38F}) {
      Case with = {.name = base.name, .spheres = base.spheres, .pairs = base.pairs};
      with.spheres.push_back({far, -far, far, 0.0F});
      with.spheres.push_back({-far, far, 0.0F, 0.0F});
      cases.push_back(std::move(with));
    }
  }
  return cases;
}

/// Neither the side of the cells nor the planner's choice changes the answer.
std::vector<Case> other_cells(std::size_t n) {
  std::vector<Case> cases;
  for (const Base& base : bases(n)) {
    cases.push_back({.name = base.name,
                     .spheres = base.spheres,
                     .pairs = base.pairs,
                     .cell_sides = {0.3, 0.7, 1.0, 3.0, 100.0, 1e30}});
  }
  return cases;
}

constexpr Sizes kSizes = {300, 2000, 50000};
constexpr Entry kMetamorphic[] = {
    {"M1", "order of the spheres reversed", kSizes, swapped},
    {"M2", "times 2^k", kSizes, scaled_by_powers},
    {"M3", "axes reflected", kSizes, reflected},
    {"M4", "axes permuted", kSizes, axes_permuted},
    {"M5", "rotated by 90 degrees", kSizes, rotated},
    {"M6", "ids permuted", kSizes, permuted_ids},
    {"M7", "a sphere twice", kSizes, duplicated},
    {"M8", "A and B of A u B", kSizes, split},
    {"M9", "far points besides", kSizes, inert},
    {"M10", "other cells", kSizes, other_cells},
};

}  // namespace

std::span<const Entry> metamorphic() { return kMetamorphic; }

}  // namespace octocell::stress
