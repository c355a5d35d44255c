// SPDX-License-Identifier: MIT
// The header of NumPy's file format (numpy.lib.format, versions 1.0 to 3.0): magic, version,
// length, and a Python dictionary as text.
#pragma once

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

/// Throws InputError if the file is shorter or longer than that many bytes per row require.
void check_npy_size(const InputFile& file, const NpyHeader& header, std::size_t bytes_per_row);

/// Reads the rows behind the header without conversion.
template <typename Row>
std::vector<Row> read_npy_rows(InputFile& file, const NpyHeader& header) {
  check_npy_size(file, header, sizeof(Row));
  require_memory(static_cast<double>(header.shape[0]) * sizeof(Row), file.path());
  std::vector<Row> rows(header.shape[0]);
  file.read(std::as_writable_bytes(std::span(rows)));
  return rows;
}

/// Returns the bytes before the numbers of an array in C order. `shape` is as Python writes it:
/// "(10, 4)".
std::string npy_header_bytes(std::string_view descr, std::string_view shape);

}  // namespace octocell
