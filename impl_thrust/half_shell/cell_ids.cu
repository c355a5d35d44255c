// SPDX-License-Identifier: MIT
// Stage 2 of half_shell: in which column does each sphere's centre lie?
// Reads spheres, levels. Writes one id a sphere.
// Cost: 8 bytes an id, one cell a sphere.
// Idea: two spheres that overlap lie in adjacent cells, so the cell of the centre is enough: there
//       is nothing to count and nothing to scan.
#include <thrust/sequence.h>
#include <thrust/transform.h>

#include <cstdint>

#include "impl_thrust/half_shell/half_shell.cuh"

namespace octocell::on_thrust::half_shell {
namespace {

struct ColumnOf {
  const Levels* levels;
  OCTOCELL_HD std::uint32_t operator()(const Sphere& s) const {
    const Level& level = levels->level[level_of(*levels, s.r)];
    return level.first_id + cell_id(level.grid, cell_of(level.grid, s.x, s.y, s.z));
  }
};

}  // namespace

template <typename System>
void cell_ids(Workspace<System>& w) {
  if (!w.ids_complete()) return;
  const std::uint64_t count = w.sphere_count();
  thrust::transform(w.system.policy(), w.spheres, w.spheres + count, w.cell_ids.data(),
                    ColumnOf{w.levels});
  thrust::sequence(w.system.policy(), w.objects.data(), w.objects.data() + count);
}

OCTOCELL_FOR_BOTH_SYSTEMS(cell_ids);

}  // namespace octocell::on_thrust::half_shell
