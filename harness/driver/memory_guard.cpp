// SPDX-License-Identifier: MIT
#include "harness/driver/memory_guard.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string>

#include "harness/interface/error.hpp"
#include "harness/interface/pair.hpp"

namespace octocell {
namespace {

constexpr double kGiB = 1073741824.0;

/// Two arrays of ids and two of objects; cells; doubts and pairs.
double bytes_of(const Capacities& room) {
  constexpr double kBytesPerId = 16.0;
  constexpr double kBytesPerCell = 12.0;
  return kBytesPerId * static_cast<double>(room.ids) +
         kBytesPerCell * static_cast<double>(room.cells) +
         sizeof(Pair) * static_cast<double>(room.doubts + room.pairs);
}

}  // namespace

std::optional<double> available_bytes() {
  std::ifstream meminfo("/proc/meminfo");
  std::string word;
  while (meminfo >> word) {
    double kilobytes = 0.0;
    if (word == "MemAvailable:" && meminfo >> kilobytes) return kilobytes * 1024.0;
  }
  return std::nullopt;
}

void require_memory(const Plan& plan) {
  const double needed = bytes_of(plan.capacity);
  const std::optional<double> available = available_bytes();
  if (!available || needed <= *available) return;
  throw LimitError(fmt::format(
      "{} pairs and {} cell ids need {:.1f} GiB, and {:.1f} GiB are available; counting (--count) "
      "needs no memory for pairs",
      plan.capacity.pairs, plan.capacity.ids, needed / kGiB, *available / kGiB));
}

}  // namespace octocell
