// SPDX-License-Identifier: MIT
// CSV: one sphere per line, `x,y,z,r`. If the first line holds no number, it is a header and names
// the columns, in any order. A header may be in a comment, as numpy.savetxt writes it. It may also
// name columns of flags: static (0 or 1), group, mask. '#' begins a comment; blank lines are
// skipped.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "core/available_memory.hpp"
#include "core/text.hpp"
#include "harness/files/decimal.hpp"
#include "harness/files/line_reader.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/files/validate.hpp"

namespace octocell {
namespace {

constexpr std::size_t kNumbers = 4;
constexpr std::array<std::string_view, 7> kNames = {"x", "y", "z", "r", "static", "group", "mask"};
constexpr std::size_t kNoField = kNames.size();

/// The number of the field that holds each name; flags may have none.
struct Columns {
  std::array<std::size_t, kNames.size()> field = {0, 1, 2, 3, kNoField, kNoField, kNoField};
  std::size_t count = kNumbers;
  [[nodiscard]] bool hold_flags() const { return count > kNumbers; }
};

struct Line {
  std::string_view text;
  std::string_view comment;
  std::size_t number;  // from 1
};

struct Fields {
  std::array<std::string_view, kNames.size()> field;  // the first seven fields
  std::size_t count = 0;                              // the number of all fields
};

Fields split(std::string_view text) {
  Fields fields;
  while (true) {
    const std::size_t comma = text.find(',');
    if (fields.count < fields.field.size())
      fields.field[fields.count] = trim(text.substr(0, comma));
    ++fields.count;
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

/// Returns the columns that a header names; none unless it names each of the four once, flags at
/// most once, and nothing else.
std::optional<Columns> columns_named_in(std::string_view header) {
  const Fields names = split(header);
  if (names.count < kNumbers || names.count > kNames.size()) return std::nullopt;
  Columns columns;
  columns.field.fill(kNoField);
  columns.count = names.count;
  for (std::size_t k = 0; k < names.count; ++k) {
    const auto name = std::ranges::find(kNames, lower_case(names.field[k]));
    if (name == kNames.end()) return std::nullopt;
    std::size_t& field = columns.field[static_cast<std::size_t>(name - kNames.begin())];
    if (field != kNoField) return std::nullopt;
    field = k;
  }
  const auto numbers = std::span(columns.field).first(kNumbers);
  return std::ranges::count(numbers, kNoField) == 0 ? std::optional(columns) : std::nullopt;
}

bool holds_no_number(std::string_view text) {
  const Fields fields = split(text);
  for (std::size_t k = 0; k < std::min(fields.count, fields.field.size()); ++k) {
    if (parse_float(fields.field[k]).kind != DecimalFloat::Kind::not_a_number) return false;
  }
  return true;
}

float number_in(const InputFile& file, const Line& line, std::string_view field) {
  const DecimalFloat parsed = parse_float(field);
  if (parsed.kind == DecimalFloat::Kind::number) return parsed.value;
  const bool too_large = parsed.kind == DecimalFloat::Kind::too_large;
  file.refuse(line.number,
              fmt::format("{} is {}: {}", quote(field),
                          too_large ? "too large for float32" : "not a number", quote(line.text)));
}

Fields fields_in(const InputFile& file, const Line& line, const Columns& columns) {
  const Fields fields = split(line.text);
  if (fields.count == columns.count) return fields;
  file.refuse(line.number, fmt::format("{} field{}, expected {} with commas between ({}): {}",
                                       fields.count, fields.count == 1 ? "" : "s", columns.count,
                                       columns.hold_flags() ? "as the header has" : "x,y,z,r",
                                       quote(line.text)));
}

Sphere sphere_in(const InputFile& file, const Line& line, const Fields& fields,
                 const Columns& columns) {
  const auto value = [&](std::size_t k) {
    return number_in(file, line, fields.field[columns.field[k]]);
  };
  const Sphere sphere{value(0), value(1), value(2), value(3)};
  if (const std::string flaw = flaw_of(sphere); !flaw.empty()) {
    file.refuse(line.number, fmt::format("{}: {}", flaw, quote(line.text)));
  }
  return sphere;
}

/// Returns the flags in a line. A missing column gets the value that a sphere without flags has.
Flags flags_in(const InputFile& file, const Line& line, const Fields& fields,
               const Columns& columns) {
  const auto value = [&](std::size_t k, std::uint32_t highest, std::uint32_t if_none) {
    if (columns.field[k] == kNoField) return if_none;
    const std::string_view text = fields.field[columns.field[k]];
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && stop == text.data() + text.size() && number <= highest) {
      return number;
    }
    file.refuse(line.number, fmt::format("{} is {} (must be {} {}): {}", kNames[k], quote(text),
                                         highest == 1 ? "0 or" : "a whole number from 0 to",
                                         highest, quote(line.text)));
  };
  return make_flags(value(4, 1, 0) == 1, value(5, kMaxGroup, 1), value(6, kMaxMask, kMaxMask));
}

/// Reads lines and removes their comments.
class CsvLines {
 public:
  explicit CsvLines(InputFile& file) : lines_(file) {}

  std::optional<Line> next() {
    auto raw = lines_.next();
    if (!raw) return std::nullopt;
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets write this
    if (lines_.number() == 1 && raw->starts_with(kByteOrderMark)) {
      raw->remove_prefix(kByteOrderMark.size());
    }
    const std::size_t mark = std::min(raw->find('#'), raw->size());
    return Line{trim(raw->substr(0, mark)), trim(raw->substr(std::min(mark + 1, raw->size()))),
                lines_.number()};
  }

 private:
  LineReader lines_;
};

/// Skips to the line of the first sphere and returns it, if there is one. The last header before it
/// counts; numpy.savetxt writes its header as a comment.
std::optional<Line> skip_header(const InputFile& file, CsvLines& lines, Columns& columns) {
  bool header_seen = false;
  while (const auto line = lines.next()) {
    const bool comment_only = line->text.empty();
    if (const auto named = columns_named_in(comment_only ? line->comment : line->text)) {
      columns = *named;
      header_seen = true;
      continue;
    }
    if (comment_only) continue;
    if (holds_no_number(line->text)) {
      file.refuse(line->number, fmt::format("neither numbers nor a header with x, y, z and r: {}",
                                            quote(line->text)));
    }
    return line;
  }
  if (!header_seen) file.refuse("neither a header nor a sphere");
  return std::nullopt;
}

}  // namespace

void load_csv(InputFile& file, Scene& scene) {
  CsvLines lines(file);
  Columns columns;
  for (auto line = skip_header(file, lines, columns); line; line = lines.next()) {
    if (line->text.empty()) continue;
    if (scene.spheres.size() == kMaxSpheres) {
      file.refuse(line->number, fmt::format("more than {} spheres", kMaxSpheres));
    }
    const Fields fields = fields_in(file, *line, columns);
    append_within_memory(scene.spheres, sphere_in(file, *line, fields, columns), file.path());
    if (!columns.hold_flags()) continue;
    append_within_memory(scene.flags, flags_in(file, *line, fields, columns), file.path());
  }
}

}  // namespace octocell
