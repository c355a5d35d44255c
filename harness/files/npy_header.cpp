// SPDX-License-Identifier: MIT
#include "harness/files/npy_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>
#include <system_error>

#include "core/text.hpp"

namespace octocell {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kVersionBytes = 2;
constexpr std::size_t kLongestDictionary = 65536;  // NumPy's own have about 120 bytes

/// Reads the dictionary token by token: three keys in any order, and nothing else.
class DictionaryReader {
 public:
  DictionaryReader(std::string_view text, const InputFile& file) : rest_(text), file_(file) {}

  NpyHeader read() {
    NpyHeader header;
    expect('{');
    while (!accept('}')) {
      read_entry(header);
      if (accept(',')) continue;
      expect('}');
      break;
    }
    if (!trim_line(rest_).empty()) fail("nothing after '}'");
    if (seen_.size() != 3) fail("the keys descr, fortran_order and shape");
    return header;
  }

 private:
  static std::string_view trim_line(std::string_view text) {
    if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    return trim(text);
  }

  [[noreturn]] void fail(std::string_view expected) const {
    file_.refuse(fmt::format("NPY header: expected {}, found {}", expected,
                             rest_.empty() ? "its end" : quote(trim_line(rest_))));
  }

  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }

  bool accept(std::string_view token) {
    skip_blanks();
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  bool accept(char token) { return accept(std::string_view(&token, 1)); }

  void expect(char token) {
    if (!accept(token)) fail(fmt::format("'{}'", token));
  }

  std::string read_string() {
    const char mark = accept('"') ? '"' : '\'';
    if (mark == '\'' && !accept('\'')) fail("a word in quotes");
    const std::size_t end = rest_.find(mark);
    if (end == std::string_view::npos) fail("a closing quote");
    std::string word(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return word;
  }

  bool read_bool() {
    if (accept("True")) return true;
    if (!accept("False")) fail("True or False");
    return false;
  }

  std::vector<std::uint64_t> read_shape() {
    std::vector<std::uint64_t> shape;
    expect('(');
    while (!accept(')')) {
      skip_blanks();
      std::uint64_t extent = 0;
      const auto parsed = std::from_chars(rest_.data(), rest_.data() + rest_.size(), extent);
      if (parsed.ec != std::errc{}) fail("a whole number");
      rest_.remove_prefix(static_cast<std::size_t>(parsed.ptr - rest_.data()));
      shape.push_back(extent);
      if (accept(',')) continue;
      expect(')');
      break;
    }
    return shape;
  }

  void read_entry(NpyHeader& header) {
    const std::string key = read_string();
    for (const std::string& other : seen_) {
      if (key == other) fail(fmt::format("'{}' only once", key));
    }
    expect(':');
    if (key == "descr") {
      if (accept('[')) fail("one type for all numbers before");
      header.descr = read_string();
    } else if (key == "fortran_order") {
      header.fortran_order = read_bool();
    } else if (key == "shape") {
      header.shape = read_shape();
    } else {
      fail(fmt::format("descr, fortran_order or shape instead of {} before", quote(key)));
    }
    seen_.push_back(key);
  }

  std::string_view rest_;
  const InputFile& file_;
  std::vector<std::string> seen_;
};

void read_part(InputFile& file, std::span<std::byte> bytes) {
  if (file.read(bytes) < bytes.size()) file.refuse("truncated: the NPY header is not complete");
}

/// Reads a little-endian number.
std::size_t read_number(InputFile& file, std::size_t byte_count) {
  std::byte bytes[4] = {};
  read_part(file, std::span(bytes).first(byte_count));
  std::size_t number = 0;
  for (std::size_t k = 0; k < byte_count; ++k) {
    number |= std::to_integer<std::size_t>(bytes[k]) << (8 * k);
  }
  return number;
}

void expect_magic(InputFile& file) {
  const std::string_view magic = file.beginning().substr(0, kMagic.size());
  if (magic != kMagic) {
    file.refuse(fmt::format("not an NPY file: it begins with {}, expected {}", quote(magic),
                            quote(kMagic)));
  }
  std::byte passed_over[kMagic.size()];
  read_part(file, passed_over);
}

[[noreturn]] void refuse_size(const InputFile& file, const NpyHeader& header, std::uint64_t needed,
                              std::string_view what, std::string_view has) {
  file.refuse(
      fmt::format("{}: shape {} needs {} bytes, {}", what, header.shape_text(), needed, has));
}

std::uint64_t bytes_needed(const NpyHeader& header, std::size_t bytes_per_row) {
  return header.data_offset + header.shape[0] * bytes_per_row;
}

}  // namespace

std::string NpyHeader::shape_text() const {
  std::string text;
  for (const std::uint64_t extent : shape) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", extent);
  }
  return fmt::format("({}{})", text, shape.size() == 1 ? "," : "");
}

NpyHeader read_npy_header(InputFile& file) {
  expect_magic(file);
  const std::size_t version_end = kMagic.size() + kVersionBytes;
  const std::size_t major = read_number(file, 1);
  const std::size_t minor = read_number(file, 1);
  if (major < 1 || major > 3 || minor != 0) {
    file.refuse(fmt::format("NPY version {}.{}, expected 1.0, 2.0 or 3.0", major, minor));
  }
  const std::size_t length_bytes = major == 1 ? 2 : 4;
  const std::size_t dictionary_begin = version_end + length_bytes;
  const std::size_t length = read_number(file, length_bytes);
  if (length > kLongestDictionary) {
    file.refuse(fmt::format("NPY header of {} bytes (at most {})", length, kLongestDictionary));
  }
  std::string dictionary(length, '\0');
  read_part(file, std::as_writable_bytes(std::span(dictionary)));
  NpyHeader header = DictionaryReader(dictionary, file).read();
  header.data_offset = dictionary_begin + length;
  return header;
}

void check_npy_size(const InputFile& file, const NpyHeader& header, std::size_t bytes_per_row) {
  const std::uint64_t needed = bytes_needed(header, bytes_per_row);
  if (!file.size() || *file.size() == needed) return;
  refuse_size(file, header, needed, *file.size() < needed ? "truncated" : "too long",
              fmt::format("the file has {}", *file.size()));
}

void check_npy_end(InputFile& file, const NpyHeader& header, std::size_t bytes_per_row,
                   std::uint64_t bytes_read) {
  const std::uint64_t needed = bytes_needed(header, bytes_per_row);
  const std::uint64_t had = header.data_offset + bytes_read;
  std::byte one_more = {};
  if (had < needed) refuse_size(file, header, needed, "truncated", fmt::format("it has {}", had));
  if (file.read({&one_more, 1}) == 1) {
    refuse_size(file, header, needed, "too long", "more follow");
  }
}

std::string npy_header_bytes(std::string_view descr, std::string_view shape) {
  constexpr std::size_t kAlignment = 64;  // so that programs can map the numbers into memory
  std::string dictionary =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", descr, shape);
  const std::size_t begin = kMagic.size() + kVersionBytes + 2;
  const std::size_t end =
      (begin + dictionary.size() + 1 + kAlignment - 1) / kAlignment * kAlignment;
  dictionary.resize(end - begin - 1, ' ');
  dictionary += '\n';
  std::string bytes(kMagic);
  bytes += {'\x01', '\x00'};
  bytes += static_cast<char>(dictionary.size() & 0xff);
  bytes += static_cast<char>(dictionary.size() >> 8);
  return bytes + dictionary;
}

}  // namespace octocell
