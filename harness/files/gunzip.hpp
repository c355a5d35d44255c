// SPDX-License-Identifier: MIT
// Unpacks gzip data while they are read.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

#include "harness/files/byte_source.hpp"

namespace octocell {

/// Thrown for damaged or truncated data. what() does not name the file.
struct GunzipError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Gunzip {
 public:
  static bool is_packed(std::string_view beginning) { return beginning.starts_with("\x1f\x8b"); }

  explicit Gunzip(ByteSource packed);
  ~Gunzip();
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;

  /// Does what a ByteSource does. Several members in a row count as one file. After the last,
  /// only zero bytes may follow. Throws GunzipError.
  std::size_t read(std::span<std::byte> bytes);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace octocell
