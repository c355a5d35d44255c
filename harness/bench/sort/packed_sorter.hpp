// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "harness/bench/sort/algorithms.hpp"

namespace octocell::bench {

inline void pack(Workspace& work, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    work.packed[i] = std::uint64_t{work.front.keys[i]} << 32 | work.front.values[i];
  }
}

inline void unpack(Workspace& work, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    work.front.keys[i] = static_cast<std::uint32_t>(work.packed[i] >> 32);
    work.front.values[i] = static_cast<std::uint32_t>(work.packed[i]);
  }
}

/// Packs, sorts one array of 64-bit numbers with Sort, and unpacks; on one thread.
template <typename Sort>
class PackedSorter final : public Sorter {
 public:
  const PairArrays& sort(Workspace& work, int) override {
    pack(work, 0, work.packed.size());
    sort_(work.packed);
    unpack(work, 0, work.packed.size());
    return work.front;
  }

 private:
  Sort sort_;
};

template <typename Sort>
std::unique_ptr<Sorter> create_packed(int) {
  return std::make_unique<PackedSorter<Sort>>();
}

}  // namespace octocell::bench
