// SPDX-License-Identifier: MIT
// Stage 2, cell_ids: in which cells does each sphere lie?
// Reads spheres, plan. Writes one home id a sphere, then all phantom ids; control bits.
// Cost: the cells of a sphere are computed twice, and 8 bytes an id.
// Idea: count, scan, write. Each sphere counts its phantoms, a scan finds their places behind the
//       homes, and a second pass writes them there. So there are no atomics, and the order is
//       always the same.
#include <thrust/for_each.h>
#include <thrust/logical.h>
#include <thrust/scan.h>
#include <thrust/transform.h>

#include <cstdint>

#include "core/as_written.hpp"
#include "core/grid.hpp"
#include "impl_thrust/half_shell/half_shell.cuh"

namespace octocell::on_thrust {
namespace {

/// Rules lowest_cell and chapter32: the cells that the box p +- extent meets.
struct GridCells {
  Grid grid;
  bool scaled;  // extent is chapter32's, not r

  [[nodiscard]] OCTOCELL_HD CellRange range(const Sphere& s) const {
    return cells_met(grid, s, scaled ? chapter32::extent(s.r) : s.r);
  }
  [[nodiscard]] OCTOCELL_HD Cell home(const Sphere& s) const {
    return cell_of(grid, s.x, s.y, s.z);
  }
  [[nodiscard]] OCTOCELL_HD std::uint64_t phantom_count(const Sphere& s) const {
    return phantoms_in(range(s));
  }
  /// Calls put_home(id, object), then put_phantom(id, object) for each phantom.
  template <typename PutHome, typename PutPhantom>
  OCTOCELL_HD void list(const Sphere& s, std::uint32_t sphere, PutHome put_home,
                        PutPhantom put_phantom) const {
    const CellRange met = range(s);
    const Cell centre = home(s);
    put_home(cell_id(grid, centre), object_of(sphere, centre, met.lowest));
    for (std::uint32_t z = met.lowest.z; z <= met.highest.z; ++z) {
      for (std::uint32_t y = met.lowest.y; y <= met.highest.y; ++y) {
        for (std::uint32_t x = met.lowest.x; x <= met.highest.x; ++x) {
          if (x == centre.x && y == centre.y && z == centre.z) continue;
          const Cell cell = {x, y, z};
          put_phantom(cell_id(grid, cell), object_of(sphere, cell, met.lowest) | kPhantom);
        }
      }
    }
  }
};

/// Rule as_written has its own grid.
struct TextCells {
  float side;

  [[nodiscard]] OCTOCELL_HD std::uint64_t phantom_count(const Sphere& s) const {
    std::uint64_t count = 0;
    as_written::for_each_phantom(s, side, [&count](std::uint32_t) { ++count; });
    return count;
  }
  template <typename PutHome, typename PutPhantom>
  OCTOCELL_HD void list(const Sphere& s, std::uint32_t sphere, PutHome put_home,
                        PutPhantom put_phantom) const {
    put_home(as_written::hash(as_written::home(s, side)), sphere);
    as_written::for_each_phantom(s, side,
                                 [&](std::uint32_t id) { put_phantom(id, sphere | kPhantom); });
  }
};

template <typename Cells>
struct CountPhantoms {
  Cells cells;
  const Sphere* spheres;
  std::uint64_t sphere_count;
  OCTOCELL_HD std::uint64_t operator()(std::uint64_t i) const {
    return i < sphere_count ? cells.phantom_count(spheres[i]) : 0;  // the scan puts their sum into
                                                                    // the last one
  }
};

template <typename Cells>
struct WriteCells {
  Cells cells;
  const Sphere* spheres;
  std::uint64_t sphere_count;
  const std::uint64_t* phantoms_before;
  std::uint32_t* cell_ids;
  Object* objects;

  OCTOCELL_HD void put(std::uint64_t at, std::uint32_t id, Object object) const {
    cell_ids[at] = id;
    objects[at] = object;
  }
  OCTOCELL_HD void operator()(std::uint64_t i) const {
    std::uint64_t next = sphere_count + phantoms_before[i];
    cells.list(
        spheres[i], static_cast<std::uint32_t>(i),
        [&](std::uint32_t id, Object object) { put(i, id, object); },
        [&](std::uint32_t id, Object object) { put(next++, id, object); });
  }
};

template <typename System, typename Cells>
void list_cells(Workspace<System>& w, const Cells& cells) {
  const std::uint64_t count = w.sphere_count();
  std::uint64_t* const before = w.phantoms_before.data();
  thrust::transform(w.system.policy(), Positions(0), Positions(count + 1), before,
                    CountPhantoms<Cells>{cells, w.spheres, count});
  thrust::exclusive_scan(w.system.policy(), before, before + count + 1, before);
  w.id_count = count + w.system.read(before + count);
  if (!w.ids_complete()) return;
  thrust::for_each_n(
      w.system.policy(), Positions(0), count,
      WriteCells<Cells>{cells, w.spheres, count, before, w.cell_ids.data(), w.objects.data()});
}

struct MeetsThreeCells {
  GridCells cells;
  OCTOCELL_HD bool operator()(const Sphere& s) const {
    return chapter32::meets_three_cells(cells.range(s));
  }
};

struct ControlBitsOf {
  GridCells cells;
  OCTOCELL_HD chapter32::ControlBits operator()(const Sphere& s) const {
    return chapter32::control_bits_of(cells.range(s), cells.home(s));
  }
};

template <typename System>
void list_chapter32(Workspace<System>& w) {
  const GridCells cells = {w.plan.grid, true};
  const Sphere* const end = w.spheres + w.sphere_count();
  if (thrust::any_of(w.system.policy(), w.spheres, end, MeetsThreeCells{cells})) {
    w.violation = chapter32::kMeetsThreeCells;
    return;
  }
  thrust::transform(w.system.policy(), w.spheres, end, w.control_bits.data(), ControlBitsOf{cells});
  list_cells(w, cells);
}

}  // namespace

template <typename System>
void cell_ids(Workspace<System>& w) {
  w.id_count = w.sphere_count();
  if (w.violation || w.sphere_count() == 0) return;
  if (w.half_shell()) return half_shell::cell_ids(w);
  switch (w.plan.rule) {
    case Rule::lowest_cell:
      return list_cells(w, GridCells{w.plan.grid, false});
    case Rule::chapter32:
      return list_chapter32(w);
    case Rule::as_written:
      return list_cells(w, TextCells{as_written::cell_side(w.plan.facts.r_max)});
  }
}

OCTOCELL_FOR_BOTH_SYSTEMS(cell_ids);

}  // namespace octocell::on_thrust
