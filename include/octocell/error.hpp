// SPDX-License-Identifier: MIT
// The one type that the library throws.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "export.h"

namespace octocell {

enum class ErrorKind : std::uint8_t {
  invalid_sphere,    // a number is not finite, or r < 0; sphere() is the first such sphere
  invalid_argument,  // another argument that cannot be used; nothing was done
  limit,             // the request is sound, but larger than this implementation allows
  memory,            // it needs more memory than this process can have
  unavailable,       // the device is not there, or the library was built without it
  stopped,           // Options::stop asked for it
  internal,          // anything else, for example an error that a GPU's driver reports
};

/// what() is one line that says what went wrong and where.
class OCTOCELL_API Error : public std::runtime_error {
 public:
  explicit Error(const std::string& line, ErrorKind kind = ErrorKind::internal,
                 std::optional<std::uint64_t> sphere = {})
      : std::runtime_error(line), kind_(kind), sphere_(sphere) {}

  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
  /// Returns the position of the sphere that caused the error; none if no single one did.
  [[nodiscard]] std::optional<std::uint64_t> sphere() const noexcept { return sphere_; }

 private:
  ErrorKind kind_;
  std::optional<std::uint64_t> sphere_;
};

}  // namespace octocell
