// SPDX-License-Identifier: MIT
// Linux grants memory that it does not have, and later kills the program that uses it. So code that
// is about to use much memory checks here first and refuses with an error message.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octocell {

/// Returns how many bytes this process can still use: the smallest of the machine's available
/// memory and what the limits of its control groups (versions 1 and 2) leave. Returns none if the
/// system does not say. `root` is the folder that holds proc and sys.
std::optional<double> available_bytes(const std::filesystem::path& root = "/");

inline constexpr double kGiB = 1073741824.0;

/// Throws MemoryError "WHAT: 3.1 GiB are needed, and 1.2 GiB are available" if `bytes` do not fit.
void require_memory(double bytes, std::string_view what);
/// Returns that text.
std::string lack_of_memory(std::string_view what, double needed, double available);

/// Appends to a list that may become long. Checks that there is enough memory before the list
/// grows.
template <typename T>
void append_within_memory(std::vector<T>& list, const T& item, std::string_view what) {
  constexpr std::size_t kUnasked = (std::size_t{32} << 20) / sizeof(T);  // smaller lists are not
                                                                         // checked
  if (list.size() == list.capacity()) {
    const std::size_t grown = std::max<std::size_t>(2 * list.capacity(), 1024);
    if (grown > kUnasked) require_memory(static_cast<double>(grown) * sizeof(T), what);
    list.reserve(grown);
  }
  list.push_back(item);
}

}  // namespace octocell
