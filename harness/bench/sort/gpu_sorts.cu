// SPDX-License-Identifier: MIT
#include "harness/bench/sort/gpu_sorts.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "baselines/cub/radix_sort.cuh"
#include "core/cuda/cuda.cuh"
#include "harness/bench/sort/gpu_sort_check.cuh"
#include "impl_cuda_custom/radix_sort/radix_sort.cuh"

namespace octocell::bench {
namespace {

using cuda::check;
using cuda::DeviceArray;
using cuda_custom::Variant;

constexpr Variant kVariants[] = {Variant::one_bit_split, Variant::digit_passes,
                                 Variant::reduce_then_scan, Variant::onesweep};

class Stream {
 public:
  Stream() { check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking)); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() { cudaStreamDestroy(stream_); }
  operator cudaStream_t() const { return stream_; }

 private:
  cudaStream_t stream_ = nullptr;
};

/// Keeps the GPU busy until the host has queued the work that is timed. So the time is that of the
/// GPU, not of the host's calls.
constexpr long long kHoldCycles = 600'000;  // about 0.3 ms
__global__ void hold_kernel() {
  const long long begin = clock64();
  while (clock64() - begin < kHoldCycles) continue;
}

/// The memory of one side, and the arrays in it.
struct Columns {
  explicit Columns(std::uint64_t n) {
    memory.allocate(cuda_custom::words_of_side(n));
    arrays = cuda_custom::arrays_in(memory.data(), n);
  }
  DeviceArray<std::uint32_t> memory;
  cuda_custom::KeysAndValues arrays;
};

void copy_to(std::uint32_t* to, const std::uint32_t* from, std::uint64_t n, cudaStream_t stream) {
  check(cudaMemcpyAsync(to, from, n * sizeof(*to), cudaMemcpyDefault, stream));
}

class Case final : public GpuSortCase {
 public:
  Case(const std::vector<std::uint32_t>& keys, int bits)
      : n_(keys.size()), bits_(bits), input_(n_), front_(n_), back_(n_) {
    std::vector<std::uint32_t> values(n_);
    std::iota(values.begin(), values.end(), 0U);
    copy_to(input_.arrays.keys, keys.data(), n_, stream_);
    copy_to(input_.arrays.values, values.data(), n_, stream_);
    count_.allocate(1);
    faults_.allocate(1);
    check(cudaMemcpyAsync(count_.data(), &n_, sizeof(n_), cudaMemcpyDefault, stream_));
    check(cudaStreamSynchronize(stream_));
  }

  GpuRun run(std::size_t algorithm) override {
    return algorithm < std::size(kVariants) ? run_variant(kVariants[algorithm]) : run_cub();
  }

 private:
  GpuRun run_variant(Variant variant) {
    const cuda_custom::RadixSort sort(variant, n_, bits_);
    scratch_.allocate(sort.scratch_bytes());
    return timed([&] {
      sort.launch(front_.arrays, back_.arrays, count_.data(), scratch_.data(), stream_);
      return sort.result_side();
    });
  }

  GpuRun run_cub() {
    const cub_baseline::RadixSort sort(n_, bits_);
    scratch_.allocate(sort.scratch_bytes());
    return timed([&] {
      return sort.launch({front_.arrays.keys, front_.arrays.values},
                         {back_.arrays.keys, back_.arrays.values}, scratch_.data(), stream_);
    });
  }

  template <typename Sort>
  GpuRun timed(const Sort& sort) {
    copy_to(front_.arrays.keys, input_.arrays.keys, n_, stream_);
    copy_to(front_.arrays.values, input_.arrays.values, n_, stream_);
    hold_kernel<<<1, 1, 0, stream_>>>();
    check(cudaGetLastError());
    begin_.record(stream_);
    const int side = sort();
    end_.record(stream_);
    end_.wait();
    const double ms = end_.milliseconds_since(begin_);
    return {ms, fault_of(side == 0 ? front_ : back_)};
  }

  std::optional<std::string> fault_of(const Columns& sorted) {
    SortFaults found;
    check(cudaMemsetAsync(faults_.data(), 0, sizeof(found), stream_));
    const auto blocks = static_cast<unsigned>((n_ + 255) / 256);
    find_sort_faults_kernel<<<blocks, 256, 0, stream_>>>(
        input_.arrays.keys, sorted.arrays.keys, sorted.arrays.values,
        static_cast<std::uint32_t>(n_), faults_.data());
    check(cudaGetLastError());
    check(cudaMemcpyAsync(&found, faults_.data(), sizeof(found), cudaMemcpyDefault, stream_));
    check(cudaStreamSynchronize(stream_));
    if (found.foreign != 0) {
      return std::to_string(found.foreign) + " pairs are not those of the input";
    }
    if (found.disordered == 0) return std::nullopt;
    return "not sorted or not stable: " + std::to_string(found.disordered) +
           " pairs are not behind the one before";
  }

  std::uint64_t n_;
  int bits_;
  Stream stream_;
  cuda::Event begin_;
  cuda::Event end_;
  Columns input_;
  Columns front_;
  Columns back_;
  DeviceArray<std::uint64_t> count_;
  DeviceArray<SortFaults> faults_;
  DeviceArray<char> scratch_;  // for the sort that has needed most so far
};

}  // namespace

const std::vector<std::string_view>& gpu_algorithms() {
  static const std::vector<std::string_view> all = {
      "cuda_one_bit_split", "cuda_digit_passes", "cuda_reduce_then_scan", "cuda_onesweep", "cub"};
  return all;
}

std::string cub_version() { return cub_baseline::version(); }

std::unique_ptr<GpuSortCase> make_gpu_sort_case(const std::vector<std::uint32_t>& keys, int bits) {
  return std::make_unique<Case>(keys, bits);
}

}  // namespace octocell::bench
