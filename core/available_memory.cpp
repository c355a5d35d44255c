// SPDX-License-Identifier: MIT
// Meaning of the files: Linux, Documentation/admin-guide/cgroup-v1/memory.rst and cgroup-v2.rst;
// proc(5).
#include "core/available_memory.hpp"

#include <fmt/format.h>

#include <fstream>
#include <initializer_list>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace octocell {
namespace {

namespace fs = std::filesystem;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Returns the number behind `word` at the beginning of a line, as in "MemAvailable:  123 kB".
std::optional<double> number_after(const fs::path& file, std::string_view word) {
  std::ifstream text(file);
  for (std::string first; text >> first;) {
    double number = 0.0;
    if (first == word && text >> number) return number;
    text.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::nullopt;
}

/// Returns the one number in a file; none for the word "max".
std::optional<double> number_in(const fs::path& file) {
  std::ifstream text(file);
  double number = 0.0;
  if (text >> number) return number;
  return std::nullopt;
}

/// The file names and words of one version of control groups.
struct Version {
  const char* limit;
  const char* usage;
  const char* inactive_cache;  // in memory.stat: the part of the usage that the kernel takes back
                               // first
};
constexpr Version kFirst = {"memory.limit_in_bytes", "memory.usage_in_bytes",
                            "total_inactive_file"};
constexpr Version kSecond = {"memory.max", "memory.current", "inactive_file"};

/// Returns what a group leaves of its limit: everything if it has no limit.
double left_in(const fs::path& group, const Version& version) {
  const std::optional<double> limit = number_in(group / version.limit);
  const std::optional<double> usage = number_in(group / version.usage);
  if (!limit || !usage) return kUnlimited;
  const double cache = number_after(group / "memory.stat", version.inactive_cache).value_or(0.0);
  return std::max(0.0, *limit - std::max(0.0, *usage - cache));
}

/// Returns the least that a group and the groups around it leave. A container may see its own group
/// as the root, but under the name that the group has outside. Then no folder has that name, and
/// only the root counts.
double left_in_path(const fs::path& mount, const fs::path& group, const Version& version) {
  double left = left_in(mount, version);
  fs::path here = mount;
  for (const fs::path& part : group.relative_path()) {
    here /= part;
    left = std::min(left, left_in(here, version));
  }
  return left;
}

bool names_memory(std::string_view controllers) {
  for (std::string_view rest = controllers; !rest.empty();) {
    const std::size_t end = rest.find(',');
    if (rest.substr(0, end) == "memory") return true;
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return false;
}

/// Lines of /proc/self/cgroup are NUMBER:CONTROLLERS:GROUP; version 2 has "0::GROUP".
double left_by_control_groups(const fs::path& root) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  double left = kUnlimited;
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string_view controllers =
        std::string_view(line).substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (names_memory(controllers)) {
      left = std::min(left, left_in_path(mounts / "memory", group, kFirst));
    } else if (controllers.empty()) {
      left = std::min(left, left_in_path(mounts, group, kSecond));
    }
  }
  return left;
}

}  // namespace

std::optional<double> available_bytes(const fs::path& root) {
  const std::optional<double> kilobytes = number_after(root / "proc/meminfo", "MemAvailable:");
  const double left =
      std::min(kilobytes ? *kilobytes * 1024.0 : kUnlimited, left_by_control_groups(root));
  if (left == kUnlimited) return std::nullopt;
  return left;
}

void require_memory(double bytes, std::string_view what) {
  const std::optional<double> available = available_bytes();
  if (!available || bytes <= *available) return;
  throw MemoryError(lack_of_memory(what, bytes, *available));
}

std::string lack_of_memory(std::string_view what, double needed, double available) {
  return fmt::format("{}: {:.1f} GiB are needed, and {:.1f} GiB are available", what, needed / kGiB,
                     available / kGiB);
}

}  // namespace octocell
