// SPDX-License-Identifier: MIT
// Stage 2, cell_ids: in which cells does each sphere lie?
// Reads spheres, plan. Writes one home id a sphere, then all phantom ids; control bits.
// Cost: about 40 operations a sphere and 8 bytes an id.
// Idea: homes fill [0, n), phantoms follow. So a stable sort by cell alone leaves the homes of each
//       cell before its phantoms. Unused phantom slots are never written, so they are never sorted.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/as_written.hpp"
#include "core/grid.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"

namespace octocell::cpu {
namespace {

constexpr std::uint64_t kSpheresPerBlock = block_size(4096, 32);
constexpr std::uint64_t kSpheresPerBatch = block_size(64, 8);
constexpr std::size_t kPhantomsPerClaim = block_size(2048, 16);

/// Collects one thread's phantoms and copies them to the shared arrays, 2048 at a time.
class PhantomWriter {
 public:
  PhantomWriter(const IdArrays& out, std::atomic<std::uint64_t>& next) : out_(out), next_(next) {}
  PhantomWriter(const PhantomWriter&) = delete;
  PhantomWriter& operator=(const PhantomWriter&) = delete;
  ~PhantomWriter() { flush(); }

  void put(std::uint32_t id, Object object) {
    if (size_ == kPhantomsPerClaim) flush();
    put_if(true, id, object);
  }

  /// Appends without a branch: always writes, and advances if `valid`. Call make_room() before.
  void put_if(bool valid, std::uint32_t id, Object object) {
    cell_ids_[size_] = id;
    objects_[size_] = object;
    size_ += valid ? 1 : 0;
  }
  void make_room() {
    if (size_ + 8 > kPhantomsPerClaim) flush();
  }

  void flush() {
    const std::uint64_t at = next_.fetch_add(size_, std::memory_order_relaxed);
    if (at + size_ <= out_.objects.capacity()) {
      std::copy_n(cell_ids_, size_, out_.cell_ids.data() + at);
      std::copy_n(objects_, size_, out_.objects.data() + at);
    }
    size_ = 0;
  }

 private:
  const IdArrays& out_;
  std::atomic<std::uint64_t>& next_;
  std::size_t size_ = 0;
  std::uint32_t cell_ids_[kPhantomsPerClaim];
  Object objects_[kPhantomsPerClaim];
};

/// The cells of 64 spheres, axis by axis: plain loops that the compiler turns into vector code.
struct Batch {
  std::uint32_t lowest[3][kSpheresPerBatch];
  std::uint32_t highest[3][kSpheresPerBatch];
  std::uint32_t home[3][kSpheresPerBatch];

  template <typename ExtentOf>
  void locate(const Grid& grid, std::span<const Sphere> spheres, ExtentOf extent_of) {
    for (int a = 0; a < 3; ++a) {
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Sphere& s = spheres[i];
        const float p = a == 0 ? s.x : a == 1 ? s.y : s.z;
        const float extent = extent_of(s.r);
        lowest[a][i] = cell_coordinate(grid, a, p - extent);
        highest[a][i] = cell_coordinate(grid, a, p + extent);
        home[a][i] = cell_coordinate(grid, a, p);
      }
    }
  }

  [[nodiscard]] static Cell at(const std::uint32_t (&c)[3][kSpheresPerBatch], std::size_t i) {
    return {c[0][i], c[1][i], c[2][i]};
  }
  [[nodiscard]] CellRange range(std::size_t i) const { return {at(lowest, i), at(highest, i)}; }
  [[nodiscard]] std::uint32_t longest_span(std::size_t i) const {
    return std::max(
        {highest[0][i] - lowest[0][i], highest[1][i] - lowest[1][i], highest[2][i] - lowest[2][i]});
  }
};

/// Lists the corners of a 2 x 2 x 2 block without a branch; for at most two cells per axis.
void list_corners(const Grid& grid, std::uint32_t sphere, const CellRange& range, Cell home,
                  PhantomWriter& phantoms) {
  const auto [low, high] = range;
  const std::uint32_t x[2] = {low.x & grid.wrap_mask[0], high.x & grid.wrap_mask[0]};
  const std::uint32_t y[2] = {grid.stride_y * (low.y & grid.wrap_mask[1]),
                              grid.stride_y * (high.y & grid.wrap_mask[1])};
  const std::uint32_t z[2] = {grid.stride_z * (low.z & grid.wrap_mask[2]),
                              grid.stride_z * (high.z & grid.wrap_mask[2])};
  const std::uint32_t wide = (high.x - low.x) | (high.y - low.y) << 1 | (high.z - low.z) << 2;
  const std::uint32_t home_corner =
      (home.x - low.x) | (home.y - low.y) << 1 | (home.z - low.z) << 2;
  phantoms.make_room();
  for (std::uint32_t corner = 0; corner < 8U; ++corner) {
    const bool listed = (corner & ~wide) == 0 && corner != home_corner;
    phantoms.put_if(listed, x[corner & 1U] + y[corner >> 1 & 1U] + z[corner >> 2],
                    sphere | (~corner & 7U) << kLowestShift | kPhantom);
  }
}

/// Lists any number of cells, as for a large sphere among small cells.
void list_range(const Grid& grid, std::uint32_t sphere, const CellRange& range, Cell home,
                PhantomWriter& phantoms) {
  const auto [low, high] = range;
  for (std::uint32_t z = low.z; z <= high.z; ++z) {
    for (std::uint32_t y = low.y; y <= high.y; ++y) {
      for (std::uint32_t x = low.x; x <= high.x; ++x) {
        if (x == home.x && y == home.y && z == home.z) continue;
        const Cell cell = {x, y, z};
        phantoms.put(cell_id(grid, cell), object_of(sphere, cell, low) | kPhantom);
      }
    }
  }
}

/// Lists the home and the phantoms of one sphere of a located batch.
void list_cells(Workspace& w, const Batch& batch, std::size_t i, std::uint32_t sphere,
                PhantomWriter& phantoms) {
  const Grid& grid = w.plan.grid;
  const CellRange range = batch.range(i);
  const Cell home = Batch::at(batch.home, i);
  w.ids[0].cell_ids[sphere] = cell_id(grid, home);
  w.ids[0].objects[sphere] = object_of(sphere, home, range.lowest);
  if (batch.longest_span(i) <= 1) return list_corners(grid, sphere, range, home, phantoms);
  list_range(grid, sphere, range, home, phantoms);
}

/// Calls per_block(begin, end, phantoms) for blocks of spheres; each block has its own writer.
template <typename PerBlock>
void emit_blocks(Workspace& w, const PerBlock& per_block) {
  const std::uint64_t count = w.scene.spheres.size();
  std::atomic<std::uint64_t> next = count;
  w.threads->for_blocks(count, kSpheresPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
    PhantomWriter phantoms(w.ids[0], next);
    per_block(begin, end, phantoms);
  });
  w.id_count = next.load();
}

/// Calls per_sphere(batch, i, sphere, phantoms). The batch is located for boxes of p +-
/// extent_of(r).
template <typename ExtentOf, typename PerSphere>
void emit_batches(Workspace& w, ExtentOf extent_of, const PerSphere& per_sphere) {
  emit_blocks(w, [&](std::uint64_t begin, std::uint64_t end, PhantomWriter& phantoms) {
    Batch batch;
    for (std::uint64_t b = begin; b < end; b += kSpheresPerBatch) {
      const std::size_t size = std::min(kSpheresPerBatch, end - b);
      batch.locate(w.plan.grid, w.scene.spheres.subspan(b, size), extent_of);
      for (std::size_t i = 0; i < size; ++i) {
        per_sphere(batch, i, static_cast<std::uint32_t>(b + i), phantoms);
      }
    }
  });
}

void emit_lowest_cell(Workspace& w) {
  emit_batches(
      w, [](float r) { return r; },
      [&](const Batch& batch, std::size_t i, std::uint32_t sphere, PhantomWriter& phantoms) {
        list_cells(w, batch, i, sphere, phantoms);
      });
}

void emit_chapter32(Workspace& w) {
  std::atomic<bool> three_cells = false;
  emit_batches(
      w, chapter32::extent,
      [&](const Batch& batch, std::size_t i, std::uint32_t sphere, PhantomWriter& phantoms) {
        if (batch.longest_span(i) > 1) three_cells.store(true);
        w.control_bits[sphere] =
            chapter32::control_bits_of(batch.range(i), Batch::at(batch.home, i));
        list_cells(w, batch, i, sphere, phantoms);
      });
  if (three_cells) w.violation = chapter32::kMeetsThreeCells;
}

void emit_as_written(Workspace& w) {
  const float side = as_written::cell_side(w.plan.facts.r_max);
  emit_blocks(w, [&](std::uint64_t begin, std::uint64_t end, PhantomWriter& phantoms) {
    for (std::uint64_t i = begin; i < end; ++i) {
      const auto sphere = static_cast<std::uint32_t>(i);
      const Sphere& s = w.scene.spheres[i];
      w.ids[0].cell_ids[i] = as_written::hash(as_written::home(s, side));
      w.ids[0].objects[i] = sphere;
      as_written::for_each_phantom(s, side,
                                   [&](std::uint32_t id) { phantoms.put(id, sphere | kPhantom); });
    }
  });
}

}  // namespace

void cell_ids(Workspace& w) {
  w.current = 0;
  w.used = w.used.without(Skip::sort);  // not yet known for these ids
  w.id_count = w.scene.spheres.size();
  if (w.violation || !w.ids_complete()) return;
  if (w.plan.method == Method::half_shell) return half_shell::cell_ids(w);
  switch (w.plan.rule) {
    case Rule::lowest_cell:
      return emit_lowest_cell(w);
    case Rule::chapter32:
      return emit_chapter32(w);
    case Rule::as_written:
      return emit_as_written(w);
  }
}

}  // namespace octocell::cpu
