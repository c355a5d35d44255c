// SPDX-License-Identifier: MIT
// Linux grants memory that it does not have and ends a program that then uses it. So code that is
// about to use much asks here first, and refuses in words.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace octocell {

/// Returns how many bytes this process can still use: what the machine has available, or what the
/// limits of its control groups leave, versions 1 and 2, whichever is least. None where the system
/// does not tell. `root` is where proc and sys lie.
std::optional<double> available_bytes(const std::filesystem::path& root = "/");

/// Throws LimitError "WHAT: 3.1 GiB are needed, and 1.2 GiB are available" where that is so.
void require_memory(double bytes, std::string_view what);

/// Appends to a list that may become long: before it grows, memory for that must be there.
template <typename T>
void append_within_memory(std::vector<T>& list, const T& item, std::string_view what) {
  constexpr std::size_t kUnasked = (std::size_t{32} << 20) / sizeof(T);  // below, it is not asked
  if (list.size() == list.capacity()) {
    const std::size_t grown = std::max<std::size_t>(2 * list.capacity(), 1024);
    if (grown > kUnasked) require_memory(static_cast<double>(grown) * sizeof(T), what);
    list.reserve(grown);
  }
  list.push_back(item);
}

}  // namespace octocell
