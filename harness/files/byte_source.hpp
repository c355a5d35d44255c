// SPDX-License-Identifier: MIT
// Sources of bytes: a file, a pipe, or what is unpacked from one of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace octocell {

/// Fills the span as far as there are bytes. Returns how many it wrote.
using ByteSource = std::function<std::size_t(std::span<std::byte>)>;

/// A source whose first bytes can be seen before they are read.
class PeekedSource {
 public:
  explicit PeekedSource(ByteSource source) : source_(std::move(source)), first_(kPeeked) {
    first_.resize(source_(first_));
  }

  [[nodiscard]] std::string_view beginning() const {
    return {reinterpret_cast<const char*>(first_.data()), first_.size()};
  }

  std::size_t read(std::span<std::byte> bytes) {
    const auto unread = std::span(first_).subspan(taken_);
    const std::size_t peeked = std::min(bytes.size(), unread.size());
    std::ranges::copy(unread.first(peeked), bytes.begin());
    taken_ += peeked;
    return peeked + source_(bytes.subspan(peeked));
  }

 private:
  static constexpr std::size_t kPeeked = 4096;
  ByteSource source_;
  std::vector<std::byte> first_;
  std::size_t taken_ = 0;
};

}  // namespace octocell
