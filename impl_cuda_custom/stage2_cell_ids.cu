// SPDX-License-Identifier: MIT
// Stage 2, cell_ids: in which cells does each sphere lie?
// Reads spheres, plan. Writes one home id a sphere, then all phantom ids; control bits.
// Cost: 16 bytes a sphere, 8 an id.
// Idea: homes fill [0, n). A block counts its phantoms, reserves room for all with one atomic, and
//       divides the slots of that room evenly among its threads, whichever sphere they belong to.
//       So writes lie side by side, and a sphere that meets many cells delays no other.
#include <cstdint>

#include "core/as_written.hpp"
#include "impl_cuda_custom/cell_box.cuh"
#include "impl_cuda_custom/half_shell/cell_ids.cuh"
#include "impl_cuda_custom/tiles/tiles.cuh"

namespace octocell::cuda_custom {
namespace {

/// The bits that stage 1 may have set. Other bits change while this stage runs, but the threads of
/// a block must agree on whether to continue.
constexpr std::uint32_t kFoundByBounds = kInvalidSphere | kOutsidePlan;

struct CellIdsJob {
  const Sphere* spheres;
  std::uint64_t sphere_count;
  Grid grid;
  bool scaled;      // rule chapter32: scaled extents and control bits
  float text_side;  // rule as_written
  std::uint32_t* cell_ids;
  Object* objects;
  std::uint64_t capacity;
  WideSphere* wide_spheres;
  chapter32::ControlBits* control_bits;
  State* state;

  __device__ void put(std::uint64_t place, std::uint32_t id, Object object) const {
    cell_ids[place] = id;
    objects[place] = object;
  }
  [[nodiscard]] __device__ CellRange range(const Sphere& s) const {
    return cells_met(grid, s, scaled ? chapter32::extent(s.r) : s.r);
  }
  [[nodiscard]] __device__ Cell home(const Sphere& s) const { return cell_of(grid, s.x, s.y, s.z); }
  __device__ void put_phantom(std::uint64_t place, std::uint32_t sphere, const CellBox& box,
                              std::uint32_t phantom) const {
    const Cell cell = box.phantom_cell(phantom);
    put(place, cell_id(grid, cell), object_of(sphere, cell, box.lowest) | kPhantom);
  }
};

/// The room that one block has reserved behind the homes.
struct Room {
  std::uint64_t begin;   // of the block's phantoms
  std::uint64_t before;  // phantoms of this block's threads below
  std::uint64_t total;
  bool fits;
};

__device__ Room claim_room(const CellIdsJob& job, std::uint64_t phantoms) {
  __shared__ std::uint64_t begin;
  const Scan scan = scan_over_block(phantoms);
  if (threadIdx.x == 0) begin = atomic_add(&job.state->ids, scan.total);
  __syncthreads();
  return {begin, scan.before, scan.total, begin + scan.total <= job.capacity};
}

/// Sets State::entries if all ids fit; only the last block to arrive knows.
__device__ void close_ids(const CellIdsJob& job) {
  if (threadIdx.x != 0) return;
  __threadfence();
  State* const state = job.state;
  if (atomicAdd(&state->blocks_done, 1U) != gridDim.x - 1) return;
  const std::uint64_t ids = atomic_add(&state->ids, 0);
  const std::uint32_t violations = atomicOr(&state->violations, 0U);
  if (violations == 0 && ids <= job.capacity) state->entries = ids;
}

/// Reserves room for a sphere with too many phantoms for one block; wide_spheres_kernel fills it.
__device__ void put_off(const CellIdsJob& job, std::uint32_t sphere, std::uint64_t phantoms) {
  const std::uint64_t place = atomic_add(&job.state->ids, phantoms);
  if (place + phantoms > job.capacity) return;
  const std::uint64_t number = atomic_add(&job.state->wide_spheres, 1);
  job.wide_spheres[number] = {sphere, static_cast<std::uint32_t>(place)};
}

/// Writes the home. Returns how many phantoms the block must write, and sets the box that they
/// need.
__device__ std::uint64_t put_home(const CellIdsJob& job, std::uint64_t i, CellBox& box) {
  const Sphere s = load_sphere(job.spheres, i);
  const auto sphere = static_cast<std::uint32_t>(i);
  const CellRange met = job.range(s);
  const Cell home = job.home(s);
  if (i < job.capacity) job.put(i, cell_id(job.grid, home), object_of(sphere, home, met.lowest));
  if (job.scaled) {
    job.control_bits[i] = chapter32::control_bits_of(met, home);
    if (chapter32::meets_three_cells(met)) atomicOr(&job.state->violations, kThreeCells);
  }
  box = box_of(met, home);
  const std::uint64_t phantoms = phantoms_in(met);
  if (phantoms <= kWidePhantoms) return phantoms;
  put_off(job, sphere, phantoms);
  return 0;
}

/// Returns the thread whose phantoms include number `slot` of the block's phantoms.
__device__ int owner_of(std::uint32_t slot, const std::uint32_t (&first_phantom)[kBlockThreads]) {
  int owner = 0;
#pragma unroll
  for (int step = kBlockThreads / 2; step > 0; step /= 2) {
    if (first_phantom[owner + step] <= slot) owner += step;
  }
  return owner;
}

__global__ void __launch_bounds__(kBlockThreads) cell_ids_kernel(CellIdsJob job) {
  __shared__ CellBox boxes[kBlockThreads];
  __shared__ std::uint32_t first_phantom[kBlockThreads];
  if ((job.state->violations & kFoundByBounds) != 0) return;

  const std::uint64_t first_sphere = std::uint64_t{blockIdx.x} * kBlockThreads;
  const std::uint64_t i = first_sphere + threadIdx.x;
  const std::uint64_t phantoms = i < job.sphere_count ? put_home(job, i, boxes[threadIdx.x]) : 0;
  const Room room = claim_room(job, phantoms);
  first_phantom[threadIdx.x] = static_cast<std::uint32_t>(room.before);
  __syncthreads();
  close_ids(job);
  if (!room.fits) return;
  for (auto slot = threadIdx.x; slot < room.total; slot += kBlockThreads) {
    const int owner = owner_of(slot, first_phantom);
    job.put_phantom(room.begin + slot, static_cast<std::uint32_t>(first_sphere) + owner,
                    boxes[owner], slot - first_phantom[owner]);
  }
}

/// Block (x, y) handles sphere x of the list, and every gridDim.y-th block of its phantoms.
__global__ void __launch_bounds__(kBlockThreads) wide_spheres_kernel(CellIdsJob job) {
  const std::uint64_t count = job.state->entries != 0 ? job.state->wide_spheres : 0;
  for (std::uint64_t w = blockIdx.x; w < count; w += gridDim.x) {
    const WideSphere wide = job.wide_spheres[w];
    const Sphere s = load_sphere(job.spheres, wide.sphere);
    const CellRange met = job.range(s);
    const CellBox box = box_of(met, job.home(s));
    const std::uint64_t phantoms = phantoms_in(met);
    const std::uint64_t stride = std::uint64_t{gridDim.y} * kBlockThreads;
    for (std::uint64_t p = blockIdx.y * kBlockThreads + threadIdx.x; p < phantoms; p += stride) {
      job.put_phantom(wide.place + p, wide.sphere, box, static_cast<std::uint32_t>(p));
    }
  }
}

/// Rule as_written: at most seven phantoms, found by trying 26 neighbours; a first pass counts
/// them.
__global__ void __launch_bounds__(kBlockThreads) text_cell_ids_kernel(CellIdsJob job) {
  if ((job.state->violations & kFoundByBounds) != 0) return;
  const std::uint64_t i = std::uint64_t{blockIdx.x} * kBlockThreads + threadIdx.x;
  const auto sphere = static_cast<std::uint32_t>(i);
  const bool present = i < job.sphere_count;
  const Sphere s = present ? load_sphere(job.spheres, i) : Sphere{};
  std::uint64_t phantoms = 0;
  if (present) {
    as_written::for_each_phantom(s, job.text_side, [&](std::uint32_t) { ++phantoms; });
    if (i < job.capacity) job.put(i, as_written::hash(as_written::home(s, job.text_side)), sphere);
  }
  const Room room = claim_room(job, phantoms);
  close_ids(job);
  if (!room.fits || !present) return;
  std::uint64_t place = room.begin + room.before;
  as_written::for_each_phantom(s, job.text_side,
                               [&](std::uint32_t id) { job.put(place++, id, sphere | kPhantom); });
}

CellIdsJob job_of(Workspace& w) {
  return {.spheres = w.spheres.data(),
          .sphere_count = w.sphere_count(),
          .grid = w.plan.grid,
          .scaled = w.plan.rule == Rule::chapter32,
          .text_side = as_written::cell_side(w.plan.facts.r_max),
          .cell_ids = w.side(0).keys,
          .objects = w.side(0).values,
          .capacity = w.plan.capacity.ids,
          .wide_spheres = w.wide_spheres.data(),
          .control_bits = w.control_bits.data(),
          .state = w.state.data()};
}

}  // namespace

void cell_ids(Workspace& w) {
  if (w.plan.method == Method::half_shell) return half_shell::cell_ids(w);
  if (w.plan.method == Method::tiles) return tiles::partition(w);
  if (w.sphere_count() == 0) return;
  const CellIdsJob job = job_of(w);
  const unsigned blocks = blocks_for(w.sphere_count());
  if (w.plan.rule == Rule::as_written) {
    text_cell_ids_kernel<<<blocks, kBlockThreads, 0, w.stream>>>(job);
    return cuda::check_launch();
  }
  cell_ids_kernel<<<blocks, kBlockThreads, 0, w.stream>>>(job);
  cuda::check_launch();
  const dim3 spheres_by_blocks(16, 64);
  wide_spheres_kernel<<<spheres_by_blocks, kBlockThreads, 0, w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom
