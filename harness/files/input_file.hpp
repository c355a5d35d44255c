// SPDX-License-Identifier: MIT
// A file opened for reading, or standard input. Every failure is an InputError with the path and
// the reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "harness/files/byte_source.hpp"
#include "harness/files/gunzip.hpp"

namespace octocell {

/// The path that means standard input.
inline constexpr std::string_view kStandardInput = "-";

class InputFile {
 public:
  /// Opens `path`, or standard input for "-". If the bytes are packed by gzip, reading unpacks
  /// them. Throws if the path is no regular file, or if there is not at least one byte.
  explicit InputFile(std::string path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }  // or "standard input"

  /// Returns the number of bytes to read; none if it is unknown, as for packed files and pipes.
  [[nodiscard]] std::optional<std::uint64_t> size() const { return size_; }

  /// Returns the first few thousand bytes, or all. They remain to be read.
  [[nodiscard]] std::string_view beginning() const { return bytes_->beginning(); }

  /// Fills the span as far as there are bytes. Returns how many it wrote.
  std::size_t read(std::span<std::byte> bytes) { return bytes_->read(bytes); }

  /// Throws InputError "PATH: message".
  [[noreturn]] void refuse(std::string_view message) const;
  /// Throws InputError "PATH:line: message".
  [[noreturn]] void refuse(std::size_t line, std::string_view message) const;

 private:
  /// Closes its descriptor, unless that is standard input.
  struct Descriptor {
    int number = -1;
    Descriptor() = default;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor();
  };

  void open_file();
  std::size_t read_descriptor(std::span<std::byte> bytes);
  std::size_t unpack(std::span<std::byte> bytes);

  std::string path_;
  std::optional<std::uint64_t> size_ = {};
  Descriptor descriptor_ = {};
  std::unique_ptr<PeekedSource> packed_ = {};  // of a packed file
  std::unique_ptr<Gunzip> gunzip_ = {};
  std::unique_ptr<PeekedSource> bytes_ = {};
};

}  // namespace octocell
