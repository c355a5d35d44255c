// SPDX-License-Identifier: MIT
// Stage 5 of half_shell: which spheres of adjacent cells overlap?
// Reads members, rows. Writes certain pairs, and uncertain pairs for stage 6.
// Cost: each candidate is tested twice if its sphere finds something; five rows are searched for a
//       sphere, and nine for each coarser level.
// Idea: count, scan, write, with one work item a sphere. Shell says which runs to test it against.
#include <cstdint>

#include "core/flags.hpp"
#include "impl_thrust/found_pairs.cuh"
#include "impl_thrust/half_shell/shell.cuh"

namespace octocell::on_thrust::half_shell {
namespace {

/// Tests sphere k against all spheres of its runs.
struct ShellTest {
  Shell shell;
  const Object* objects;
  const Flags* flags;  // null: every pair may collide
  PairTest test;

  template <typename OnSure, typename OnUncertain>
  OCTOCELL_HD void run(std::uint64_t k, OnSure on_sure, OnUncertain on_uncertain) const {
    const Object a = objects[k];
    const Sphere p = shell.members[k];
    shell.for_each_run(static_cast<std::uint32_t>(k), [&](IndexRange others) {
      for (std::uint32_t j = others.begin; j < others.end; ++j) {
        const Sphere q = shell.members[j];
        if (!may_overlap(test, p, q)) continue;
        const Pair pair = make_pair_of(a, objects[j]);
        if (flags != nullptr && !may_collide(flags[pair.i], flags[pair.j])) continue;
        if (is_sure(test, p, q)) {
          on_sure(pair);
        } else {
          on_uncertain(pair);
        }
      }
    });
  }
};

}  // namespace

template <typename System>
void pair_tests(Workspace<System>& w) {
  count_scan_write(w, ShellTest{shell_of(w), w.objects.data(), w.flags, w.plan.test});
}

OCTOCELL_FOR_BOTH_SYSTEMS(pair_tests);

}  // namespace octocell::on_thrust::half_shell
