// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace octocell {

/// The base of all errors. what() is one line that says what went wrong and where.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file, a scene, a name or a flag that cannot be used. The command line exits with 2.
struct InputError : Error {
  using Error::Error;
};

/// The request is sound, but a rule's conditions do not hold for this scene, or it needs more
/// than this machine or this implementation has.
struct LimitError : Error {
  using Error::Error;
};

}  // namespace octocell
