// SPDX-License-Identifier: MIT
// H. Determinism: runs, threads, devices, compilers.
#include <cstddef>
#include <span>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

std::vector<Case> repetition(std::size_t n) {
  return {{.name = "dense", .spheres = scene("dense", n)},
          {.name = "lattice", .spheres = scene("lattice", n, "shuffle=1")},
          {.name = "cluster", .spheres = scene("cluster", n)}};
}

constexpr Entry kDeterminism[] = {
    {"H41",
     "100 runs on 1, 2, 3, 7 and all threads",
     {2000, 5000, 100000},
     repetition,
     Ask::repetition},
    {.id = "H42",
     .name = "look-back with delays, slices of a device",
     .not_run = "needs kernels with delays planted in them, and a device that is partitioned"},
    {.id = "H43",
     .name = "memcheck, racecheck, initcheck, synccheck",
     .not_run = "a tool's run and not a scene: scripts/gpu_run.sh sanitizers"},
    {.id = "H44",
     .name = "compilers and flags",
     .not_run = "a build's matrix and not a scene: make compilers"},
};

}  // namespace

std::span<const Entry> determinism() { return kDeterminism; }

}  // namespace octocell::stress
