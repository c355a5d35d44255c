// SPDX-License-Identifier: MIT
#include "octocell_plugin.h"

__global__ void test_all(const octocell_sphere* s, uint32_t n, octocell_pair* pairs,
                         uint64_t capacity, unsigned long long* count) {
  const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  for (uint32_t j = i + 1; j < n; ++j) {
    const double x = double(s[i].x) - s[j].x;
    const double y = double(s[i].y) - s[j].y;
    const double z = double(s[i].z) - s[j].z;
    const double r = double(s[i].r) + s[j].r;
    if (x * x + y * y + z * z > r * r) continue;
    const uint64_t place = atomicAdd(count, 1ULL);
    if (place < capacity) pairs[place] = {i, j};
  }
}

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
  if (n > 0) test_all<<<(n + 127) / 128, 128>>>(s, n, found, capacity, counted);
  if (const int error = cudaMemcpy(count, counted, sizeof *count, cudaMemcpyDeviceToHost))
    return error;
  const uint64_t fit = *count < capacity ? *count : capacity;
  cudaMemcpy(pairs, found, fit * sizeof *pairs, cudaMemcpyDeviceToHost);
  cudaFree(counted);
  cudaFree(s);
  return cudaFree(found);
}
