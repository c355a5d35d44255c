// SPDX-License-Identifier: MIT
// A file opened for reading. Every failure is an InputError with the path and the reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace octocell {

class InputFile {
 public:
  /// Throws unless `path` is a readable regular file with at least one byte.
  explicit InputFile(std::string path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }  // bytes

  void read(std::span<std::byte> bytes);  // exactly that many, from where the last read ended

  /// Throws InputError "PATH: message".
  [[noreturn]] void refuse(std::string_view message) const;
  /// Throws InputError "PATH:line: message".
  [[noreturn]] void refuse(std::size_t line, std::string_view message) const;

 private:
  std::string path_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;
};

}  // namespace octocell
