// SPDX-License-Identifier: MIT
// Memory for the plan's arrays and for the temporary needs of Thrust's algorithms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <new>

#include "core/cuda/cuda.cuh"

namespace octocell::on_thrust {

struct HostMemory {
  static constexpr std::align_val_t kAlignment{64};
  static char* allocate(std::size_t bytes) {
    return static_cast<char*>(::operator new(bytes, kAlignment));
  }
  static void release(char* memory, std::size_t) { ::operator delete(memory, kAlignment); }
};

/// The allocator that Thrust uses. It keeps returned memory for the next request of that size, so a
/// find_pairs() like the last one allocates nothing.
template <typename Memory>
class Scratch {
 public:
  using value_type = char;

  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { release(); }

  char* allocate(std::ptrdiff_t bytes) {
    const std::scoped_lock lock(mutex_);  // OpenMP's merge sort allocates from several threads at
                                          // once
    const std::size_t size = (static_cast<std::size_t>(bytes) / kGrain + 1) * kGrain;
    if (const auto kept = free_.lower_bound(size); kept != free_.end() && kept->first <= 2 * size) {
      char* memory = kept->second;
      used_.emplace(memory, kept->first);
      free_.erase(kept);
      return memory;
    }
    char* memory = Memory::allocate(size);
    ++allocations_;
    used_.emplace(memory, size);
    return memory;
  }

  void deallocate(char* memory, std::size_t) {
    const std::scoped_lock lock(mutex_);
    const auto block = used_.find(memory);
    free_.emplace(block->second, memory);
    used_.erase(block);
  }

  /// Frees the memory that is not in use.
  void release() {
    const std::scoped_lock lock(mutex_);
    for (const auto& [size, memory] : free_) Memory::release(memory, size);
    free_.clear();
  }

  /// Returns how many requests so far needed new memory.
  [[nodiscard]] std::uint64_t allocations() const { return allocations_; }

 private:
  static constexpr std::size_t kGrain = 256;

  std::mutex mutex_;
  std::multimap<std::size_t, char*> free_;
  std::map<char*, std::size_t> used_;
  std::uint64_t allocations_ = 0;
};

}  // namespace octocell::on_thrust
