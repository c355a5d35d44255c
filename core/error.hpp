// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "include/octocell/error.hpp"

namespace octocell {

/// A file, a scene, a name or a flag that cannot be used. The command line exits with 2.
struct InputError : Error {
  explicit InputError(const std::string& line, ErrorKind kind = ErrorKind::invalid_argument,
                      std::optional<std::uint64_t> sphere = {})
      : Error(line, kind, sphere) {}
};

/// The request is sound, but a rule's conditions do not hold for this scene, or it needs more
/// than this machine or this implementation has.
struct LimitError : Error {
  explicit LimitError(const std::string& line, ErrorKind kind = ErrorKind::limit)
      : Error(line, kind) {}
};

/// The request needs more memory than this process can have.
struct MemoryError : LimitError {
  explicit MemoryError(const std::string& line) : LimitError(line, ErrorKind::memory) {}
};

/// The caller no longer wants the answer.
struct Stopped : Error {
  Stopped() : Error("stopped as the caller asked", ErrorKind::stopped) {}
};

}  // namespace octocell
