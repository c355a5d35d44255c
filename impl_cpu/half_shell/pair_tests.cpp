// SPDX-License-Identifier: MIT
// Stage 5 of half_shell: which spheres of adjacent cells overlap?
// Reads ordered spheres, rows. Writes certain pairs, and uncertain pairs for stage 6.
// Cost: about one vector operation for each sphere of a row, and one more for each that is near its
//       border with one of four other rows (one in a flat scene, none on a line).
// Idea: rows are several diameters wide, so few spheres are near a border; only these are listed
//       and tested across it. Consecutive spheres are in the lanes. Spheres that may be near one of
//       them are tested one after another, and no branch depends on where they lie.
#include <atomic>
#include <cstdint>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/half_shell/level_boxes.hpp"
#include "impl_cpu/half_shell/other_rows.hpp"
#include "impl_cpu/half_shell/same_level.hpp"

namespace octocell::cpu::half_shell {
namespace {

constexpr std::uint64_t kOthersPerBlock = block_size(4096, 16);
constexpr std::uint64_t kBoxesPerBlock = block_size(16, 4);

/// Calls work(begin, end) for blocks of the spheres; it returns the number of its candidates.
/// Starts no more blocks once there are too many candidates.
template <typename Work>
void for_spheres(Workspace& w, IndexRange spheres, std::uint64_t block,
                 std::atomic<std::uint64_t>& candidates, const Work& work) {
  w.threads->for_blocks(
      spheres.end - spheres.begin, block, [&](std::uint64_t begin, std::uint64_t end) {
        if (candidates.load(std::memory_order_relaxed) > w.plan.candidate_limit) return;
        candidates.fetch_add(work(spheres.begin + static_cast<std::uint32_t>(begin),
                                  spheres.begin + static_cast<std::uint32_t>(end)),
                             std::memory_order_relaxed);
      });
}

IndexRange spheres_of(const OrderedSpheres& o, int level) {
  return {o.rows[o.level_rows[level]].begin, o.rows[o.level_rows[level + 1]].begin};
}

/// Tests those of `others` that are of one level against the spheres of another level.
template <PairTest test>
void test_boxes(Workspace& w, const OrderedSpheres& spheres, int level,
                const OrderedSpheres& others, int level_of_others,
                std::atomic<std::uint64_t>& candidates) {
  for_spheres(w, spheres_of(others, level_of_others), kBoxesPerBlock, candidates,
              [&](std::uint32_t begin, std::uint32_t end) {
                LevelBoxes<test> tester(w, spheres, others, level);
                for (std::uint32_t s = begin; s < end; ++s) tester.test_box(s);
                return tester.candidates();
              });
}

template <PairTest test>
std::uint64_t test_all(Workspace& w, const OrderedSpheres& spheres) {
  std::atomic<std::uint64_t> candidates = 0;
  for (int level = 0; level < w.plan.levels.count; ++level) {
    for_spheres(w, spheres_of(spheres, level), SameLevel<test>::kMostSwept, candidates,
                [&](std::uint32_t begin, std::uint32_t end) {
                  SameLevel<test> tester(w, spheres, level);
                  tester.sweep(begin, end);
                  return tester.candidates();
                });
    for (int coarser = level + 1; coarser < w.plan.levels.count; ++coarser) {
      test_boxes<test>(w, spheres, level, spheres, coarser, candidates);
    }
  }
  return candidates.load();
}

template <PairTest test>
std::uint64_t test_against(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others) {
  std::atomic<std::uint64_t> candidates = 0;
  for (int level = 0; level < w.plan.levels.count; ++level) {
    for_spheres(w, spheres_of(others, level), kOthersPerBlock, candidates,
                [&](std::uint32_t begin, std::uint32_t end) {
                  OtherRows<test> tester(w, spheres, others, level);
                  tester.sweep(begin, end);
                  return tester.candidates();
                });
    for (int other = 0; other < w.plan.levels.count; ++other) {
      if (other != level) test_boxes<test>(w, spheres, level, others, other, candidates);
    }
  }
  return candidates.load();
}

}  // namespace

void pair_tests(Workspace& w) {
  if (w.id_count == 0) return;
  w.candidates = test_among(w, w.ordered);
}

std::uint64_t test_among(Workspace& w, const OrderedSpheres& spheres) {
  return with_pair_test(w.plan.test, [&]<PairTest test>() { return test_all<test>(w, spheres); });
}

std::uint64_t test_between(Workspace& w, const OrderedSpheres& spheres,
                           const OrderedSpheres& others) {
  return with_filter_test(w.plan.test,
                          [&]<PairTest test>() { return test_against<test>(w, spheres, others); });
}

}  // namespace octocell::cpu::half_shell
