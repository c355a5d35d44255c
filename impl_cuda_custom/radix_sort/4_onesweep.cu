// SPDX-License-Identifier: MIT
// Variant 4: a pass reads every pair once and writes it once (Adinets & Merrill 2022, arXiv
//   2206.01784).
// Against variant 3: the digits of all passes are counted in one read at the start. Where the keys
//   of a tile go follows from the tiles below by decoupled look-back, so there is no upsweep and no
//   scan between. Digits have up to 10 bits, so 20 bits take two passes, and 17 bits two instead of
//   three. Between two passes a key is stored beside its value, so a pair is written as one 64-bit
//   word. Tiles are larger, and their size depends on how many pairs there may be.
// Why it should help: a pass costs two memory operations a pair instead of three, in one launch
//   instead of three. The widths that cell ids have need fewer passes. Runs of neighbours are twice
//   as long in memory, and half as many.
// Measured: the ladder in the report of `octocell bench-sort`, algorithm cuda_onesweep.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/cuda/cuda.cuh"
#include "impl_cuda_custom/radix_sort/digit_histograms.cuh"
#include "impl_cuda_custom/radix_sort/onesweep_tile.cuh"
#include "impl_cuda_custom/radix_sort/record_pass.cuh"

namespace octocell::cuda_custom::onesweep {
namespace {

/// Copies input that is already sorted to where the last pass would leave it.
template <typename Here>
__device__ void take_over(const Pass& pass) {
  const std::uint32_t count = pairs_to_sort(pass.count, pass.capacity);
  const std::uint32_t begin = blockIdx.x * Here::kSize;
  for (std::uint32_t i = begin + threadIdx.x; i < min(begin + Here::kSize, count);
       i += Here::kThreads) {
    pass.to.keys[i] = pass.from.keys[i];
    pass.to.values[i] = pass.from.values[i];
  }
}

/// A block may use all registers. Large tiles are fast, because they write long runs of neighbours.
/// (Both ends of a run fill only a part of a memory sector, and the time of a pass depends on how
/// many such sectors there are.) So one block fits on a multiprocessor if digits are wide;
/// otherwise two, one of which ranks while the other waits for memory.
template <int kDigitBits, int kItems, Form kFrom, Form kTo>
__global__ void __launch_bounds__(threads_of(kDigitBits), kThreadsAtOnce / threads_of(kDigitBits))
    onesweep_kernel(Pass pass) {
  using Here = Tile<kDigitBits, kItems, kFrom, kTo>;
  extern __shared__ uint4 memory[];
  if (pass.out_of_order != nullptr && *pass.out_of_order == 0) {
    if (pass.takes_over) take_over<Here>(pass);
    return;
  }
  Here tile(pass, *reinterpret_cast<typename Here::Shared*>(memory));
  if (!tile.take()) return;
  tile.load();
  tile.rank_in_warps();
  tile.rank_in_tile();
  tile.order();
  tile.look_back();
  tile.write();
}

struct Variant {
  void (*kernels[2][2])(Pass);  // by the forms of input and output
  int items;                    // per thread
  int threads;
  std::uint32_t tile_items;
  std::uint32_t owners;
  std::size_t shared_bytes;
};
template <int kDigitBits, int kItems>
constexpr Variant variant() {
  constexpr Form kArrays = Form::arrays;
  constexpr Form kPairs = Form::pairs;
  using Here = Tile<kDigitBits, kItems, kArrays, kArrays>;
  return {{{onesweep_kernel<kDigitBits, kItems, kArrays, kArrays>,
            onesweep_kernel<kDigitBits, kItems, kArrays, kPairs>},
           {onesweep_kernel<kDigitBits, kItems, kPairs, kArrays>,
            onesweep_kernel<kDigitBits, kItems, kPairs, kPairs>}},
          kItems,
          Here::kThreads,
          Here::kSize,
          Here::kOwners,
          sizeof(typename Here::Shared)};
}

/// In bits. Its 1,024 bins are two for each of 512 threads. A pass of 10 bits takes longer than one
/// of 8, but two of 10 take less time than three of 8, at every size.
constexpr int kWidest = 10;

/// By digit width, then by tile size; the largest comes last.
constexpr int kTileSizes = 4;
template <int kDigitBits>
constexpr Variant kBySize[kTileSizes] = {variant<kDigitBits, 4>(), variant<kDigitBits, 16>(),
                                         variant<kDigitBits, 32>(), variant<kDigitBits, 40>()};
const Variant* const kByWidth[] = {kBySize<6>, kBySize<8>, kBySize<kWidest>};

/// Returns the variant for the widest digit. All passes use it, so that they share the look-back
/// words.
const Variant& variant_of(const DigitPlan& plan, int tile) {
  return kByWidth[(std::max(plan.width(), 6) - 5) / 2][tile];
}

int attribute(cudaDeviceAttr which) {
  int device = 0;
  int value = 0;
  cuda::check(cudaGetDevice(&device));
  cuda::check(cudaDeviceGetAttribute(&value, which, device));
  return value;
}

/// Returns the fastest tile size that fits into shared memory. All blocks that run at once take a
/// tile each, then the next. A tile takes some time for each item of a thread, and a fixed time
/// (latencies, counters) of about 28 items.
int tile_size(std::uint32_t capacity, const DigitPlan& plan) {
  constexpr std::uint64_t kBesides = 28;
  const auto processors = static_cast<std::uint32_t>(attribute(cudaDevAttrMultiProcessorCount));
  const auto room = static_cast<std::size_t>(attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin));
  int best = 0;
  std::uint64_t best_time = ~std::uint64_t{0};
  for (int tile = 0; tile < kTileSizes; ++tile) {
    const Variant& v = variant_of(plan, tile);
    const std::uint32_t at_once = processors * (kThreadsAtOnce / v.threads);
    const std::uint64_t rounds = parts_of(parts_of(capacity, v.tile_items), at_once);
    const std::uint64_t time = rounds * (v.items + kBesides);
    if (v.shared_bytes > room || time >= best_time) continue;
    best = tile;
    best_time = time;
  }
  return best;
}

/// Requests more than 48 KiB of shared memory; this must be done once per device.
void ask_for_shared_memory(const Variant& v) {
  const auto set = [](auto* kernel, cudaFuncAttribute which, int value) {
    cuda::check(cudaFuncSetAttribute(reinterpret_cast<const void*>(kernel), which, value));
  };
  for (const auto& kernels : v.kernels) {
    for (auto* kernel : kernels) {
      set(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(v.shared_bytes));
      set(kernel, cudaFuncAttributePreferredSharedMemoryCarveout, cudaSharedmemCarveoutMaxShared);
    }
  }
}

/// The layout of the scratch memory.
struct Layout {
  std::uint32_t* starts;     // [passes][bins]
  std::uint32_t* next_tile;  // [passes]
  std::uint32_t* blocks_done;
  std::size_t zeroed;    // bytes from the start; these are the three arrays above
  std::uint64_t* words;  // [look_back::kMargin + tiles][owners]
  std::size_t bytes;
};
Layout layout_of(const Shape& shape, void* scratch) {
  const Variant& v = variant_of(shape.plan, shape.tile);
  const auto passes = static_cast<std::size_t>(shape.plan.passes);
  auto* numbers = static_cast<std::uint32_t*>(scratch);
  const std::size_t bins = passes * 2 * v.owners;
  const std::size_t numbers_used = (bins + passes + 1 + 63) / 64 * 64;
  const std::size_t zeroed = numbers_used * sizeof(std::uint32_t);
  const std::size_t tiles = parts_of(shape.capacity, v.tile_items);
  const std::size_t words = (look_back::kMargin + tiles) * v.owners;
  return {numbers,
          numbers + bins,
          numbers + bins + passes,
          zeroed,
          reinterpret_cast<std::uint64_t*>(numbers + numbers_used),
          zeroed + words * sizeof(std::uint64_t)};
}

}  // namespace

digit_histograms::HistogramsJob histograms_of(const Shape& shape, const Call& call) {
  const Variant& v = variant_of(shape.plan, shape.tile);
  const Layout there = layout_of(shape, call.scratch);
  digit_histograms::HistogramsJob job = {.keys = call.front.keys,
                                         .count = call.count,
                                         .capacity = shape.capacity,
                                         .digits = {},
                                         .bins = static_cast<int>(2 * v.owners),
                                         .starts = there.starts,
                                         .blocks_done = there.blocks_done,
                                         .words = there.words,
                                         .words_per_tile = v.owners,
                                         .tile_items = v.tile_items};
  std::copy_n(shape.plan.digits.begin(), shape.plan.passes, job.digits);
  return job;
}

Shape shape(std::uint32_t capacity, int bits) {
  Shape shape = {.capacity = capacity, .plan = digit_plan(bits, kWidest)};
  if (capacity == 0 || shape.plan.passes == 0) return shape;
  shape.tile = tile_size(capacity, shape.plan);
  ask_for_shared_memory(variant_of(shape.plan, shape.tile));
  return shape;
}

std::uint64_t scratch_bytes(const Shape& shape) { return layout_of(shape, nullptr).bytes; }

std::uint64_t zeroed_bytes(const Shape& shape) { return layout_of(shape, nullptr).zeroed; }

void launch(const Shape& shape, const Call& call) {
  cuda::check(cudaMemsetAsync(call.scratch, 0, zeroed_bytes(shape), call.stream));
  digit_histograms::launch(histograms_of(shape, call), shape.plan.passes, call.stream);
  launch_passes(shape, call);
}

void launch_passes(const Shape& shape, const Call& call) {
  const Variant& v = variant_of(shape.plan, shape.tile);
  const Layout there = layout_of(shape, call.scratch);
  const int last = shape.plan.passes - 1;
  for (int p = 0; p <= last; ++p) {
    const Pass pass = {.from = call.from(p),
                       .to = call.to(p),
                       .count = call.count,
                       .capacity = shape.capacity,
                       .out_of_order = call.out_of_order,
                       .takes_over = p == last && call.to(p).keys != call.front.keys,
                       .digit = shape.plan.digits[p],
                       .starts = there.starts + static_cast<std::size_t>(p) * 2 * v.owners,
                       .next_tile = there.next_tile + p,
                       .words = there.words + look_back::kMargin * v.owners,
                       .states = look_back::states_of(p),
                       .ones = kOnes};
    const auto kernel = v.kernels[p == 0 ? 0 : 1][p == last ? 0 : 1];  // the caller has arrays
    const std::uint32_t tiles = parts_of(shape.capacity, v.tile_items);
    kernel<<<tiles, v.threads, v.shared_bytes, call.stream>>>(pass);
    cuda::check(cudaGetLastError());
    if (call.passes != nullptr) {
      call.passes->push_back(
          copy_of_pass(pass, p == last ? Form::arrays : Form::pairs, call.stream));
    }
  }
}

}  // namespace octocell::cuda_custom::onesweep
