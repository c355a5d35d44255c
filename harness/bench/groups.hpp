// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/bench/bench.hpp"

namespace octocell::bench {

/// Rows that are interleaved with each other: one scene at one size.
struct Group {
  std::string scene;             // label: generator or file stem
  std::uint64_t n = 0;           // spheres
  std::string argument;          // for load_or_generate()
  std::string unavailable = {};  // why a real scene is not there; empty if it is
  bool real = false;             // a file fetched at set-up; it may be missing
  int rounds = 5;
  bool slow_rows = true;  // false: at this size only the fastest of each family
};

/// The groups that the options ask for, small ones first. Scenes that the caller named are loaded
/// once to learn their sizes; a second one of the same name and size is called NAME#2. Throws
/// InputError for what cannot be had; a real scene of a preset that was not fetched is only marked
/// unavailable.
std::vector<Group> choose_groups(const BenchOptions& options);

/// More candidate pairs than this, counted beforehand, and a row is skipped with their number.
std::uint64_t candidate_limit(const BenchOptions& options);

}  // namespace octocell::bench
