// SPDX-License-Identifier: MIT
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

void Workspace::allocate() {
  const Capacities& room = plan.capacity;
  const std::uint64_t spheres = scene.spheres.size();
  for (IdArrays& side : ids) side.allocate(room.ids);
  if (plan.rule == Rule::chapter32) control_bits.allocate(spheres);
  if (plan.method == Method::half_shell) {
    ordered.allocate(spheres, is_packed(plan.test));
    rows_of_block.resize(spheres / half_shell::kIndexedPerBlock + 1);
  } else {
    cells.allocate(room.cells);
    crowded_cells.allocate(room.ids / kTileSpheres + 1);
  }
  doubts.allocate(room.doubts);
  pairs.allocate(room.pairs);
}

}  // namespace octocell::cpu
