// SPDX-License-Identifier: MIT
#include "harness/engine/images/found_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"

namespace octocell::images {
namespace {

constexpr std::uint64_t kUnasked = 1 << 20;  // shorter lists are not checked
constexpr std::uint64_t kPairsPerBlock = 1 << 14;
constexpr std::uint64_t kSpheresPerBlock = 1 << 12;

void require_room(std::uint64_t pairs, std::uint64_t found) {
  if (pairs < kUnasked) return;
  require_memory(static_cast<double>(pairs) * (sizeof(Pair) + sizeof(Shift)),
                 fmt::format("{} pairs and more", found));
}

}  // namespace

void FoundList::append(std::span<const Found> some) {
  const std::scoped_lock lock(mutex_);
  const std::uint64_t begin = count_;
  count_ += some.size();
  if (how_.count_only) return;
  if (count_ > pairs_.capacity()) {
    grow(std::max<std::uint64_t>({count_, 2 * pairs_.capacity(), 1024}), begin);
  }
  for (std::size_t k = 0; k < some.size(); ++k) {
    pairs_[begin + k] = some[k].pair;
    shifts_[begin + k] = some[k].shift;
  }
}

void FoundList::reserve(std::uint64_t pairs) {
  if (!how_.count_only && pairs > pairs_.capacity()) grow(pairs, count_);
}

void FoundList::grow(std::uint64_t room, std::uint64_t filled) {
  require_room(room, filled);
  const auto grown = [&]<typename T>(Buffer<T>& buffer) {
    Buffer<T> larger;
    larger.allocate(room);
    std::copy_n(buffer.data(), filled, larger.data());
    buffer = std::move(larger);
  };
  grown(pairs_);
  grown(shifts_);
}

/// Distributes the list by i, then sorts the few pairs of each i.
void FoundList::sort(std::uint64_t spheres, cpu::Threads& threads) {
  require_room(count_, count_);
  Buffer<Pair> pairs;
  Buffer<Shift> shifts;
  pairs.allocate(count_);
  shifts.allocate(count_);
  std::vector<std::uint64_t> ends(spheres + 1);
  for (std::uint64_t k = 0; k < count_; ++k) ++ends[pairs_[k].i + 1];
  for (std::uint64_t i = 0; i < spheres; ++i) ends[i + 1] += ends[i];  // now of where i begins
  threads.for_blocks(count_, kPairsPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t k = begin; k < end; ++k) {
      const std::uint64_t to =
          std::atomic_ref(ends[pairs_[k].i]).fetch_add(1, std::memory_order_relaxed);
      pairs[to] = pairs_[k];
      shifts[to] = shifts_[k];
    }
  });
  threads.for_blocks(spheres, kSpheresPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
    std::vector<Found> some;
    for (std::uint64_t i = begin; i < end; ++i) {
      const std::uint64_t first = i == 0 ? 0 : ends[i - 1];
      if (ends[i] - first < 2) continue;
      some.clear();
      for (std::uint64_t k = first; k < ends[i]; ++k) some.push_back({pairs[k], shifts[k]});
      std::ranges::sort(some);
      for (std::uint64_t k = first; k < ends[i]; ++k) {
        pairs[k] = some[k - first].pair;
        shifts[k] = some[k - first].shift;
      }
    }
  });
  pairs_ = std::move(pairs);
  shifts_ = std::move(shifts);
}

ImagePairs FoundList::finish(std::uint64_t spheres, cpu::Threads& threads) {
  ImagePairs answer;
  answer.count = count_;
  if (how_.count_only) return answer;
  if (how_.sorted && count_ > 1) sort(spheres, threads);
  answer.pairs = {std::move(pairs_), count_};
  answer.shifts = std::move(shifts_);
  return answer;
}

}  // namespace octocell::images
