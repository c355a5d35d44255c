// SPDX-License-Identifier: MIT
// The two systems that the stages run on: this machine's threads, and a CUDA device. Each stage is
// written once, for a `System` with an execution policy, arrays, and a way to read an element.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#ifdef OCTOCELL_THRUST_OPENMP
#include <omp.h>
#include <thrust/system/omp/execution_policy.h>
#else
#include <thrust/system/cpp/execution_policy.h>
#endif
#ifdef __CUDACC__
#include <thrust/system/cuda/execution_policy.h>
#endif

#include "core/buffer.hpp"
#include "core/clock.hpp"
#include "core/plan.hpp"
#include "core/sphere.hpp"
#include "impl_thrust/scratch.cuh"
#include "impl_thrust/threads.hpp"

namespace octocell::on_thrust {

class HostSystem {
 public:
  template <typename T>
  using Array = Buffer<T>;

#ifdef OCTOCELL_THRUST_OPENMP
  /// Returns how many threads there are.
  static int use_threads(int count) {
    const int threads = threads_to_be_had(count);
    omp_set_num_threads(threads);
    return threads;
  }
  auto policy() { return thrust::omp::par(scratch_); }
#else
  static int use_threads(int) { return 1; }
  auto policy() { return thrust::cpp::par(scratch_); }
#endif

  /// Returns the spheres where they are: stages can read the host's memory.
  const Sphere* take(SceneView scene) { return scene.spheres.data(); }
  const Levels* take(const Levels& levels) { return &levels; }
  /// Returns the flags; null if there are none.
  const Flags* take_flags(SceneView scene) {
    return scene.flags.empty() ? nullptr : scene.flags.data();
  }
  template <typename T>
  T read(const T* element) {
    return *element;
  }
  template <typename T>
  std::vector<T> read(const T* first, std::uint64_t count) {
    return {first, first + count};
  }
  std::unique_ptr<StageClock> make_clock(Marks marks) { return std::make_unique<HostClock>(marks); }
  Scratch<HostMemory>& scratch() { return scratch_; }

 private:
  Scratch<HostMemory> scratch_;
};

#ifdef __CUDACC__
/// The first CUDA device, with one stream. Every algorithm has ended when it returns, so the host's
/// clock can mark the stages.
class CudaSystem {
 public:
  template <typename T>
  using Array = cuda::DeviceArray<T>;

  CudaSystem() { cuda::check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking)); }
  CudaSystem(const CudaSystem&) = delete;
  CudaSystem& operator=(const CudaSystem&) = delete;
  ~CudaSystem() { cudaStreamDestroy(stream_); }

  static int use_threads(int) { return 1; }
  auto policy() { return thrust::cuda::par(scratch_).on(stream_); }

  /// Returns a copy on the device.
  const Sphere* take(SceneView scene) {
    spheres_.allocate(scene.spheres.size());
    copy(spheres_.data(), scene.spheres.data(), scene.spheres.size_bytes());
    return spheres_.data();
  }
  /// Function objects hold only a pointer: with a kilobyte of levels inside, each thread would copy
  /// them.
  const Levels* take(const Levels& levels) {
    levels_.allocate(1);
    copy(levels_.data(), &levels, sizeof levels);
    return levels_.data();
  }
  const Flags* take_flags(SceneView scene) {
    if (scene.flags.empty()) return nullptr;
    flags_.allocate(scene.flags.size());
    copy(flags_.data(), scene.flags.data(), scene.flags.size_bytes());
    return flags_.data();
  }
  template <typename T>
  T read(const T* element) {
    T value;
    copy(&value, element, sizeof(T));
    return value;
  }
  template <typename T>
  std::vector<T> read(const T* first, std::uint64_t count) {
    std::vector<T> values(count);
    copy(values.data(), first, count * sizeof(T));
    return values;
  }
  std::unique_ptr<StageClock> make_clock(Marks marks) {
    return std::make_unique<cuda::EventClock>(stream_, marks);
  }
  Scratch<cuda::Memory>& scratch() { return scratch_; }

 private:
  void copy(void* to, const void* from, std::size_t bytes) {
    if (bytes == 0) return;
    cuda::check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDefault, stream_));
    cuda::check(cudaStreamSynchronize(stream_));
  }

  cudaStream_t stream_ = nullptr;
  Scratch<cuda::Memory> scratch_;
  cuda::DeviceArray<Sphere> spheres_;
  cuda::DeviceArray<Levels> levels_;
  cuda::DeviceArray<Flags> flags_;
};

#define OCTOCELL_FOR_BOTH_SYSTEMS(stage, ...)                               \
  template void stage(Workspace<HostSystem>& w __VA_OPT__(, ) __VA_ARGS__); \
  template void stage(Workspace<CudaSystem>& w __VA_OPT__(, ) __VA_ARGS__)
#else
#define OCTOCELL_FOR_BOTH_SYSTEMS(stage, ...) \
  template void stage(Workspace<HostSystem>& w __VA_OPT__(, ) __VA_ARGS__)
#endif

}  // namespace octocell::on_thrust
