// SPDX-License-Identifier: MIT
#include "harness/files/line_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace octocell {
namespace {

constexpr std::size_t kReadAtOnce = std::size_t{1} << 16;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // spreadsheets write it

bool is_utf16(std::string_view beginning) {
  return beginning.starts_with("\xff\xfe") || beginning.starts_with("\xfe\xff");
}

}  // namespace

LineReader::LineReader(InputFile& file) : file_(file) {
  if (is_utf16(file.beginning())) file.refuse(1, "text in UTF-16, expected UTF-8 or ASCII");
}

void LineReader::read_more() {
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t kept = buffer_.size();
  buffer_.resize(kept + kReadAtOnce);
  const std::size_t got = file_.read(std::as_writable_bytes(std::span(buffer_).subspan(kept)));
  buffer_.resize(kept + got);
  all_read_ = got < kReadAtOnce;
}

std::string_view LineReader::without_ends(std::string_view line) const {
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (number_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  if (line.find('\r') != std::string_view::npos) {
    file_.refuse(number_, "CR within a line, expected lines that end with LF or CR LF");
  }
  return line;
}

std::optional<std::string_view> LineReader::next() {
  std::size_t end = end_of_line();
  while (end == std::string::npos && !all_read_) {
    if (buffer_.size() - begin_ > kLongestLine) {
      file_.refuse(number_ + 1, fmt::format("a line of more than {} bytes", kLongestLine));
    }
    read_more();
    end = end_of_line();
  }
  const bool is_last = end == std::string::npos;
  if (begin_ == buffer_.size()) return std::nullopt;
  ++number_;
  const std::string_view line = std::string_view(buffer_).substr(begin_, end - begin_);
  begin_ = is_last ? buffer_.size() : end + 1;
  return without_ends(line);
}

}  // namespace octocell
