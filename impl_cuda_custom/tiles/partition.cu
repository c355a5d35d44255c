// SPDX-License-Identifier: MIT
// Stages 1 and 2 of method tiles, in one pass: are the plan's assumptions true, and in which tiles
// does each sphere lie?
// Reads spheres. Writes records into tiles; how many each tile has; a violation, or nothing.
// Cost: 16 bytes a sphere read, and 16 written for each sphere and each copy.
// Idea: a block takes a chunk of spheres and counts how many go to each tile. It reserves room in
//       each tile with one atomic, puts the records in order of their tiles in shared memory, and
//       writes them from there: what goes to the same tile lies side by side.
#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "impl_cuda_custom/device.cuh"
#include "impl_cuda_custom/tiles/tile_layout.hpp"
#include "impl_cuda_custom/tiles/tiles.cuh"

namespace octocell::cuda_custom::tiles {
namespace {

struct PartitionJob {
  const Sphere* spheres;
  std::uint32_t sphere_count;
  std::uint32_t chunk;  // spheres that a block takes at a time; at most kMostChunk
  PlanFacts facts;
  Tiles tiles;
  PartitionLayout layout;
  TileRecord* records;  // [tiles][room]
  std::uint32_t room;
  std::uint32_t* sizes;  // [tiles] continue to count past the end of a tile's room
  State* state;
};

/// A block's shared memory.
struct Staging {
  TileRecord* records;     // in the order of their tiles
  std::uint16_t* tile_of;  // of each staged record
  std::uint32_t* places;   // of each tile: a count, then the next place among the staged records
  std::uint32_t* shifts;   // of each tile: from such a place to one in job.records

  __device__ Staging(const PartitionLayout& layout, char* shared)
      : records(reinterpret_cast<TileRecord*>(shared)),
        tile_of(reinterpret_cast<std::uint16_t*>(shared + layout.tile_numbers_at())),
        places(reinterpret_cast<std::uint32_t*>(shared + layout.tile_words_at())),
        shifts(places + layout.tiles) {}
};

/// The tiles of the spheres that a thread has of a chunk.
struct Mine {
  std::uint32_t met[kSpheresPerThread];  // TilesMet in one word, or kNone
};
constexpr std::uint32_t kNone = ~0U;
static_assert(kMostTiles < 1U << 29);

__device__ std::uint32_t packed(TilesMet met) { return met.own << 3 | met.before; }
__device__ TilesMet unpacked(std::uint32_t word) { return {word >> 3, word & 7U}; }

/// Calls visit(k, i) for each sphere i of this thread.
template <typename Visit>
__device__ void for_each_sphere(std::uint32_t begin, std::uint32_t end, Visit visit) {
#pragma unroll
  for (int k = 0; k < kSpheresPerThread; ++k) {
    const std::uint32_t i = begin + threadIdx.x + k * kPartitionThreads;
    if (i < end) visit(k, i);
  }
}

/// Counts the chunk's records of each tile. Returns what is wrong with this thread's spheres; those
/// belong to no tile.
__device__ std::uint32_t count_records(const PartitionJob& job, const Staging& staging,
                                       std::uint32_t begin, std::uint32_t end, Mine& mine) {
  Sphere spheres[kSpheresPerThread];
  std::uint32_t violations = 0;
  for_each_sphere(begin, end,
                  [&](int k, std::uint32_t i) { spheres[k] = load_sphere(job.spheres, i); });
  for_each_sphere(begin, end, [&](int k, std::uint32_t) {
    const Sphere& s = spheres[k];
    const std::uint32_t wrong = violation_of(s, job.facts);
    violations |= wrong;
    mine.met[k] = kNone;
    if (wrong != 0) return;
    const TilesMet met = tiles_met(job.tiles, cell_of(job.tiles.grid, s.x, s.y, s.z));
    mine.met[k] = packed(met);
    for_each_tile(job.tiles, met,
                  [&](std::uint32_t tile) { atomicAdd(&staging.places[tile], 1U); });
  });
  return violations;
}

/// Reserves room in all tiles. Turns counts into places. Returns the number of the chunk's records.
__device__ std::uint32_t claim_room(const PartitionJob& job, const Staging& staging) {
  __shared__ std::uint32_t warp_sums[kPartitionThreads / kWarpThreads];
  const std::uint32_t tiles = job.layout.tiles;
  const std::uint32_t per_thread = parts_of(tiles, kPartitionThreads);
  const std::uint32_t first = min(threadIdx.x * per_thread, tiles);
  const std::uint32_t last = min(first + per_thread, tiles);
  std::uint32_t mine = 0;
  for (std::uint32_t tile = first; tile < last; ++tile) mine += staging.places[tile];
  const Sums sums = block_sums<kPartitionThreads>(mine, warp_sums);
  std::uint32_t place = sums.before;
#pragma unroll 4
  for (std::uint32_t tile = first; tile < last; ++tile) {
    const std::uint32_t count = staging.places[tile];
    const std::uint32_t in_tile = count != 0 ? atomicAdd(&job.sizes[tile], count) : 0;
    staging.places[tile] = place;
    staging.shifts[tile] = tile * job.room + in_tile - place;
    place += count;
  }
  return sums.total;
}

/// Writes a record to its place, unless the tile is full.
__device__ void write(const PartitionJob& job, const Staging& staging, std::uint32_t tile,
                      std::uint32_t place, const TileRecord& record) {
  const std::uint32_t to = place + staging.shifts[tile];
  if (to - tile * job.room < job.room) {
    reinterpret_cast<uint4*>(job.records)[to] = reinterpret_cast<const uint4&>(record);
  }
}

/// Puts the records in order of their tiles. A record for which there is no room is written at
/// once. Reads the spheres a second time, from the cache: registers are scarce.
__device__ void stage_records(const PartitionJob& job, const Staging& staging, std::uint32_t begin,
                              std::uint32_t end, const Mine& mine) {
  for_each_sphere(begin, end, [&](int k, std::uint32_t i) {
    if (mine.met[k] == kNone) return;
    const Sphere s = load_sphere(job.spheres, i);
    const TileRecord record = {s.x, s.y, s.z, i};
    for_each_tile(job.tiles, unpacked(mine.met[k]), [&](std::uint32_t tile) {
      const std::uint32_t place = atomicAdd(&staging.places[tile], 1U);
      if (place < job.layout.staged) {
        reinterpret_cast<uint4*>(staging.records)[place] = reinterpret_cast<const uint4&>(record);
        staging.tile_of[place] = static_cast<std::uint16_t>(tile);
      } else {
        write(job, staging, tile, place, record);
      }
    });
  });
}

__device__ void write_staged(const PartitionJob& job, const Staging& staging, std::uint32_t count) {
  for (std::uint32_t place = threadIdx.x; place < count; place += kPartitionThreads) {
    write(job, staging, staging.tile_of[place], place, staging.records[place]);
  }
}

__global__ void __launch_bounds__(kPartitionThreads, 1)
    partition_kernel(const __grid_constant__ PartitionJob job) {
  extern __shared__ __align__(16) char shared[];
  const Staging staging(job.layout, shared);
  std::uint32_t violations = 0;
  for (std::uint32_t begin = blockIdx.x * job.chunk; begin < job.sphere_count;
       begin += gridDim.x * job.chunk) {
    const std::uint32_t end = min(begin + job.chunk, job.sphere_count);
    for (std::uint32_t tile = threadIdx.x; tile < job.layout.tiles; tile += kPartitionThreads) {
      staging.places[tile] = 0;
    }
    __syncthreads();
    Mine mine;
    violations |= count_records(job, staging, begin, end, mine);
    __syncthreads();
    const std::uint32_t records = claim_room(job, staging);
    __syncthreads();
    stage_records(job, staging, begin, end, mine);
    __syncthreads();
    write_staged(job, staging, min(records, job.layout.staged));
    __syncthreads();  // the next chunk uses the same memory
  }
  if (violations != 0) atomicOr(&job.state->violations, violations);
}

std::uint32_t multiprocessors() {
  int device = 0;
  int count = 0;
  cuda::check(cudaGetDevice(&device));
  cuda::check(cudaDeviceGetAttribute(&count, cudaDevAttrMultiProcessorCount, device));
  return static_cast<std::uint32_t>(count);
}

/// How the spheres are divided among blocks: evenly, in as few rounds as there can be.
struct Division {
  std::uint32_t blocks;
  std::uint32_t chunk;
};
Division division_of(std::uint32_t spheres) {
  constexpr std::uint32_t kLeastChunk = 256;  // a smaller one is not worth a block
  const std::uint32_t blocks = multiprocessors();
  const std::uint32_t rounds = parts_of(parts_of(spheres, kMostChunk), blocks);
  const std::uint32_t chunk = std::max(parts_of(spheres, blocks * rounds), kLeastChunk);
  return {std::min(blocks, parts_of(spheres, chunk)), chunk};
}

}  // namespace

void prepare_partition(const Workspace& w, std::uint32_t shared_bytes) {
  const PartitionLayout smallest = {w.plan.tiles.tile_count(), 0};
  if (smallest.bytes() + kStaticBytes > shared_bytes) {
    throw LimitError("method tiles: this GPU has too little shared memory for " +
                     std::to_string(smallest.tiles) + " tiles");
  }
  cuda::check(cudaFuncSetAttribute(partition_kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                   static_cast<int>(shared_bytes - kStaticBytes)));
}

void partition(Workspace& w) {
  if (!w.tiles()) return;
  const auto spheres = static_cast<std::uint32_t>(w.sphere_count());
  const Division division = division_of(spheres);
  const PartitionJob job = {.spheres = w.spheres.data(),
                            .sphere_count = spheres,
                            .chunk = division.chunk,
                            .facts = w.plan.facts,
                            .tiles = w.plan.tiles,
                            .layout = partition_layout(w.plan.tiles.tile_count(), division.chunk,
                                                       shared_bytes_of_block()),
                            .records = w.tile_records.data(),
                            .room = w.plan.capacity.tile_records,
                            .sizes = w.tile_sizes.data(),
                            .state = w.state.data()};
  partition_kernel<<<division.blocks, kPartitionThreads, job.layout.bytes(), w.stream>>>(job);
  cuda::check_launch();
}

}  // namespace octocell::cuda_custom::tiles
