// SPDX-License-Identifier: MIT
// The sorts that are compared, behind one interface: arrays of keys and values in, sorted arrays of
// keys and values out.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octocell::bench {

struct PairArrays {
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> values;
};

/// The memory in which every sort of a case works; allocated and touched before anything is timed.
struct Workspace {
  explicit Workspace(std::size_t n) : front{column(n), column(n)}, back(front), packed(n) {}

  PairArrays front;  // holds the input
  PairArrays back;
  std::vector<std::uint64_t> packed;  // for sorts of one array: key << 32 | value

 private:
  static std::vector<std::uint32_t> column(std::size_t n) { return std::vector<std::uint32_t>(n); }
};

class Sorter {
 public:
  virtual ~Sorter() = default;
  /// Sorts `front` by its keys, all below 2^bits; returns the result. Only this is timed.
  virtual const PairArrays& sort(Workspace& work, int bits) = 0;
};

struct Algorithm {
  std::string_view name;
  bool stable;    // promises that equal keys keep their order
  bool packed;    // sorts one array, so its time includes packing and unpacking
  bool parallel;  // also has a row with several threads
  bool slow;      // a comparison sort
  std::unique_ptr<Sorter> (*create)(int threads);  // null: not in this build
  std::string_view why_missing = {};
};

/// Returns all sorts, including those that this build lacks, in the order of every table.
const std::vector<Algorithm>& sort_algorithms();

/// Name and version of a sorting library; none if this build lacks it.
struct LibraryVersion {
  std::string_view name;
  std::optional<std::string> version;
};
std::vector<LibraryVersion> sort_libraries();

}  // namespace octocell::bench
