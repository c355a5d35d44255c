// SPDX-License-Identifier: MIT
// Reads the lines of a text file one at a time, because a file may be larger than memory.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "harness/files/input_file.hpp"

namespace octocell {

/// Lines end with LF or CR LF. A UTF-8 byte order mark at the beginning is removed.
class LineReader {
 public:
  /// Longer lines are refused: such a file is not a table of numbers.
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

  /// Throws InputError for text in UTF-16.
  explicit LineReader(InputFile& file);

  /// Returns the next line without its end; none after the last. It stays valid until the next
  /// call. Throws InputError.
  std::optional<std::string_view> next();

  [[nodiscard]] std::size_t number() const {
    return number_;
  }  // of the last line returned; the
     // first is 1

 private:
  [[nodiscard]] std::size_t end_of_line() const { return buffer_.find('\n', begin_); }
  void read_more();
  [[nodiscard]] std::string_view without_ends(std::string_view line) const;

  InputFile& file_;
  bool all_read_ = false;
  std::string buffer_;
  std::size_t begin_ = 0;  // of the next line in the buffer
  std::size_t number_ = 0;
};

}  // namespace octocell
