// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "core/text.hpp"
#include "harness/doctor/parts.hpp"

namespace octocell::doctor {
namespace {

constexpr double kEnoughMemory = 2 * kGiB;  // for the compiler, and for scenes of a million
constexpr double kEnoughDisk = 0.25 * kGiB;
constexpr rlim_t kEnoughFiles = 64;

Check memory() {
  const double free = available_bytes().value_or(0.0);
  const bool enough = free >= kEnoughMemory;
  return {
      "memory", enough,
      fmt::format("{:.1f} GiB free, {} cores", free / kGiB, std::thread::hardware_concurrency()),
      enough ? "" : "close other programs, or octocell try --memory 1 --budget 1"};
}

/// A hand-in is compiled there, and loaded from there.
Check temporary_files() {
  const std::string elsewhere = "mkdir -p ~/tmp && export TMPDIR=~/tmp";
  std::error_code error;
  const std::string folder = std::filesystem::temp_directory_path(error).string();
  struct statvfs disk = {};
  if (error || statvfs(folder.c_str(), &disk) != 0)
    return {"disk", false, "no folder for temporary files", elsewhere};
  const double free = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  const std::string found = fmt::format("{:.1f} GiB free in {}", free / kGiB, printable(folder));
  if ((disk.f_flag & ST_NOEXEC) != 0)
    return {"disk", false, found + ", but programs may not run there (noexec)", elsewhere};
  const bool enough = free >= kEnoughDisk;
  return {"disk", enough, found, enough ? "" : elsewhere};
}

rlim_t soft_limit(decltype(RLIMIT_AS) resource) {
  rlimit limit = {};
  return getrlimit(resource, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

std::vector<Check> limits() {
  std::vector<Check> checks;
  if (soft_limit(RLIMIT_AS) != RLIM_INFINITY) {
    checks.push_back({"limits", false,
                      "the address space is limited; CUDA and sanitizers fail then",
                      "ulimit -v unlimited"});
  }
  if (soft_limit(RLIMIT_NOFILE) < kEnoughFiles)
    checks.push_back({"limits", false, "too few open files are allowed", "ulimit -n 1024"});
  if (soft_limit(RLIMIT_FSIZE) != RLIM_INFINITY)
    checks.push_back({"limits", false, "the size of files is limited", "ulimit -f unlimited"});
  if (soft_limit(RLIMIT_CPU) != RLIM_INFINITY)
    checks.push_back({"limits", false, "processor time is limited", "ulimit -t unlimited"});
  if (checks.empty()) checks.push_back({"limits", true, "none that hinders (ulimit -a shows all)"});
  return checks;
}

}  // namespace

std::vector<Check> machine() {
  std::vector<Check> checks = {memory(), temporary_files()};
  for (Check& check : limits()) checks.push_back(std::move(check));
  return checks;
}

}  // namespace octocell::doctor
