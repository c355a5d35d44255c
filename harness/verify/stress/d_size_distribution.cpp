// SPDX-License-Identifier: MIT
// D. Distributions of size: giants among dust, and everything in between.
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

std::vector<Case> one_giant(std::size_t n) {
  return {{.name = "r = 2^20", .spheres = joined(scene("gas", n), {{0, 0, 0, 0x1p20F}})},
          {.name = "r = 30", .spheres = joined(scene("gas", n), {{3, 3, 3, 30.0F}})}};
}

std::vector<Case> six_decades(std::size_t n) {
  return {{.name = "log-uniform", .spheres = scene("poly", n, "ratio=1e6")},
          {.name = "flat", .spheres = scene("discs", n, "ratio=1e6")}};
}

std::vector<Case> planes(std::size_t n) {
  constexpr float kFar = kFloatMax / 4;
  const Spheres dust = scene("gas", n);
  return {{.name = "below", .spheres = joined(dust, {{0, 0, -kFar, kFar}})},
          {.name = "six sides",
           .spheres = joined(dust, {{0, 0, -kFar, kFar},
                                    {0, 0, kFar, kFar},
                                    {0, -kFar, 0, kFar},
                                    {0, kFar, 0, kFar},
                                    {-kFar, 0, 0, kFar},
                                    {kFar, 0, 0, kFar}})}};
}

std::vector<Case> one_different(std::size_t n) {
  std::vector<Case> cases = {{.name = "all equal", .spheres = scene("dense", n)}};
  for (const float r : {0.0F, 0x1p-149F, nudged(0.5F, -1), nudged(0.5F, 1), 5.0F}) {
    Case other = {.name = "one of " + std::to_string(r), .spheres = cases[0].spheres};
    other.spheres[n / 2].r = r;
    cases.push_back(std::move(other));
  }
  return cases;
}

constexpr Entry kSizeDistribution[] = {
    {"D21", "one huge sphere among small ones", {500, 5000, 300000}, one_giant},
    {"D22", "radii over six decades", {500, 5000, 300000}, six_decades},
    {"D23", "spheres of FLT_MAX / 4 as planes", {300, 3000, 100000}, planes},
    {"D24", "equal radii, and one that differs", {500, 5000, 300000}, one_different},
};

}  // namespace

std::span<const Entry> size_distribution() { return kSizeDistribution; }

}  // namespace octocell::stress
