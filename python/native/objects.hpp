// SPDX-License-Identifier: MIT
// The library's objects that live on between calls from Python.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "python/native/options.hpp"

namespace octocell::python {

/// Chunks that keep alive what they read.
class HeldChunks {
 public:
  HeldChunks(SphereArray spheres, std::uint64_t pairs_per_chunk, SearchOptions options)
      : spheres_(std::move(spheres)),
        options_(std::move(options)),
        chunks_(spheres_of(spheres_), pairs_per_chunk, options_.for_library()) {}

  Pairs next() { return chunks_.next(); }

 private:
  SphereArray spheres_;
  SearchOptions options_;
  Chunks chunks_;
};

/// A Finder whose pairs can be lent to arrays. As long as such an array lives, nothing else may be
/// done.
class LendingFinder {
 public:
  explicit LendingFinder(const SearchOptions& options)
      : finder_(std::make_shared<Finder>(options.for_library())) {}

  /// Returns the pairs of this frame as an array, in memory of its own or, if `lend`, in the
  /// finder's.
  nb::object find(const SphereArray& spheres, bool lend);

 private:
  std::shared_ptr<Finder> finder_;
  std::weak_ptr<Finder> lent_;
};

}  // namespace octocell::python
