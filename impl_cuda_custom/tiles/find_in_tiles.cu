// SPDX-License-Identifier: MIT
// Stage 5 of method tiles, one block a tile: which spheres of the tile overlap?
// Reads the tile's records. Writes certain pairs, and uncertain pairs for stage 6; counts
//       candidates.
// Cost: 16 bytes a record, read once; then shared memory: the sort by counting, and about 15
//       operations a candidate.
// Idea: the tile is small enough for shared memory, so nothing is read at random from device
//       memory. Records are sorted by cell, with a count for each cell of the tile. A warp takes 32
//       records as rows and lists their candidates, so that every lane has one to test, however
//       they are distributed.
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "impl_cuda_custom/device.cuh"
#include "impl_cuda_custom/tiles/hit_writer.cuh"
#include "impl_cuda_custom/tiles/tile_layout.hpp"
#include "impl_cuda_custom/tiles/tiles.cuh"

namespace octocell::cuda_custom::tiles {
namespace {

struct FindJob {
  Tiles tiles;
  TileLayout layout;
  CellNumbers numbers;
  const TileRecord* records;   // [tiles][layout.room]
  const std::uint32_t* sizes;  // [tiles]
  TileTest test;
  std::uint64_t candidate_limit;
  SinkArguments sink;
};

/// A block's shared memory.
struct Tile {
  TileRecord* records;     // sorted by cell
  std::uint32_t* starts;   // two 16-bit starts a word: where each cell's records begin
  std::uint16_t* numbers;  // of each record's cell
  std::uint32_t* queue;    // of this warp
  std::uint32_t* hits;     // of this warp

  __device__ Tile(const TileLayout& layout, char* shared)
      : records(reinterpret_cast<TileRecord*>(shared)),
        starts(reinterpret_cast<std::uint32_t*>(shared + layout.starts_at())),
        numbers(reinterpret_cast<std::uint16_t*>(shared + layout.numbers_at())),
        queue(reinterpret_cast<std::uint32_t*>(shared + layout.queues_at()) + warp() * kQueued),
        hits(reinterpret_cast<std::uint32_t*>(shared + layout.hits_at()) + warp() * kHits) {}

  /// Loads 16 bytes at once: four loads of four bytes would meet in the same banks.
  [[nodiscard]] __device__ TileRecord record_at(std::uint32_t place) const {
    const float4 r = reinterpret_cast<const float4*>(records)[place];
    return {r.x, r.y, r.z, __float_as_uint(r.w)};
  }
  [[nodiscard]] __device__ std::uint32_t start_of(std::uint32_t cell) const {
    return reinterpret_cast<const std::uint16_t*>(starts)[cell];
  }
};

/// Two places of a tile in one word.
__device__ std::uint32_t packed_hit(std::uint32_t row, std::uint32_t other) {
  return row | other << 16;
}

/// The records that a thread loads, with the number of their cell and their rank in it.
struct Mine {
  TileRecord record[kRecordsPerThread];
  std::uint32_t cell_and_rank[kRecordsPerThread];
};

/// Calls visit(k) for each record of this thread.
template <typename Visit>
__device__ void for_each_mine(std::uint32_t size, Visit visit) {
#pragma unroll
  for (int k = 0; k < kRecordsPerThread; ++k) {
    if (threadIdx.x + k * kFindThreads < size) visit(k);
  }
}

__device__ TileRecord load_record(const TileRecord* records, std::uint64_t i) {
  const float4 r = __ldg(reinterpret_cast<const float4*>(records) + i);
  return {r.x, r.y, r.z, __float_as_uint(r.w)};
}

/// Loads the tile's records and counts those of each cell.
__device__ void count_cells(const FindJob& job, const Tile& tile, std::uint32_t size, Mine& mine) {
  const TileRecord* const records = job.records + std::uint64_t{blockIdx.x} * job.layout.room;
  const Cell first = first_cell_of(job.tiles, blockIdx.x);
  for (std::uint32_t w = threadIdx.x; w < job.layout.start_words(); w += kFindThreads) {
    tile.starts[w] = 0;
  }
  for_each_mine(
      size, [&](int k) { mine.record[k] = load_record(records, threadIdx.x + k * kFindThreads); });
  __syncthreads();
  for_each_mine(size, [&](int k) {
    const Cell cell = cell_in_tile(job.tiles, first, mine.record[k]);
    const std::uint32_t number = number_in_tile(job.tiles, cell);
    const std::uint32_t half = 16 * (number & 1U);
    const std::uint32_t counts = atomicAdd(&tile.starts[number / 2], 1U << half);
    mine.cell_and_rank[k] = number | (counts >> half) << 16;
  });
}

/// Turns the counts of cells into starts.
__device__ void sum_counts(const FindJob& job, const Tile& tile) {
  __shared__ std::uint32_t warp_sums[kFindWarps];
  const std::uint32_t words = job.layout.start_words();
  const std::uint32_t per_thread = parts_of(words, kFindThreads) | 1U;  // odd: no bank conflicts
  const std::uint32_t first = min(threadIdx.x * per_thread, words);
  const std::uint32_t last = min(first + per_thread, words);
  std::uint32_t sum = 0;
  for (std::uint32_t w = first; w < last; ++w) {
    sum += (tile.starts[w] & 0xffffU) + (tile.starts[w] >> 16);
  }
  std::uint32_t start = block_sums<kFindThreads>(sum, warp_sums).before;
  for (std::uint32_t w = first; w < last; ++w) {
    const std::uint32_t counts = tile.starts[w];
    const std::uint32_t second = start + (counts & 0xffffU);
    tile.starts[w] = start | second << 16;
    start = second + (counts >> 16);
  }
}

__device__ void sort_records(const Tile& tile, std::uint32_t size, const Mine& mine) {
  for_each_mine(size, [&](int k) {
    const std::uint32_t number = mine.cell_and_rank[k] & 0xffffU;
    const std::uint32_t place = tile.start_of(number) + (mine.cell_and_rank[k] >> 16);
    reinterpret_cast<uint4*>(tile.records)[place] = reinterpret_cast<const uint4&>(mine.record[k]);
    tile.numbers[place] = static_cast<std::uint16_t>(number);
  });
}

/// The candidates of one record: places [begin, begin + length) of each run.
struct Candidates {
  std::uint32_t begin[kRunsInTile];
  std::uint32_t length[kRunsInTile];
  std::uint32_t total = 0;
};

__device__ Candidates candidates_of(const FindJob& job, const Tile& tile, bool present,
                                    std::uint32_t row) {
  Candidates found;
  const Cell cell = job.numbers.cell(present ? tile.numbers[row] : 0);
#pragma unroll
  for (int r = 0; r < kRunsInTile; ++r) {
    const CellRun run = run_in_tile(job.tiles, cell, r);
    const bool any = present && run.begin != run.end;
    found.begin[r] = !any ? 0 : r == 0 ? row + 1 : tile.start_of(run.begin);
    found.length[r] = !any ? 0 : tile.start_of(run.end) - found.begin[r];
    found.total += found.length[r];
  }
  return found;
}

/// Tests one candidate per lane that is `open`. All lanes of the warp must call it.
template <typename Writer>
__device__ void test_hit(const FindJob& job, const Tile& tile, Writer& writer, bool open,
                         std::uint32_t row, std::uint32_t other) {
  const TileRecord a = tile.record_at(open ? row : 0);
  const TileRecord b = tile.record_at(open ? other : 0);
  writer.push(open && job.test.may_overlap(a, b), packed_hit(row, other));
}

/// Lists the candidates of the warp's rows in some of their runs, one behind the other, then tests
/// them. `place` is where this lane's begin in the list.
template <int kFirst, int kEnd, typename Writer>
__device__ void test_queued(const FindJob& job, const Tile& tile, Writer& writer, std::uint32_t row,
                            const Candidates& mine, std::uint32_t place, std::uint32_t total) {
#pragma unroll
  for (int r = kFirst; r < kEnd; ++r) {
    for (std::uint32_t k = 0; k < mine.length[r]; ++k) {
      tile.queue[place++] = packed_hit(row, mine.begin[r] + k);
    }
  }
  __syncwarp();
  for (std::uint32_t first = 0; first < total; first += kWarpThreads) {
    const bool open = first + lane() < total;
    const std::uint32_t candidate = open ? tile.queue[first + lane()] : 0;
    test_hit(job, tile, writer, open, candidate & 0xffffU, candidate >> 16);
  }
  __syncwarp();  // the next list uses the same memory
}

/// Where cells are crowded: all lanes test the candidates of one row after the other.
template <typename Writer>
__device__ void test_row_by_row(const FindJob& job, const Tile& tile, Writer& writer,
                                std::uint32_t row, std::uint32_t my_begin,
                                std::uint32_t my_length) {
#pragma unroll 1
  for (int of = 0; of < kWarpThreads; ++of) {
    const std::uint32_t their_row = __shfl_sync(kAllLanes, row, of);
    const std::uint32_t begin = __shfl_sync(kAllLanes, my_begin, of);
    const std::uint32_t length = __shfl_sync(kAllLanes, my_length, of);
    for (std::uint32_t first = 0; first < length; first += kWarpThreads) {
      const std::uint32_t k = first + lane();
      test_hit(job, tile, writer, k < length, their_row, begin + k);
    }
  }
}

/// Tests the candidates of the warp's rows in runs [kFirst, kEnd): from one list if they fit into
/// it, otherwise some of the runs at a time.
template <int kFirst, int kEnd, typename Writer>
__device__ void test_runs(const FindJob& job, const Tile& tile, Writer& writer, std::uint32_t row,
                          const Candidates& mine) {
  std::uint32_t my_total = 0;
#pragma unroll
  for (int r = kFirst; r < kEnd; ++r) my_total += mine.length[r];
  const std::uint32_t up_to_here = warp_inclusive_sum(my_total);
  const std::uint32_t total = __shfl_sync(kAllLanes, up_to_here, kWarpThreads - 1);
  if (total <= kQueued) {
    test_queued<kFirst, kEnd>(job, tile, writer, row, mine, up_to_here - my_total, total);
  } else if constexpr (kEnd - kFirst > 1) {
    constexpr int kMiddle = (kFirst + kEnd) / 2;
    test_runs<kFirst, kMiddle>(job, tile, writer, row, mine);
    test_runs<kMiddle, kEnd>(job, tile, writer, row, mine);
  } else {
    test_row_by_row(job, tile, writer, row, mine.begin[kFirst], mine.length[kFirst]);
  }
}

/// Tests all pairs that are the tile's. Returns how many candidates this thread's rows have.
template <typename Writer>
__device__ std::uint32_t test_rows(const FindJob& job, const Tile& tile, Writer& writer,
                                   std::uint32_t size) {
  std::uint32_t candidates = 0;
  for (std::uint32_t first = warp() * kWarpThreads; first < size; first += kFindThreads) {
    const std::uint32_t row = first + lane();
    const Candidates mine = candidates_of(job, tile, row < size, row);
    candidates += mine.total;
    test_runs<0, kRunsInTile>(job, tile, writer, row, mine);
  }
  return candidates;
}

/// Returns the number of the tile's records if the tile is to be searched, otherwise none. A tile
/// with more records than room is not searched: State says how much room is needed. The same for
/// all threads.
__device__ std::uint32_t size_to_search(const FindJob& job) {
  __shared__ std::uint32_t size_of_block;
  if (threadIdx.x == 0) {
    State* const state = job.sink.state;
    const std::uint32_t size = job.sizes[blockIdx.x];
    const bool fits = size <= job.layout.room;
    if (!fits) atomicMax(&state->tile_records, size);
    const std::uint64_t candidates = *static_cast<volatile std::uint64_t*>(&state->candidates);
    const bool may_test = state->violations == 0 && candidates <= job.candidate_limit;
    size_of_block = fits && may_test ? size : 0;
  }
  __syncthreads();
  return size_of_block;
}

__device__ void add_candidates(const FindJob& job, std::uint32_t mine) {
  __shared__ std::uint32_t warp_sums[kFindWarps];
  const Sums sums = block_sums<kFindThreads>(mine, warp_sums);
  if (threadIdx.x == 0) atomic_add(&job.sink.state->candidates, sums.total);
}

template <template <typename> typename Writer>
__global__ void __launch_bounds__(kFindThreads, Writer<TileTest>::kBlocksAtOnce)
    find_kernel(const __grid_constant__ FindJob job) {
  extern __shared__ __align__(16) char shared[];
  __shared__ typename Writer<TileTest>::Shared writers;
  const std::uint32_t size = size_to_search(job);
  if (size < 2) return;
  const Tile tile(job.layout, shared);
  {
    Mine mine;
    count_cells(job, tile, size, mine);
    __syncthreads();
    sum_counts(job, tile);
    __syncthreads();
    sort_records(tile, size, mine);
    __syncthreads();
  }
  Writer<TileTest> writer(job.test, job.sink, tile.records, tile.hits, writers);
  const std::uint32_t candidates = test_rows(job, tile, writer, size);
  add_candidates(job, candidates);
  writer.close();
}

template <template <typename> typename Writer>
void find(Workspace& w) {
  const TileLayout layout = {w.plan.capacity.tile_records, w.plan.tiles.cells_of_tile()};
  const FindJob job = {.tiles = w.plan.tiles,
                       .layout = layout,
                       .numbers = cell_numbers(w.plan.tiles),
                       .records = w.tile_records.data(),
                       .sizes = w.tile_sizes.data(),
                       .test = tile_test(w.plan),
                       .candidate_limit = w.plan.candidate_limit,
                       .sink = sink_arguments_of(w)};
  find_kernel<Writer><<<w.plan.tiles.tile_count(), kFindThreads, layout.bytes(), w.stream>>>(job);
  cuda::check_launch();
}

template <template <typename> typename Writer>
void allow_shared(std::uint32_t bytes) {
  cuda::check(cudaFuncSetAttribute(find_kernel<Writer>, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                   static_cast<int>(bytes)));
}

}  // namespace

std::uint32_t shared_bytes_of_block() {
  int device = 0;
  int bytes = 0;
  cuda::check(cudaGetDevice(&device));
  cuda::check(cudaDeviceGetAttribute(&bytes, cudaDevAttrMaxSharedMemoryPerBlockOptin, device));
  return static_cast<std::uint32_t>(bytes);
}

void prepare_find(const Workspace& w, std::uint32_t shared_bytes) {
  const TileLayout layout = {w.plan.capacity.tile_records, w.plan.tiles.cells_of_tile()};
  if (layout.bytes() + kStaticBytes > shared_bytes) {
    throw LimitError("method tiles: a tile needs " + std::to_string(layout.bytes() >> 10) +
                     " KiB of shared memory, this GPU has " + std::to_string(shared_bytes >> 10));
  }
  allow_shared<KeepHits>(shared_bytes - kStaticBytes);
  allow_shared<CountHits>(shared_bytes - kStaticBytes);
}

void prepare(const Workspace& w) {
  const std::uint32_t shared_bytes = shared_bytes_of_block();
  prepare_partition(w, shared_bytes);
  prepare_find(w, shared_bytes);
}

void find_in_tiles(Workspace& w) {
  if (!w.tiles()) return;
  if (w.plan.count_only) return find<CountHits>(w);
  find<KeepHits>(w);
}

}  // namespace octocell::cuda_custom::tiles
