// SPDX-License-Identifier: MIT
// Tables of numbers, one sphere a line: CSV, or text as YADE, voro++ and numpy.savetxt write it.
//   x,y,z,r        with commas, semicolons, tabs or blanks between
// A first line without any number is a header and names the columns, in any order. A header may be
// in a comment, as numpy.savetxt writes it. Columns may also hold flags: static (0 or 1), group,
// mask. '#' begins a comment; blank lines are skipped.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/files/decimal.hpp"
#include "harness/files/line_reader.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/files/table_columns.hpp"
#include "harness/files/table_guess.hpp"
#include "harness/files/table_line.hpp"
#include "harness/files/validate.hpp"

namespace octocell {
namespace {

std::optional<TableColumns> columns_of(const LoadOptions& options) {
  if (!options.columns) return std::nullopt;
  std::vector<std::string_view> names;
  split_fields(*options.columns, Separator::comma, names);
  if (auto columns = TableColumns::named_by(names)) return columns;
  throw InputError(
      fmt::format("--columns {}: x, y and z must be there once, r and flags at most once",
                  quote(*options.columns)));
}

class TableReader {
 public:
  TableReader(InputFile& file, const LoadOptions& options)
      : file_(file), options_(options), lines_(file), columns_(columns_of(options)) {}

  void read(Scene& scene) {
    bool has_row = skip_header();
    if (has_row) choose_columns(scene);
    TableGuess guess(fields_.size());
    for (; has_row; has_row = next_row()) {
      check_field_count();
      add_row(scene, guess);
    }
    if (!is_guess_) return;
    if (const std::string other = guess.other_meaning(); !other.empty()) {
      file_.refuse(first_row_, other);
    }
  }

 private:
  /// Goes to the next line with fields. Returns false if there is none.
  bool next_row() {
    while (const auto raw = lines_.next()) {
      line_ = split_comment(*raw);
      if (!trim(line_.text).empty()) {
        split_fields(line_.text, separator(), fields_);
        return true;
      }
      if (!separator_ && !line_.comment.empty()) note_comment();
    }
    return false;
  }

  /// Goes to the first line of numbers. Returns false if there is none.
  bool skip_header() {
    while (next_row()) {
      if (!holds_no_number()) return true;
      auto named = TableColumns::named_by(fields_);
      if (header_row_ != 0 && !named) return true;  // reported as a bad row
      take_header(std::move(named));
    }
    if (!columns_ && !commented_) file_.refuse("neither a header nor a sphere");
    return false;
  }

  void take_header(std::optional<TableColumns> named) {
    if (!named) {
      refuse_line(fmt::format("neither numbers nor a header with x, y, z and r, each once{}",
                              hint(fields_.front())));
    }
    if (header_row_ != 0) {
      refuse_line(fmt::format("a second header, behind that of line {}", header_row_));
    }
    header_row_ = lines_.number();
    if (!columns_) columns_ = std::move(named);
  }

  /// Stores a header in a comment, which counts if there is no other header.
  void note_comment() {
    auto named = TableColumns::named_by_comment(line_.comment);
    if (!named) return;
    if (commented_ && *commented_ != *named) {
      file_.refuse(lines_.number(), "another header than in the comment before");
    }
    commented_ = std::move(named);
  }

  /// Called at the first line of numbers.
  void choose_columns(Scene& scene) {
    first_row_ = lines_.number();
    if (!columns_ && fields_.back().empty()) fields_.pop_back();
    if (!columns_ && commented_ && commented_->field_count() == fields_.size()) {
      columns_ = std::move(commented_);
    }
    if (!columns_) {
      columns_ = TableColumns::without_header(fields_.size());
      is_guess_ = true;
    }
    if (!columns_) {
      refuse_line(fmt::format("{} field{} and no header, expected x y z r; --columns names them",
                              fields_.size(), fields_.size() == 1 ? "" : "s"));
    }
    check_radii();
    const std::string unread = columns_->unread_text();
    if (is_guess_ && !unread.empty()) {
      scene.notes.push_back(fmt::format("no header; taken for columns {}", columns_->text()));
    } else if (!unread.empty()) {
      scene.notes.push_back(fmt::format("columns that are not read: {}", unread));
    }
  }

  void check_radii() {
    const bool has_radii = columns_->have(Column::r);
    if (!has_radii && !options_.radius) {
      refuse_line(fmt::format("no radii in columns {}; --radius R gives all spheres one",
                              columns_->text()));
    }
    if (has_radii && options_.radius) {
      refuse_line(fmt::format("radii in columns {}; --radius is for files without radii",
                              columns_->text()));
    }
  }

  /// A separator at the end of a line does not begin another field.
  void check_field_count() {
    const std::size_t expected = columns_->field_count();
    if (fields_.size() == expected + 1 && fields_.back().empty()) fields_.pop_back();
    if (fields_.size() == expected) return;
    refuse_line(fmt::format("{} field{}, expected {} with {} between ({})", fields_.size(),
                            fields_.size() == 1 ? "" : "s", expected, name_of(separator()),
                            columns_->text()));
  }

  void add_row(Scene& scene, TableGuess& guess) {
    if (scene.spheres.size() == kMaxSpheres) {
      file_.refuse(lines_.number(), fmt::format("more than {} spheres", kMaxSpheres));
    }
    const Sphere sphere = sphere_in_line();
    if (is_guess_) guess.add(fields_.front(), sphere);
    if (!options_.drop_invalid) {
      if (const std::string flaw = flaw_of(sphere); !flaw.empty()) {
        const bool may_be_z = is_guess_ && sphere.r < 0 && guess.may_be_id_x_y_z();
        refuse_line(flaw + (may_be_z ? "; if it is the z of an id: --columns id,x,y,z" : ""));
      }
    }
    append_within_memory(scene.spheres, sphere, file_.path());
    if (columns_->have_flags()) append_within_memory(scene.flags, flags_in_line(), file_.path());
  }

  Sphere sphere_in_line() const {
    const auto value = [this](Column c) { return number_in(fields_[columns_->field_of(c)]); };
    return {value(Column::x), value(Column::y), value(Column::z),
            options_.radius ? *options_.radius : value(Column::r)};
  }

  /// A missing column gets the value that a sphere without flags has.
  Flags flags_in_line() const {
    const auto value = [this](Column column, std::uint32_t highest, std::uint32_t if_none) {
      return columns_->have(column) ? whole_in(column, highest) : if_none;
    };
    return make_flags(value(Column::is_static, 1, 0) == 1, value(Column::group, kMaxGroup, 1),
                      value(Column::mask, kMaxMask, kMaxMask));
  }

  /// With decimal commas, a point would separate thousands; such a field is no number.
  [[nodiscard]] DecimalFloat parse(std::string_view field) const {
    if (!options_.decimal_comma) return parse_float(field);
    std::string text(field);
    for (char& c : text) c = c == ',' ? '.' : c == '.' ? ',' : c;
    return parse_float(text);
  }

  [[nodiscard]] bool holds_no_number() const {
    return std::ranges::all_of(fields_, [this](std::string_view field) {
      return parse(field).kind == DecimalFloat::Kind::not_a_number;
    });
  }

  [[nodiscard]] float number_in(std::string_view field) const {
    if (options_.drop_invalid && field.empty()) return std::numeric_limits<float>::quiet_NaN();
    const DecimalFloat parsed = parse(field);
    const bool too_large = parsed.kind == DecimalFloat::Kind::too_large;
    if (parsed.kind == DecimalFloat::Kind::number || (too_large && options_.drop_invalid)) {
      return parsed.value;
    }
    refuse_line(fmt::format("{} is {}{}", quote(field),
                            too_large ? "too large for float32" : "not a number", hint(field)));
  }

  /// Returns a hint if the field is a number with a decimal comma.
  [[nodiscard]] std::string_view hint(std::string_view field) const {
    if (separator_ == Separator::comma) return "";
    std::string with_point(field);
    std::ranges::replace(with_point, ',', '.');
    const bool is_number = parse_float(with_point).kind == DecimalFloat::Kind::number;
    return is_number ? "; --decimal-comma reads a comma as a point" : "";
  }

  [[nodiscard]] std::uint32_t whole_in(Column column, std::uint32_t highest) const {
    const std::string_view text = fields_[columns_->field_of(column)];
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && stop == text.data() + text.size() && number <= highest) {
      return number;
    }
    refuse_line(fmt::format("{} is {} (must be {} {})",
                            kColumnNames[static_cast<std::size_t>(column)], quote(text),
                            highest == 1 ? "0 or" : "a whole number from 0 to", highest));
  }

  /// All lines have the separator of the first line with fields.
  Separator separator() {
    if (!separator_) separator_ = separator_in(line_.text, options_.decimal_comma);
    return *separator_;
  }

  [[noreturn]] void refuse_line(const std::string& why) const {
    file_.refuse(lines_.number(), fmt::format("{}: {}", why, quote(trim(line_.text))));
  }

  InputFile& file_;
  const LoadOptions& options_;
  LineReader lines_;
  TableLine line_ = {};
  std::vector<std::string_view> fields_ = {};
  std::optional<Separator> separator_ = {};
  std::optional<TableColumns> columns_;         // from the caller or a header
  std::optional<TableColumns> commented_ = {};  // from a header in a comment
  std::size_t header_row_ = 0;                  // 0: none
  std::size_t first_row_ = 0;
  bool is_guess_ = false;  // the number of fields tells the columns
};

}  // namespace

void load_table(InputFile& file, const LoadOptions& options, Scene& scene) {
  TableReader(file, options).read(scene);
}

}  // namespace octocell
