// SPDX-License-Identifier: MIT
#include "octocell_plugin.h"

/// Your part: do two spheres overlap? Spheres that touch do, too.
__device__ bool overlap(const octocell_sphere&, const octocell_sphere&) { return false; }

/// Runs once in each of n threads or more. A thread tests a sphere with all that follow.
__global__ void test_all(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs,
                         uint64_t capacity, unsigned long long* count) {
  const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;  // which thread this is
  for (uint32_t j = i + 1; j < n; ++j) {
    if (!overlap(spheres[i], spheres[j])) continue;
    const uint64_t place = atomicAdd(count, 1ULL);  // no two threads get the same place
    if (place < capacity) pairs[place] = {i, j};
  }
}

/// The arrays are in the host's memory; the GPU has a memory of its own.
int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  octocell_sphere* s = nullptr;
  octocell_pair* found = nullptr;
  unsigned long long* counted = nullptr;
  if (const int error = cudaMalloc(&counted, sizeof *counted)) return error;
  if (const int error = cudaMalloc(&s, (n + 1ULL) * sizeof *s)) return error;
  if (const int error = cudaMalloc(&found, (capacity + 1) * sizeof *found)) return error;
  cudaMemset(counted, 0, sizeof *counted);
  cudaMemcpy(s, spheres, n * sizeof *s, cudaMemcpyHostToDevice);
  if (n > 0) test_all<<<(n + 127) / 128, 128>>>(s, n, found, capacity, counted);  // blocks, threads
  if (const int error = cudaMemcpy(count, counted, sizeof *count, cudaMemcpyDeviceToHost))
    return error;
  const uint64_t fit = *count < capacity ? *count : capacity;
  cudaMemcpy(pairs, found, fit * sizeof *pairs, cudaMemcpyDeviceToHost);
  cudaFree(counted);
  cudaFree(s);
  return cudaFree(found);
}
