// SPDX-License-Identifier: MIT
// The header of NumPy's file format (numpy.lib.format, versions 1.0 to 3.0): magic, version,
// length, and a Python dictionary as text.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/available_memory.hpp"
#include "harness/files/input_file.hpp"

namespace octocell {

struct NpyHeader {
  std::string descr;                 // "<f4": little-endian float32
  bool fortran_order = false;        // columns first
  std::vector<std::uint64_t> shape;  // rows, columns, ...
  std::size_t data_offset = 0;       // [bytes] where the numbers begin

  [[nodiscard]] std::string shape_text() const;  // "(10, 4)"
};

/// Reads up to the first number. Throws InputError that says what was found and what was expected.
NpyHeader read_npy_header(InputFile& file);

/// Throws InputError if the file is known to be shorter or longer than that many bytes per row
/// require.
void check_npy_size(const InputFile& file, const NpyHeader& header, std::size_t bytes_per_row);

/// Does the same after reading, for files of unknown size. `bytes_read` counts behind the header.
void check_npy_end(InputFile& file, const NpyHeader& header, std::size_t bytes_per_row,
                   std::uint64_t bytes_read);

/// Reads the rows behind the header without conversion. If the file's size is unknown, memory grows
/// with what was read, because a header can claim anything.
template <typename Row>
std::vector<Row> read_npy_rows(InputFile& file, const NpyHeader& header) {
  check_npy_size(file, header, sizeof(Row));
  constexpr std::uint64_t kAtOnce = (std::uint64_t{64} << 20) / sizeof(Row);
  const std::uint64_t count = header.shape[0];
  std::vector<Row> rows;
  std::uint64_t bytes_read = 0;
  while (rows.size() < count && bytes_read == rows.size() * sizeof(Row)) {
    const std::uint64_t known = file.size() ? count : rows.size() + kAtOnce;
    const std::size_t begin = rows.size();
    require_memory(static_cast<double>(std::min(known, count) - begin) * sizeof(Row), file.path());
    rows.resize(std::min(known, count));
    bytes_read += file.read(std::as_writable_bytes(std::span(rows).subspan(begin)));
  }
  check_npy_end(file, header, sizeof(Row), bytes_read);
  return rows;
}

/// Returns the bytes before the numbers of an array in C order. `shape` is as Python writes it:
/// "(10, 4)".
std::string npy_header_bytes(std::string_view descr, std::string_view shape);

}  // namespace octocell
