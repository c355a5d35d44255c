// SPDX-License-Identifier: MIT
// A digit of one bit: entries with a 0 move to the front, those with a 1 behind them. A prefix sum
// over the zeros says how far.
#include <utility>

#include "../device_array.cuh"
#include "octocell_stage.h"

constexpr unsigned kThreads = 128;

/// Each block replaces its 128 numbers by their exclusive sums, and writes what they add up to.
__global__ void sum_blocks(uint32_t* numbers, uint32_t n, uint32_t* totals) {
  __shared__ uint32_t sums[kThreads];
  const uint32_t k = blockIdx.x * kThreads + threadIdx.x;
  const uint32_t own = k < n ? numbers[k] : 0;
  sums[threadIdx.x] = own;
  __syncthreads();
  // Your part: sums[t] becomes the sum of sums[0] to sums[t], in seven steps of all threads
  // together.
  if (k < n) numbers[k] = sums[threadIdx.x] - own;
  if (threadIdx.x == kThreads - 1) totals[blockIdx.x] = sums[threadIdx.x];
}

__global__ void add_totals(uint32_t* numbers, uint32_t n, const uint32_t* totals) {
  const uint32_t k = blockIdx.x * kThreads + threadIdx.x;
  if (k < n) numbers[k] += totals[blockIdx.x];
}

/// The totals of blocks are numbers, too: their sums are found in the same way.
void exclusive_sum(uint32_t* numbers, uint32_t n) {
  const unsigned blocks = blocks_for(n);
  const DeviceArray<uint32_t> totals(blocks);
  sum_blocks<<<blocks, kThreads>>>(numbers, n, totals.data());
  if (blocks == 1) return;
  exclusive_sum(totals.data(), blocks);
  add_totals<<<blocks, kThreads>>>(numbers, n, totals.data());
}

__global__ void mark_zeros(const uint32_t* ids, uint32_t n, uint32_t bit, uint32_t* zeros) {
  const uint32_t k = blockIdx.x * kThreads + threadIdx.x;
  if (k < n) zeros[k] = 1 - (ids[k] >> bit & 1);
  if (k == n) zeros[n] = 0;  // its sum is the number of all zeros
}

__global__ void move_entries(const uint32_t* ids, const uint32_t* objects, uint32_t n, uint32_t bit,
                             const uint32_t* zeros_before, uint32_t* to_ids, uint32_t* to_objects) {
  const uint32_t k = blockIdx.x * kThreads + threadIdx.x;
  if (k >= n) return;
  // Your part: entries with a 0 in this bit come first, then those with a 1.
  const uint32_t place = k;
  to_ids[place] = ids[k];
  to_objects[place] = objects[k];
}

int sort(const uint32_t* ids, const uint32_t* objects, uint32_t n, uint32_t key_bits,
         uint32_t* sorted_ids, uint32_t* sorted_objects) {
  const DeviceArray<uint32_t> a_ids(ids, n);
  const DeviceArray<uint32_t> a_objects(objects, n);
  const DeviceArray<uint32_t> b_ids(n);
  const DeviceArray<uint32_t> b_objects(n);
  const DeviceArray<uint32_t> sums(n + 1);
  const DeviceArray<uint32_t>*from[2] = {&a_ids, &a_objects}, *to[2] = {&b_ids, &b_objects};
  const unsigned blocks = blocks_for(n + 1ULL);
  for (uint32_t bit = 0; bit < key_bits; ++bit) {
    mark_zeros<<<blocks, kThreads>>>(from[0]->data(), n, bit, sums.data());
    exclusive_sum(sums.data(), n + 1);
    move_entries<<<blocks, kThreads>>>(from[0]->data(), from[1]->data(), n, bit, sums.data(),
                                       to[0]->data(), to[1]->data());
    std::swap(from, to);
  }
  check(cudaGetLastError());
  from[0]->copy_to(sorted_ids, n);
  from[1]->copy_to(sorted_objects, n);
  return 0;
}
