// SPDX-License-Identifier: MIT
// Stage 4, cell_index: where does each cell begin, and how many homes and phantoms does it have?
// Reads sorted cell ids and objects. Writes one entry for each cell in which a pair can be tested,
//       and for each id the end of its cell.
// Cost: 20 bytes an id.
// Idea: copy_if keeps the positions where the id changes. Homes come first, so their number is
//       found by binary search. A running maximum passes each cell's end to its members.
#include <thrust/copy.h>
#include <thrust/fill.h>
#include <thrust/for_each.h>
#include <thrust/functional.h>
#include <thrust/iterator/transform_iterator.h>
#include <thrust/scan.h>
#include <thrust/transform_reduce.h>

#include <cstdint>

#include "core/pair_rule.hpp"
#include "impl_thrust/half_shell/half_shell.cuh"

namespace octocell::on_thrust {
namespace {

struct BeginsCell {
  const std::uint32_t* cell_ids;
  OCTOCELL_HD bool operator()(std::uint64_t i) const {
    return i == 0 || cell_ids[i] != cell_ids[i - 1];
  }
};

struct CellAt {
  const std::uint32_t* begins;
  std::uint64_t cell_count;
  const Object* objects;
  std::uint64_t id_count;

  OCTOCELL_HD CellEntry operator()(std::uint64_t c) const {
    const std::uint32_t begin = begins[c];
    const std::uint32_t end =
        c + 1 < cell_count ? begins[c + 1] : static_cast<std::uint32_t>(id_count);
    std::uint32_t low = begin;  // homes are below it
    std::uint32_t high = end;   // phantoms from here on
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if ((objects[middle] & kPhantom) != 0) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return {begin, low - begin, end - low};
  }
};

struct Work {
  std::uint64_t cells;
  std::uint64_t candidates;
};
struct WorkInCell {
  Rule rule;
  OCTOCELL_HD Work operator()(const CellEntry& cell) const {
    const std::uint64_t candidates = candidates_in_cell(rule, cell.homes, cell.phantoms);
    return {candidates != 0 ? std::uint64_t{1} : std::uint64_t{0}, candidates};
  }
};
struct WorkInBoth {
  OCTOCELL_HD Work operator()(const Work& a, const Work& b) const {
    return {a.cells + b.cells, a.candidates + b.candidates};
  }
};
struct HasWork {
  Rule rule;
  OCTOCELL_HD bool operator()(const CellEntry& cell) const {
    return candidates_in_cell(rule, cell.homes, cell.phantoms) != 0;
  }
};

struct WriteEnd {
  std::uint32_t* cell_end;
  OCTOCELL_HD void operator()(const CellEntry& cell) const {
    cell_end[cell.begin] = cell.begin + cell.homes + cell.phantoms;
  }
};

/// Passes ends to members. Entries of a cell that was left out get an end that is not behind them,
/// so nothing is tested.
template <typename System>
void spread_ends(Workspace<System>& w) {
  std::uint32_t* const ends = w.cell_end.data();
  const CellEntry* const cells = w.cells.data();
  thrust::fill(w.system.policy(), ends, ends + w.id_count, 0U);
  thrust::for_each(w.system.policy(), cells, cells + w.cell_count, WriteEnd{ends});
  thrust::inclusive_scan(w.system.policy(), ends, ends + w.id_count, ends,
                         thrust::maximum<std::uint32_t>{});
}

}  // namespace

template <typename System>
void cell_index(Workspace<System>& w) {
  w.cell_count = 0;
  if (w.violation || !w.ids_complete() || w.id_count == 0) return;
  if (w.half_shell()) return half_shell::cell_index(w);
  std::uint32_t* const begins = w.cell_begins.data();
  const auto all = static_cast<std::uint64_t>(thrust::copy_if(w.system.policy(), Positions(0),
                                                              Positions(w.id_count), begins,
                                                              BeginsCell{w.cell_ids.data()}) -
                                              begins);
  const auto cells = thrust::make_transform_iterator(
      Positions(0), CellAt{begins, all, w.objects.data(), w.id_count});
  const Rule rule = w.plan.rule;
  const Work work = thrust::transform_reduce(w.system.policy(), cells, cells + all,
                                             WorkInCell{rule}, Work{0, 0}, WorkInBoth{});
  w.cell_count = work.cells;
  w.candidates = work.candidates;
  if (!w.may_test_pairs()) return;
  thrust::copy_if(w.system.policy(), cells, cells + all, w.cells.data(), HasWork{rule});
  spread_ends(w);
}

OCTOCELL_FOR_BOTH_SYSTEMS(cell_index);

}  // namespace octocell::on_thrust
