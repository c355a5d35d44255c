// SPDX-License-Identifier: MIT
// How Python's keyword arguments reach the library, and how its errors come back.
#pragma once

#include <optional>

#include "python/native/arrays.hpp"

namespace octocell::python {

/// The options that every search has. They keep the array of flags alive.
struct SearchOptions {
  int threads = 0;
  bool sorted = true;
  bool on_gpu = false;
  std::optional<FlagArray> flags;

  /// The result borrows from this object.
  [[nodiscard]] Options for_library() const;
};

/// Lets Error arrive in Python as the exceptions of octocell/_errors.py.
void translate_errors();

}  // namespace octocell::python
