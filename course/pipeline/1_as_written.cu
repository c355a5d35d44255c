// SPDX-License-Identifier: MIT
// The course text as a CUDA program: one kernel for each step of the text, its mistakes included.
// The same arrays as 1_as_written.cpp prints, made by many threads.
//
//   nvcc -std=c++20 -O2 -fmad=false 1_as_written.cu -o 1_as_written_cuda
//   ./1_as_written_cuda ../scenes/eight.csv
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "read_and_print.hpp"

using Id = std::uint32_t;

struct Cell {
  Id x, y, z;
};

constexpr Id kSlots = 8;  // a sphere: its home cell and seven phantoms
constexpr int kXShift = 0, kYShift = 10, kZShift = 20;
constexpr Id kBlock = 128;  // threads in a block
constexpr Id kParts = 64;   // the sort's threads; each takes a part of the entries

void check(cudaError_t error) {
  if (error != cudaSuccess) refuse(std::string("CUDA: ") + cudaGetErrorString(error));
}

// Memory that host and device both reach; freed when the program ends.
template <typename T>
T* shared_array(std::size_t size) {
  T* array = nullptr;
  check(cudaMallocManaged(&array, size * sizeof(T)));
  return array;
}

// Waits for the last kernel, and says if it failed.
void finish() { check(cudaDeviceSynchronize()); }

Id blocks(Id threads) { return (threads + kBlock - 1) / kBlock; }

__device__ Id thread() { return blockIdx.x * blockDim.x + threadIdx.x; }

// ---- 2. Subdivision: which cells does each sphere lie in?  A thread for each sphere.

__device__ Cell home_cell(float side, Sphere s) {  // a cast of a negative number gives 0 here
  return {static_cast<Id>(s.x / side), static_cast<Id>(s.y / side), static_cast<Id>(s.z / side)};
}

__device__ Id cell_id(Cell c) { return c.x << kXShift | c.y << kYShift | c.z << kZShift; }

__device__ float gap(float side, Id c, float p) {
  const float low = static_cast<float>(c) * side, high = low + side;
  if (p < low) return low - p;
  return p > high ? p - high : 0;
}

__device__ bool ball_meets(float side, Cell c, Sphere s) {
  const float x = gap(side, c.x, s.x), y = gap(side, c.y, s.y), z = gap(side, c.z, s.z);
  return x * x + y * y + z * z <= s.r * s.r;
}

__device__ bool step(Id& at, int by) {
  if (by < 0 ? at == 0 : by > 0 && at == 0xffffffff) return false;
  at += static_cast<Id>(by);
  return true;
}

__global__ void list_cells(float side, const Sphere* spheres, Id n, Id* cell_ids, Id* objects) {
  const Id i = thread();
  if (i >= n) return;
  const Cell home = home_cell(side, spheres[i]);
  Id slot = kSlots * i;
  cell_ids[slot] = cell_id(home);
  objects[slot++] = i;
  for (int neighbour = 0; neighbour < 27 && slot < kSlots * (i + 1); ++neighbour) {
    const int dx = neighbour % 3 - 1, dy = neighbour / 3 % 3 - 1, dz = neighbour / 9 - 1;
    Cell c = home;
    if (dx == 0 && dy == 0 && dz == 0) continue;
    if (!step(c.x, dx) || !step(c.y, dy) || !step(c.z, dz)) continue;
    if (!ball_meets(side, c, spheres[i])) continue;
    cell_ids[slot] = cell_id(c);
    objects[slot++] = i | kPhantom;
  }
  for (; slot < kSlots * (i + 1); ++slot) cell_ids[slot] = objects[slot] = kEmpty;
}

// ---- 3. Radix sort. A thread for each part; counters[d * kParts + part] is its count of digit d.

__device__ Id digit(Id id, int shift) { return id >> shift & 255; }

// Phase 1: how often does each digit occur in my part?
__global__ void tabulate(const Id* cell_ids, Id size, int shift, Id* counters) {
  const Id part = thread();
  for (Id d = 0; d < 256; ++d) counters[d * kParts + part] = 0;
  for (Id k = size / kParts * part; k < size / kParts * (part + 1); ++k)
    ++counters[digit(cell_ids[k], shift) * kParts + part];
}

// Phase 2: prefix sums, digit by digit and in each digit part by part. A thread for each digit.
__global__ void prefix_sum(Id* counters) {
  __shared__ Id totals[256];
  Id* mine = counters + threadIdx.x * kParts;
  Id sum = 0;
  for (Id part = 0; part < kParts; ++part) sum += mine[part];
  totals[threadIdx.x] = sum;
  __syncthreads();
  Id place = 0;
  for (Id d = 0; d < threadIdx.x; ++d) place += totals[d];
  for (Id part = 0; part < kParts; ++part) {
    const Id count = mine[part];
    mine[part] = place;
    place += count;
  }
}

// Phase 3: each entry goes to the next place of its digit and part. Equal digits stay in order.
__global__ void reorder(const Id* cell_ids, const Id* objects, Id size, int shift, Id* places,
                        Id* sorted_ids, Id* sorted_objects) {
  const Id part = thread();
  for (Id k = size / kParts * part; k < size / kParts * (part + 1); ++k) {
    const Id place = places[digit(cell_ids[k], shift) * kParts + part]++;
    sorted_ids[place] = cell_ids[k];
    sorted_objects[place] = objects[k];
  }
}

// The index array. A thread for each entry; that of a cell's first entry counts all of the cell.
__global__ void index_cells(const Id* cell_ids, const Id* objects, Id size, IndexEntry* cells) {
  const Id k = thread();
  if (k >= size) return;
  cells[k] = {cell_ids[k], k, 0, 0};
  if (cell_ids[k] == kEmpty || (k > 0 && cell_ids[k] == cell_ids[k - 1])) return;
  for (Id l = k; l < size && cell_ids[l] == cell_ids[k]; ++l)
    ++(objects[l] & kPhantom ? cells[k].phantoms : cells[k].homes);
}

// ---- 4. Collision detection: a thread for each cell. The pair count goes on past the room.

__device__ bool overlap(Sphere a, Sphere b) {
  const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z, r = a.r + b.r;
  return x * x + y * y + z * z <= r * r;
}

__device__ bool is_tested_here(float side, const Sphere* spheres, Id a, Id b) {
  if (a & b & kPhantom) return false;
  if (!((a | b) & kPhantom)) return true;
  const Id home = a & kPhantom ? b : a, phantom = a & kPhantom ? a : b;
  return cell_id(home_cell(side, spheres[phantom & kNumber])) >
         cell_id(home_cell(side, spheres[home]));
}

__global__ void test_pairs(float side, const Sphere* spheres, const Id* objects,
                           const IndexEntry* cells, Id size, Pair* pairs, Id room, Id* count) {
  if (thread() >= size) return;
  const IndexEntry cell = cells[thread()];
  const Id end = cell.begin + cell.homes + cell.phantoms;
  for (Id k = cell.begin; k < end; ++k) {
    for (Id l = k + 1; l < end; ++l) {
      if (!is_tested_here(side, spheres, objects[k], objects[l])) continue;
      const Id i = objects[k] & kNumber, j = objects[l] & kNumber;
      if (!overlap(spheres[i], spheres[j])) continue;
      const Id place = atomicAdd(count, 1);
      if (place >= room) continue;
      pairs[place].first = min(i, j);
      pairs[place].second = max(i, j);
    }
  }
}

int main(int argc, char** argv) {
  const std::vector<Sphere> read = read_spheres(argc, argv);
  const Id n = static_cast<Id>(read.size());
  // 1. Initialisation: space is cut into cubes of side d = 1.5 r_max.
  float r_max = 0;
  for (const Sphere& s : read) r_max = std::max(r_max, s.r);
  const float side = 1.5F * r_max;
  std::printf("%u spheres, cell side %g\n\n", n, side);

  const Id size = (n * kSlots + kParts - 1) / kParts * kParts, room = 64 * n;
  Sphere* spheres = shared_array<Sphere>(n);
  std::copy(read.begin(), read.end(), spheres);
  Id *cell_ids = shared_array<Id>(size), *objects = shared_array<Id>(size);
  Id *sorted_ids = shared_array<Id>(size), *sorted_objects = shared_array<Id>(size);
  Id* counters = shared_array<Id>(256 * kParts);
  std::fill(cell_ids + n * kSlots, cell_ids + size, kEmpty);  // behind the slots: parts are equal
  list_cells<<<blocks(n), kBlock>>>(side, spheres, n, cell_ids, objects);
  finish();
  print_entries("cells of each sphere", cell_ids, objects, size);
  for (int shift = 0; shift < 32; shift += 8) {
    tabulate<<<1, kParts>>>(cell_ids, size, shift, counters);
    prefix_sum<<<1, 256>>>(counters);
    reorder<<<1, kParts>>>(cell_ids, objects, size, shift, counters, sorted_ids, sorted_objects);
    finish();
    std::swap(cell_ids, sorted_ids);
    std::swap(objects, sorted_objects);
    std::printf("\nsort by bits %d to %d\n", shift, shift + 7);
    print_entries(" sorted", cell_ids, objects, size);
  }
  IndexEntry* cells = shared_array<IndexEntry>(size);
  index_cells<<<blocks(size), kBlock>>>(cell_ids, objects, size, cells);
  Pair* pairs = shared_array<Pair>(room);
  Id* count = shared_array<Id>(1);
  *count = 0;
  finish();
  test_pairs<<<blocks(size), kBlock>>>(side, spheres, objects, cells, size, pairs, room, count);
  finish();
  if (*count > room) refuse("too many pairs for the room there is");
  std::sort(pairs, pairs + *count);
  print_cells(cells, size, objects);
  print_pairs(pairs, *count);
}
