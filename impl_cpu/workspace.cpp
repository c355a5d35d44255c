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
    const half_shell::IndexBlocks blocks(spheres, plan.levels);
    ordered.allocate(spheres, plan.test, blocks.count * blocks.rows_of_each);
    rows_of_block.resize(blocks.count);
  } else {
    cells.allocate(room.cells);
    crowded_cells.allocate(room.ids / kTileSpheres + 1);
  }
  doubts.allocate(room.doubts);
  pairs.allocate(room.pairs);
}

}  // namespace octocell::cpu
