// SPDX-License-Identifier: MIT
// The three phases of GPU Gems 3, chapter 32, on threads instead of thread groups: count how often
// each digit occurs in each part, sum the counts, and reorder.
#include "impl_cpu/radix_sort.hpp"
#include "core/digit_plan.hpp"
#include "impl_cpu/block_size.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace octocell::cpu {
namespace {

constexpr std::size_t kDigits = 1 << kWidestDigit;
constexpr int kMaxParts = block_size(64, 2);

/// For each part of the input and each digit: first a count, then where the part's next such key
/// goes.
using Counters = std::array<std::array<std::uint32_t, kDigits>, kMaxParts>;

std::size_t value_of(Digit digit, std::uint32_t key) {
  return key >> digit.shift & ((std::size_t{1} << digit.width) - 1);
}

struct Part {
  std::size_t begin;
  std::size_t end;
};
Part part_of(std::size_t size, int part, int parts) {
  const auto p = static_cast<std::size_t>(part);
  return {size * p / static_cast<std::size_t>(parts),
          size * (p + 1) / static_cast<std::size_t>(parts)};
}

void tabulate(std::span<const std::uint32_t> keys, Digit digit,
              std::array<std::uint32_t, kDigits>& counts) {
  counts.fill(0);
  for (const std::uint32_t key : keys) ++counts[value_of(digit, key)];
}

/// Turns counts into first positions: first the zeros of all parts, then the ones of all parts, and
/// so on. So equal keys keep their order.
void prefix_sum(Counters& counters, int parts) {
  std::uint32_t position = 0;
  for (std::size_t d = 0; d < kDigits; ++d) {
    for (int p = 0; p < parts; ++p) {
      std::uint32_t& counter = counters[p][d];
      const std::uint32_t count = counter;
      counter = position;
      position += count;
    }
  }
}

void reorder(const KeysAndValues& from, const KeysAndValues& to, Part part, Digit digit,
             std::array<std::uint32_t, kDigits>& positions) {
  for (std::size_t i = part.begin; i < part.end; ++i) {
    const std::uint32_t position = positions[value_of(digit, from.keys[i])]++;
    to.keys[position] = from.keys[i];
    to.values[position] = from.values[i];
  }
}

/// Copies where the first key with each digit goes; the counts are the distances between them.
SortPass begin_record(Digit digit, const std::array<std::uint32_t, kDigits>& first_positions,
                      std::size_t size) {
  SortPass pass = {.digit = digit, .counts = {}, .offsets = {}, .cell_ids = {}, .objects = {}};
  const std::size_t digits = std::size_t{1} << digit.width;
  pass.offsets.assign(first_positions.begin(), first_positions.begin() + digits);
  for (std::size_t d = 0; d < digits; ++d) {
    const std::size_t end = d + 1 < digits ? pass.offsets[d + 1] : size;
    pass.counts.push_back(static_cast<std::uint32_t>(end - pass.offsets[d]));
  }
  return pass;
}

void end_record(SortPass& pass, const KeysAndValues& to) {
  pass.cell_ids.assign(to.keys.begin(), to.keys.end());
  pass.objects.assign(to.values.begin(), to.values.end());
}

}  // namespace

int radix_sort(KeysAndValues front, KeysAndValues back, int key_bits, Threads& threads,
               std::vector<SortPass>* passes) {
  const std::size_t size = front.keys.size();
  const int parts = std::min(threads.count(), kMaxParts);
  static thread_local Counters counters;  // 64 KiB: too large for the stack
  Counters& shared = counters;
  const auto for_parts = [&](auto&& work) {
    threads.run([&](int t) {
      if (t < parts) work(t, part_of(size, t, parts));
    });
  };
  const DigitPlan plan = digit_plan(key_bits, kWidestDigit);
  int side = 0;
  for (int pass = 0; pass < plan.passes; ++pass) {
    const Digit digit = plan.digits[pass];
    const KeysAndValues& from = side == 0 ? front : back;
    const KeysAndValues& to = side == 0 ? back : front;
    for_parts([&](int p, Part part) {
      tabulate(from.keys.subspan(part.begin, part.end - part.begin), digit, shared[p]);
    });
    prefix_sum(shared, parts);
    if (passes != nullptr) passes->push_back(begin_record(digit, shared[0], size));
    for_parts([&](int p, Part part) { reorder(from, to, part, digit, shared[p]); });
    if (passes != nullptr) end_record(passes->back(), to);
    side ^= 1;
  }
  return side;
}

}  // namespace octocell::cpu
