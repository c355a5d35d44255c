// SPDX-License-Identifier: MIT
// Stage 2 of half_shell: in which column does each sphere's centre lie?
// Reads spheres, levels. Writes one id a sphere.
// Cost: about ten operations a sphere, in vectors if all are of one level; 8 bytes an id.
// Idea: two spheres that overlap lie in adjacent cells, so the cell of the centre is enough: no
//       phantoms, and an eighth to a half of the ids of home_phantom.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "core/simd.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"

namespace octocell::cpu::half_shell {
namespace {

constexpr std::uint64_t kSpheresPerBlock = block_size(4096, 32);

std::uint32_t column_id(const Level& level, const Sphere& s) {
  return level.first_id + cell_id(level.grid, cell_of(level.grid, s.x, s.y, s.z));
}

constexpr std::uint32_t kAbreast = block_size(8, 4);
using Floats = Vector<float, kAbreast>;
using Doubles = Vector<double, kAbreast>;
using Ids = Vector<std::uint32_t, kAbreast>;

/// Computes cell_coordinate() of eight values by the same steps.
Ids cell_coordinates(const Grid& grid, int axis, const Floats& values) {
  using Integers = Vector<std::int32_t, kAbreast>;
  using Products = Vector<std::uint64_t, kAbreast>;
  const Floats floors = stdx::floor(values * grid.units_per_length);
  const Doubles unit = stdx::static_simd_cast<Doubles>(floors) - grid.first_unit[axis];
  const Doubles inside = stdx::clamp(unit, Doubles(0.0), Doubles(grid.last_unit[axis]));
  const auto whole = stdx::static_simd_cast<Products>(stdx::static_simd_cast<Integers>(inside));
  const CellWidth& width = grid.width[axis];
  return stdx::static_simd_cast<Ids>(whole * width.reciprocal >> width.reciprocal_bits);
}

/// Locates eight spheres at a time: compilers do not vectorise the scalar formula.
void locate(const Level& level, std::span<const Sphere> spheres, std::uint32_t* ids) {
  const Grid grid = level.grid;
  std::size_t i = 0;
  for (; i + kAbreast <= spheres.size(); i += kAbreast) {
    const Sphere* const s = &spheres[i];
    const Ids x = cell_coordinates(grid, 0, Floats([s](auto lane) { return s[lane].x; }));
    const Ids y = cell_coordinates(grid, 1, Floats([s](auto lane) { return s[lane].y; }));
    const Ids z = cell_coordinates(grid, 2, Floats([s](auto lane) { return s[lane].z; }));
    const Ids id = level.first_id + (x & grid.wrap_mask[0]) +
                   grid.stride_y * (y & grid.wrap_mask[1]) +
                   grid.stride_z * (z & grid.wrap_mask[2]);
    id.copy_to(ids + i, stdx::element_aligned);
  }
  for (; i < spheres.size(); ++i) ids[i] = column_id(level, spheres[i]);
}

void locate(const Levels& levels, std::span<const Sphere> spheres, std::uint32_t* ids) {
  if (levels.count == 1) return locate(levels.level[0], spheres, ids);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    ids[i] = column_id(levels.level[level_of(levels, spheres[i].r)], spheres[i]);
  }
}

/// Returns true if blocks that are each sorted follow one another in order.
bool blocks_are_in_order(const std::uint32_t* ids, std::uint64_t count) {
  for (std::uint64_t begin = kSpheresPerBlock; begin < count; begin += kSpheresPerBlock) {
    if (ids[begin] < ids[begin - 1]) return false;
  }
  return true;
}

}  // namespace

void cell_ids(Workspace& w) {
  const std::span<const Sphere> spheres = w.scene.spheres;
  std::uint32_t* const ids = w.ids[0].cell_ids.data();
  Object* const objects = w.ids[0].objects.data();
  std::atomic<bool> sorted = w.plan.allowed.has(Skip::sort);
  const auto per_block = [&](std::uint64_t begin, std::uint64_t end) {
    locate(w.plan.levels, spheres.subspan(begin, end - begin), ids + begin);
    std::iota(objects + begin, objects + end, static_cast<Object>(begin));
    if (sorted.load(std::memory_order_relaxed) && !std::is_sorted(ids + begin, ids + end)) {
      sorted.store(false, std::memory_order_relaxed);
    }
  };
  w.threads->for_blocks(spheres.size(), kSpheresPerBlock, per_block);
  if (sorted && blocks_are_in_order(ids, spheres.size())) w.used = w.used.with(Skip::sort);
}

}  // namespace octocell::cpu::half_shell
