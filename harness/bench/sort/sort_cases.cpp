// SPDX-License-Identifier: MIT
#include "harness/bench/sort/sort_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/error.hpp"
#include "harness/scenes/portable_math.hpp"

namespace octocell::bench {
namespace {

constexpr int kBits[] = {8, 12, 16, 17, 20, 24, 32};
constexpr Order kOrders[] = {Order::random, Order::sorted, Order::reversed, Order::constant,
                             Order::few_distinct};
constexpr std::uint32_t kFewKeys = 16;

/// Every width in random order; the other orders only at the size where the figure shows them.
/// Above 2^20, two widths and no comparison sorts: each of those would take as long as all others
/// together.
std::vector<SortCase> quick_cases() {
  std::vector<SortCase> cases;
  for (int log = 12; log <= 20; log += 2) {
    for (const int bits : kBits) cases.push_back({1u << log, bits, Order::random});
  }
  for (const Order order : kOrders) {
    if (order == Order::random) continue;
    for (const int bits : {16, 32}) cases.push_back({1u << 20, bits, order});
  }
  for (const int log : {22, 24}) {
    for (const int bits : {16, 32}) cases.push_back({1u << log, bits, Order::random, false});
  }
  return cases;
}

std::vector<SortCase> full_cases() {
  std::vector<SortCase> cases;
  for (int log = 12; log <= 26; log += 2) {
    for (const int bits : kBits) {
      for (const Order order : kOrders) cases.push_back({1u << log, bits, order});
    }
  }
  return cases;
}

constexpr int kGpuBits[] = {8, 12, 17, 20, 24, 32};
constexpr Order kGpuOrders[] = {Order::sorted, Order::constant, Order::few_distinct};
constexpr std::uint32_t kGpuOrdersSize = 1u << 24;

/// Two widths for all sizes, all widths at one size, all orders at that size.
std::vector<SortCase> quick_gpu_cases() {
  std::vector<SortCase> cases;
  for (int log = 12; log <= 26; log += 2) {
    for (const int bits : kGpuBits) {
      const bool all_sizes = bits == 20 || bits == 32;
      if (all_sizes || 1u << log == kGpuOrdersSize) {
        cases.push_back({1u << log, bits, Order::random});
      }
    }
  }
  for (const Order order : kGpuOrders) {
    for (const int bits : {20, 32}) cases.push_back({kGpuOrdersSize, bits, order});
  }
  return cases;
}

std::vector<SortCase> full_gpu_cases() {
  std::vector<SortCase> cases;
  for (int log = 12; log <= 28; log += 2) {
    for (const int bits : kGpuBits) cases.push_back({1u << log, bits, Order::random});
  }
  for (const std::uint32_t n : {1u << 20, kGpuOrdersSize}) {
    for (const Order order : kGpuOrders) {
      for (const int bits : kGpuBits) cases.push_back({n, bits, order});
    }
  }
  return cases;
}

InputError unknown_preset(std::string_view preset) {
  return InputError(fmt::format("unknown preset '{}'; known: quick, full", preset));
}

}  // namespace

std::vector<SortCase> gpu_sort_cases(std::string_view preset) {
  if (preset == "quick") return quick_gpu_cases();
  if (preset == "full") return full_gpu_cases();
  throw unknown_preset(preset);
}

std::vector<SortCase> sort_cases(std::string_view preset) {
  if (preset == "quick") return quick_cases();
  if (preset == "full") return full_cases();
  throw unknown_preset(preset);
}

std::vector<std::uint32_t> make_keys(const SortCase& what) {
  const std::uint64_t end = std::uint64_t{1} << what.bits;  // one past the largest key
  Random random(static_cast<std::uint64_t>(what.bits));
  const auto key = [&]() -> std::uint64_t {
    switch (what.order) {
      case Order::constant:
        return end / 3;
      case Order::few_distinct:
        return random.below(kFewKeys) * ((end - 1) / (kFewKeys - 1));
      default:
        return random.bits() >> (64 - what.bits);
    }
  };
  std::vector<std::uint32_t> keys(what.n);
  for (std::uint32_t& each : keys) each = static_cast<std::uint32_t>(key());
  if (what.order == Order::sorted) std::sort(keys.begin(), keys.end());
  if (what.order == Order::reversed) std::sort(keys.begin(), keys.end(), std::greater<>());
  return keys;
}

}  // namespace octocell::bench
