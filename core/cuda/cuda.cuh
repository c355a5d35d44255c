// SPDX-License-Identifier: MIT
// Calls of the CUDA runtime with their error handling, device memory, and a clock made of events.
// Empty without nvcc.
#pragma once

#ifdef __CUDACC__

#include <cuda_runtime_api.h>

#include <array>
#include <cstdint>
#include <optional>
#include <source_location>
#include <string>

#include "core/clock.hpp"
#include "core/cuda/device_memory.hpp"
#include "core/error.hpp"

namespace octocell::cuda {

/// Throws Error with CUDA's own message and the place of the call.
inline void check(cudaError_t result,
                  const std::source_location& place = std::source_location::current()) {
  if (result == cudaSuccess) return;
  cudaGetLastError();  // clears the error, so that the next call does not report it again
  throw Error(std::string("CUDA: ") + cudaGetErrorString(result) + " (" + place.file_name() + ":" +
              std::to_string(place.line()) + ")");
}

/// Throws if a kernel launch failed; must follow every launch.
inline void check_launch(const std::source_location& place = std::source_location::current()) {
  check(cudaGetLastError(), place);
}

/// Returns the reason why no CUDA device can be used; none if one can. Looks only once.
inline std::optional<std::string> why_no_device() {
  static const std::optional<std::string> reason = []() -> std::optional<std::string> {
    int count = 0;
    const cudaError_t result = cudaGetDeviceCount(&count);
    if (result == cudaSuccess && count > 0) return std::nullopt;
    cudaGetLastError();
    return std::string("no CUDA device: ") +
           cudaGetErrorString(result == cudaSuccess ? cudaErrorNoDevice : result);
  }();
  return reason;
}

/// Throws LimitError unless `bytes` more fit into the device's memory.
inline void require_memory(std::uint64_t bytes) {
  std::size_t free = 0;
  std::size_t total = 0;
  check(cudaMemGetInfo(&free, &total));
  if (bytes <= free) return;
  throw LimitError("this needs " + std::to_string(bytes >> 20) + " MiB more of the GPU's memory, " +
                   std::to_string(free >> 20) + " of " + std::to_string(total >> 20) +
                   " MiB are free");
}

struct Memory {
  /// Throws LimitError that says how much memory was requested.
  static char* allocate(std::size_t bytes) {
    void* memory = nullptr;
    const cudaError_t result = cudaMalloc(&memory, bytes);
    if (result == cudaErrorMemoryAllocation) {
      cudaGetLastError();
      require_memory(bytes);
      throw LimitError("the GPU has no " + std::to_string(bytes >> 20) + " MiB in one piece left");
    }
    check(result);
    DeviceMemory::add(bytes);
    return static_cast<char*>(memory);
  }
  static void release(char* memory, std::size_t bytes) {
    cudaFree(memory);
    DeviceMemory::remove(bytes);
  }
};

/// Device memory whose size the plan gives. Like Buffer, it loses its contents when it grows.
template <typename T>
class DeviceArray {
 public:
  static constexpr std::size_t kElementBytes = sizeof(T);

  DeviceArray() = default;
  DeviceArray(const DeviceArray&) = delete;
  DeviceArray& operator=(const DeviceArray&) = delete;
  ~DeviceArray() { release(); }

  void allocate(std::uint64_t capacity) {
    if (capacity <= capacity_) return;
    release();
    data_ = reinterpret_cast<T*>(Memory::allocate(capacity * sizeof(T)));
    capacity_ = capacity;
  }
  void release() {
    if (data_ != nullptr) Memory::release(reinterpret_cast<char*>(data_), capacity_ * sizeof(T));
    data_ = nullptr;
    capacity_ = 0;
  }
  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }

 private:
  T* data_ = nullptr;
  std::uint64_t capacity_ = 0;
};

class Event {
 public:
  Event() { check(cudaEventCreate(&event_)); }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { cudaEventDestroy(event_); }

  void record(cudaStream_t stream) { check(cudaEventRecord(event_, stream)); }
  void wait() const { check(cudaEventSynchronize(event_)); }
  /// Returns the time between two events; the device must have passed both.
  [[nodiscard]] double milliseconds_since(const Event& earlier) const {
    float milliseconds = 0.0F;
    check(cudaEventElapsedTime(&milliseconds, earlier.event_, event_));
    return milliseconds;
  }

 private:
  cudaEvent_t event_ = nullptr;
};

/// Measures time on the device, between events in the stream that the stages are queued on.
class EventClock final : public StageClock {
 public:
  EventClock(cudaStream_t stream, Marks marks) : stream_(stream), marks_(marks) {}
  using StageClock::mark;

  void start() override {
    mark_count_ = 0;
    begin_.record(stream_);
  }
  void mark(Stage first, Stage last) override {
    if (marks_ == Marks::off || mark_count_ == marked_.size()) return;
    marked_[mark_count_].first = first;
    marked_[mark_count_].last = last;
    marked_[mark_count_].end.record(stream_);
    ++mark_count_;
  }
  StageTimes stop() override {
    end_.record(stream_);
    end_.wait();
    StageTimes times;
    times.total_ms = end_.milliseconds_since(begin_);
    const Event* before = &begin_;
    for (std::size_t m = 0; m < mark_count_; ++m) {
      const Marked& mark = marked_[m];
      std::optional<double>& stage_ms = times.stage_ms[index_of(mark.first)];
      stage_ms = stage_ms.value_or(0.0) + mark.end.milliseconds_since(*before);
      for (std::size_t s = index_of(mark.first) + 1; s <= index_of(mark.last); ++s) {
        times.fused_into[s] = mark.first;
      }
      before = &mark.end;
    }
    return times;
  }

 private:
  struct Marked {
    Event end;
    Stage first = Stage::bounds;
    Stage last = Stage::bounds;
  };

  cudaStream_t stream_;
  Marks marks_;
  Event begin_;
  Event end_;
  std::array<Marked, 2 * kStageCount> marked_;  // twice: a mispredicted frame runs its stages again
  std::size_t mark_count_ = 0;
};

}  // namespace octocell::cuda

#endif
