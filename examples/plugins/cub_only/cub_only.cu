// SPDX-License-Identifier: MIT
// Sweep and prune of CUB's parts: sort the spheres by where they begin on x, let each count the
// pairs with those that begin before it ends, turn counts into places, write.
#include <cstddef>
#include <cstdint>
#include <cub/device/device_for.cuh>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <stdexcept>

#include "exact_overlap.cuh"
#include "octocell_plugin.h"

namespace {

void check(cudaError_t error) {
  if (error != cudaSuccess) throw std::runtime_error(cudaGetErrorString(error));
}

/// Memory of the GPU that frees itself.
template <typename T>
class DeviceArray {
 public:
  explicit DeviceArray(std::uint64_t size) { check(cudaMalloc(&data_, (size + 1) * sizeof(T))); }
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { cudaFree(data_); }
  [[nodiscard]] T* data() const { return data_; }

 private:
  T* data_ = nullptr;
};

/// CUB's algorithms are called twice: first they say how much memory they need.
template <typename Algorithm>
void run(const Algorithm& algorithm) {
  std::size_t bytes = 0;
  check(algorithm(nullptr, bytes));
  const DeviceArray<char> memory(bytes);
  check(algorithm(memory.data(), bytes));
}

/// Where a sphere begins on x, rounded. Rounding is monotone, so no pair is lost by it.
struct Begin {
  const octocell_sphere* spheres;
  float* begins;
  std::uint32_t* ids;
  __device__ void operator()(std::uint32_t i) const {
    begins[i] = spheres[i].x - spheres[i].r;
    ids[i] = i;
  }
};

/// Spheres in the order of their begins on x.
struct Order {
  const octocell_sphere* spheres;
  const float* begins;
  const std::uint32_t* ids;
  std::uint32_t size;

  /// Calls `found(i, j)` for each pair of the sphere at `place` with a later one.
  template <typename Found>
  __device__ void for_each_pair(std::uint32_t place, Found found) const {
    const octocell_sphere s = spheres[ids[place]];
    const float end = s.x + s.r;
    for (std::uint32_t k = place + 1; k < size && begins[k] <= end; ++k) {
      if (overlap(s, spheres[ids[k]])) found(ids[place], ids[k]);
    }
  }
};

struct Count {
  Order order;
  std::uint64_t* counts;
  __device__ void operator()(std::uint32_t place) const {
    std::uint64_t count = 0;
    order.for_each_pair(place, [&](std::uint32_t, std::uint32_t) { ++count; });
    counts[place] = count;
  }
};

struct Write {
  Order order;
  const std::uint64_t* places;
  octocell_pair* pairs;
  __device__ void operator()(std::uint32_t place) const {
    octocell_pair* next = pairs + places[place];
    order.for_each_pair(place, [&](std::uint32_t i, std::uint32_t j) { *next++ = {i, j}; });
  }
};

void find(const octocell_sphere* from, std::uint32_t n, octocell_pair* pairs,
          std::uint64_t capacity, std::uint64_t* count) {
  const DeviceArray<octocell_sphere> spheres(n);
  check(cudaMemcpy(spheres.data(), from, n * sizeof *from, cudaMemcpyHostToDevice));

  const DeviceArray<float> begins(n);
  const DeviceArray<float> sorted_begins(n);
  const DeviceArray<std::uint32_t> ids(n);
  const DeviceArray<std::uint32_t> sorted_ids(n);
  check(cub::DeviceFor::Bulk(n, Begin{spheres.data(), begins.data(), ids.data()}));
  run([&](void* memory, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairs(memory, bytes, begins.data(), sorted_begins.data(),
                                           ids.data(), sorted_ids.data(), n);
  });

  // One more than there are spheres: the last place is the number of all pairs.
  const DeviceArray<std::uint64_t> counts(n + 1);
  const DeviceArray<std::uint64_t> places(n + 1);
  check(cudaMemset(counts.data(), 0, (n + 1) * sizeof(std::uint64_t)));
  const Order order = {spheres.data(), sorted_begins.data(), sorted_ids.data(), n};
  check(cub::DeviceFor::Bulk(n, Count{order, counts.data()}));
  run([&](void* memory, std::size_t& bytes) {
    return cub::DeviceScan::ExclusiveSum(memory, bytes, counts.data(), places.data(), n + 1);
  });
  check(cudaMemcpy(count, places.data() + n, sizeof *count, cudaMemcpyDeviceToHost));
  if (*count > capacity) return;

  const DeviceArray<octocell_pair> found(*count);
  check(cub::DeviceFor::Bulk(n, Write{order, places.data(), found.data()}));
  check(cudaMemcpy(pairs, found.data(), *count * sizeof *pairs, cudaMemcpyDeviceToHost));
}

}  // namespace

int find_pairs(const octocell_sphere* spheres, uint32_t n, octocell_pair* pairs, uint64_t capacity,
               uint64_t* count, void* /*stream*/) {
  *count = 0;
  if (n > 0) find(spheres, n, pairs, capacity, count);
  return 0;
}
