// SPDX-License-Identifier: MIT
// CSV: one sphere a line, `x,y,z,r`. A first line that holds no number is a header and names the
// four columns, in any order; a header may stand in a comment, as numpy.savetxt writes it. '#'
// begins a comment; blank lines are skipped.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "harness/scenes/load_formats.hpp"
#include "harness/scenes/text.hpp"
#include "harness/scenes/validate.hpp"

namespace octocell {
namespace {

using Columns = std::array<std::size_t, 4>;  // the field that holds x, y, z, r
constexpr std::string_view kNames = "xyzr";

struct Line {
  std::string_view text;
  std::string_view comment;
  std::size_t number;  // from 1
};

struct Fields {
  std::array<std::string_view, 4> field;  // the first four
  std::size_t count = 0;                  // all of them
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

/// The columns that a header names, if it names each of the four once.
std::optional<Columns> columns_named_in(std::string_view header) {
  const Fields names = split(header);
  if (names.count != names.field.size()) return std::nullopt;
  Columns columns = {};
  unsigned seen = 0;
  for (std::size_t k = 0; k < names.count; ++k) {
    const std::string name = lower_case(names.field[k]);
    const std::size_t which = name.size() == 1 ? kNames.find(name) : std::string_view::npos;
    if (which == std::string_view::npos) return std::nullopt;
    columns[which] = k;
    seen |= 1U << which;
  }
  return seen == 0xfU ? std::optional(columns) : std::nullopt;
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

Sphere sphere_in(const InputFile& file, const Line& line, const Columns& columns) {
  const Fields fields = split(line.text);
  if (fields.count != fields.field.size()) {
    file.refuse(line.number,
                fmt::format("{} field{}, expected 4 with commas between (x,y,z,r): {}",
                            fields.count, fields.count == 1 ? "" : "s", quote(line.text)));
  }
  const auto value = [&](std::size_t k) { return number_in(file, line, fields.field[columns[k]]); };
  const Sphere sphere{value(0), value(1), value(2), value(3)};
  if (const std::string flaw = flaw_of(sphere); !flaw.empty()) {
    file.refuse(line.number, fmt::format("{}: {}", flaw, quote(line.text)));
  }
  return sphere;
}

class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets write it
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  std::optional<Line> next() {
    const auto raw = next_line(rest_);
    if (!raw) return std::nullopt;
    const std::size_t mark = std::min(raw->find('#'), raw->size());
    return Line{trim(raw->substr(0, mark)), trim(raw->substr(std::min(mark + 1, raw->size()))),
                ++number_};
  }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// Skips to the first sphere's line and returns it, if there is one. The last header before it
/// counts; numpy.savetxt writes its header as a comment.
std::optional<Line> skip_header(const InputFile& file, LineReader& lines, Columns& columns) {
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

std::vector<Sphere> load_csv(InputFile& file) {
  const std::string text = file.read_all();
  LineReader lines(text);
  Columns columns = {0, 1, 2, 3};
  std::vector<Sphere> spheres;
  for (auto line = skip_header(file, lines, columns); line; line = lines.next()) {
    if (line->text.empty()) continue;
    if (spheres.size() == kMaxSpheres) {
      file.refuse(line->number, fmt::format("more than {} spheres", kMaxSpheres));
    }
    spheres.push_back(sphere_in(file, *line, columns));
  }
  return spheres;
}

}  // namespace octocell
