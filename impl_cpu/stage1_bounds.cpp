// SPDX-License-Identifier: MIT
// Stage 1, bounds: are the plan's assumptions about the scene still true?
// Reads spheres. Writes a violation, or nothing.
// Cost: one pass, 16 bytes a sphere.
// Idea: the plan's proofs rest on a few facts; one reduction over the spheres checks them all.
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>

#include "core/flags.hpp"
#include "core/plan_facts.hpp"
#include "core/planner/scene_stats.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {
namespace {

constexpr std::uint64_t kBlock = block_size(1 << 16, 16);

/// Leaves the results that the stages would have left if they ran.
void leave_nothing(Workspace& w) {
  w.id_count = 0;
  w.cells.clear();
  w.ordered.row_count = 0;
  w.uncertain_pairs.clear();
  w.pairs.clear(w.plan.count_only);
  if (some_may_collide(w.scene.flags)) w.violation = kFlagsBroken;
}

}  // namespace

void bounds(Workspace& w) {
  w.forget_last_run();
  if (w.plan.nothing_to_find) leave_nothing(w);
  const std::span<const Sphere> spheres = w.scene.spheres;
  if (spheres.empty()) return;

  std::mutex merging;
  std::optional<FactsPass> seen;
  const double lattice = w.plan.facts.lattice_units_per_length;
  bool on_lattice = true;
  w.threads->for_blocks(spheres.size(), kBlock, [&](std::uint64_t begin, std::uint64_t end) {
    const std::span<const Sphere> block = spheres.subspan(begin, end - begin);
    const FactsPass part = measure_facts(block);
    const bool part_on_lattice = lattice == 0.0 || lie_on_lattice(block, lattice);
    const std::scoped_lock lock(merging);
    seen = seen ? merge(*seen, part) : part;
    on_lattice = on_lattice && part_on_lattice;
  });
  w.facts = seen->facts;
  if (!seen->valid) {
    w.violation = describe_first_invalid(spheres);
  } else if (!on_lattice || !are_within(w.facts, w.plan.facts)) {
    w.violation = kFactsBroken;
  }
}

}  // namespace octocell::cpu
