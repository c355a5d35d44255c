// SPDX-License-Identifier: MIT
#include <cstdint>

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
  uncertain_pairs.allocate(room.uncertain_pairs);
  pairs.allocate(room.pairs);
}

HostBytes bytes_of(const Plan& plan, std::uint64_t spheres) {
  constexpr double kSidesOfIds = 2.0 * (sizeof(std::uint32_t) + sizeof(Object));
  HostBytes bytes = {.per_cell = sizeof(CellEntry), .per_pair = sizeof(Pair)};
  if (plan.method == Method::brute_force) return bytes;
  bytes.per_id = kSidesOfIds;
  double of_sphere = plan.rule == Rule::chapter32 ? sizeof(chapter32::ControlBits) : 0.0;
  if (plan.method == Method::half_shell) {
    bytes.per_cell = sizeof(ColumnRow);
    of_sphere = 4.0 * sizeof(float) + (is_packed(plan.test) ? 4.0 * sizeof(std::uint16_t) : 0.0);
    // A neighbor list has its own ids and order and three copies of the spheres; the snapshot is
    // one more.
    if (plan.moving) of_sphere += of_sphere + kSidesOfIds + 4.0 * sizeof(Sphere) + sizeof(float);
  }
  bytes.fixed = of_sphere * static_cast<double>(spheres);
  return bytes;
}

}  // namespace octocell::cpu
