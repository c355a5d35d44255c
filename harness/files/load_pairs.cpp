// SPDX-License-Identifier: MIT
#include "harness/files/load_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

#include "core/available_memory.hpp"
#include "core/text.hpp"
#include "harness/files/line_reader.hpp"
#include "harness/files/npy_header.hpp"
#include "harness/files/table_line.hpp"

namespace octocell {
namespace {

static_assert(std::endian::native == std::endian::little);

/// An integer type of NumPy: "<i4", "|u1", ">i8".
struct IntegerType {
  std::size_t bytes;
  bool is_signed;
  bool is_big_endian;
};

std::optional<IntegerType> integer_type(std::string_view descr) {
  if (descr.size() != 3 || std::string_view("<>|=").find(descr[0]) == std::string_view::npos)
    return std::nullopt;
  if (descr[1] != 'i' && descr[1] != 'u') return std::nullopt;
  const auto bytes = static_cast<std::size_t>(descr[2] - '0');
  if (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8) return std::nullopt;
  return IntegerType{bytes, descr[1] == 'i', descr[0] == '>'};
}

/// Returns the number in `bytes`, which it may reverse.
std::int64_t number_in(std::span<std::byte> bytes, IntegerType type) {
  if (type.is_big_endian) std::ranges::reverse(bytes);
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), bytes.size());
  const int unused = 64 - 8 * static_cast<int>(bytes.size());
  const auto raised = static_cast<std::int64_t>(value << unused);
  return type.is_signed ? raised >> unused : static_cast<std::int64_t>(value);
}

template <std::size_t Bytes>
std::vector<std::byte> read_rows(InputFile& file, const NpyHeader& header) {
  using Row = std::array<std::byte, 2 * Bytes>;
  const std::vector<Row> rows = read_npy_rows<Row>(file, header);
  const auto bytes = std::as_bytes(std::span(rows));
  return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> read_numbers(InputFile& file, const NpyHeader& header, std::size_t bytes) {
  switch (bytes) {
    case 1:
      return read_rows<1>(file, header);
    case 2:
      return read_rows<2>(file, header);
    case 4:
      return read_rows<4>(file, header);
    default:
      return read_rows<8>(file, header);
  }
}

std::vector<ListedPair> load_npy_pairs(InputFile& file) {
  const NpyHeader header = read_npy_header(file);
  const auto type = integer_type(header.descr);
  if (!type) file.refuse(fmt::format("numbers of type {}, expected integers", quote(header.descr)));
  if (header.shape.size() != 2 || header.shape[1] != 2) {
    const bool is_lying = header.shape.size() == 2 && header.shape[0] == 2;
    file.refuse(fmt::format("shape {}, expected (m, 2): one pair a row{}", header.shape_text(),
                            is_lying ? "; save the transposed array" : ""));
  }
  std::vector<std::byte> bytes = read_numbers(file, header, type->bytes);
  const std::size_t count = header.shape[0];
  require_memory(static_cast<double>(count) * sizeof(ListedPair), file.path());
  const auto number = [&](std::size_t at) {
    return number_in(std::span(bytes).subspan(at * type->bytes, type->bytes), *type);
  };
  std::vector<ListedPair> pairs(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (header.fortran_order) {
      pairs[k] = {number(k), number(count + k)};
    } else {
      pairs[k] = {number(2 * k), number(2 * k + 1)};
    }
  }
  return pairs;
}

/// Returns the whole number that a field holds; also 3.0 and 3e0, as numpy.savetxt writes them.
std::optional<std::int64_t> whole_number(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  const char* const end = field.data() + field.size();
  std::int64_t whole = 0;
  const auto integer = std::from_chars(field.data(), end, whole);
  if (integer.ec == std::errc{} && integer.ptr == end) return whole;
  double value = 0.0;
  const auto decimal = std::from_chars(field.data(), end, value);
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (decimal.ec != std::errc{} || decimal.ptr != end || !(std::abs(value) <= kExact))
    return std::nullopt;
  if (value != std::floor(value)) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

bool is_word(std::string_view field) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !field.empty() && is_letter(field.front());
}

std::vector<ListedPair> load_text_pairs(InputFile& file) {
  LineReader lines(file);
  std::vector<ListedPair> pairs;
  std::vector<std::string_view> fields;
  bool may_be_header = true;
  while (const auto line = lines.next()) {
    const std::string_view text = trim(split_comment(*line).text);
    if (text.empty()) continue;
    split_fields(text, separator_in(text, false), fields);
    if (fields.size() == 3 && fields.back().empty()) fields.pop_back();
    if (may_be_header && std::ranges::all_of(fields, is_word)) {
      may_be_header = false;
      continue;
    }
    may_be_header = false;
    if (fields.size() != 2) {
      file.refuse(lines.number(),
                  fmt::format("{} field{}, expected the two numbers of a pair: {}", fields.size(),
                              fields.size() == 1 ? "" : "s", quote(text)));
    }
    const auto i = whole_number(fields[0]);
    const auto j = whole_number(fields[1]);
    if (!i || !j) {
      file.refuse(lines.number(), fmt::format("{} is not a whole number: {}",
                                              quote(fields[i ? 1 : 0]), quote(text)));
    }
    append_within_memory(pairs, ListedPair{*i, *j}, file.path());
  }
  return pairs;
}

bool is_empty_file(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && std::filesystem::is_empty(path, error);
}

}  // namespace

std::vector<ListedPair> load_pairs(const std::string& path) {
  if (path != kStandardInput && is_empty_file(path)) return {};
  InputFile file(path);
  return file.beginning().starts_with("\x93NUMPY") ? load_npy_pairs(file) : load_text_pairs(file);
}

}  // namespace octocell
