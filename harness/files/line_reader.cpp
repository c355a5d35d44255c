// SPDX-License-Identifier: MIT
#include "harness/files/line_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/faults.hpp"

namespace octocell {
namespace {

constexpr std::size_t kReadAtOnce = std::size_t{1} << 20;

}  // namespace

LineReader::LineReader(InputFile& file) : file_(file), unread_(file.size()) {}

void LineReader::read_more() {
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t kept = buffer_.size();
  const auto more = static_cast<std::size_t>(std::min<std::uint64_t>(unread_, kReadAtOnce));
  buffer_.resize(kept + more);
  file_.read(std::as_writable_bytes(std::span(buffer_).subspan(kept)));
  unread_ -= more;
}

std::optional<std::string_view> LineReader::next() {
  std::size_t end = end_of_line();
  while (end == std::string::npos && unread_ > 0) {
    if (buffer_.size() - begin_ > kLongestLine) {
      file_.refuse(number_ + 1, fmt::format("a line of more than {} bytes", kLongestLine));
    }
    read_more();
    end = end_of_line();
  }
  const bool is_last = end == std::string::npos;
  if (OCTOCELL_FAULT(text_last_line_lost, is_last, begin_ == buffer_.size())) return std::nullopt;
  ++number_;
  const std::string_view line = std::string_view(buffer_).substr(begin_, end - begin_);
  begin_ = is_last ? buffer_.size() : end + 1;
  return line;
}

}  // namespace octocell
