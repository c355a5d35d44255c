// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "harness/doctor/mend.hpp"
#include "harness/doctor/parts.hpp"

namespace octocell::doctor {
namespace {

constexpr const char* kWithoutIt = "the ways without CUDA do not need it";

/// The first number behind `before`.
std::optional<double> number_behind(const std::string& before, const std::string& text) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(before + R"([^0-9]*([0-9]+(\.[0-9]+)?))")))
    return std::nullopt;
  return std::strtod(found[1].str().c_str(), nullptr);
}

std::optional<double> release_of(const std::string& nvcc) {
  for (const std::string& line : lines_of({nvcc, "--version"})) {
    if (const auto release = number_behind("release", line)) return release;
  }
  return std::nullopt;
}

/// The oldest driver for a release of CUDA (NVIDIA's table of minor version compatibility).
int oldest_driver(double release) { return release >= 13 ? 580 : release >= 12 ? 525 : 450; }

/// CUDA 13 no longer compiles for GPUs before Turing.
double oldest_gpu(double release) { return release >= 13 ? 7.5 : 5.0; }

Check nvcc_check(const Way& way, std::optional<double> release) {
  if (way.compiler.empty())
    return {"nvcc", false, way.reason, "make cuda-toolkit (CUDA 13), then CUDA_HOME=$PWD/.cuda"};
  return {
      "nvcc", true,
      fmt::format("{}: CUDA {}", way.compiler, release ? fmt::format("{:.1f}", *release) : "?")};
}

/// "NAME, 9.0, 580.65.06, 81559 MiB", a line a GPU. Below WSL, nvidia-smi may not be on the PATH.
std::vector<std::string> gpu_lines() {
  for (const char* program : {"nvidia-smi", "/usr/lib/wsl/lib/nvidia-smi"}) {
    auto lines = lines_of({program, "--query-gpu=name,compute_cap,driver_version,memory.total",
                           "--format=csv,noheader"});
    if (!lines.empty()) return lines;
  }
  return {};
}

/// The version of the driver without nvidia-smi.
std::string loaded_driver() {
  std::ifstream file("/proc/driver/nvidia/version");
  std::string line;
  std::getline(file, line);
  const auto version = number_behind("Kernel Module", line);
  return version ? fmt::format("{}", *version) : "";
}

Check driver_check(const std::string& version, std::optional<double> release) {
  if (version.empty()) return {"driver", false, fmt::format("none; {}", kWithoutIt)};
  const int needed = oldest_driver(release.value_or(13.0));
  const bool serves = std::strtod(version.c_str(), nullptr) >= needed;
  if (serves) return {"driver", true, version};
  return {
      "driver", false,
      fmt::format("{}, and CUDA {:.0f} needs {} or newer", version, release.value_or(13.0), needed),
      fmt::format("a driver from https://www.nvidia.com/drivers, or an older nvcc; {}",
                  kWithoutIt)};
}

std::vector<std::string> split_at_commas(const std::string& line) {
  static const std::regex comma(R"(\s*,\s*)");
  return {std::sregex_token_iterator(line.begin(), line.end(), comma, -1), {}};
}

Check gpu_check(const std::vector<std::string>& fields, std::optional<double> release) {
  const double capability = std::strtod(fields[1].c_str(), nullptr);
  const std::string what =
      fmt::format("{}, compute capability {}, {}", fields[0], fields[1], fields[3]);
  if (capability >= oldest_gpu(release.value_or(13.0))) return {"GPU", true, what};
  return {"GPU", false, what + ": too old for this nvcc", "an nvcc of CUDA 12"};
}

}  // namespace

std::vector<Check> cuda(const Way& way) {
  const auto release = way.compiler.empty() ? std::nullopt : release_of(way.compiler);
  std::vector<Check> checks = {nvcc_check(way, release)};
  std::vector<Check> gpus;
  std::string driver;
  for (const std::string& line : gpu_lines()) {
    const auto fields = split_at_commas(line);
    if (fields.size() != 4) continue;
    driver = fields[2];
    gpus.push_back(gpu_check(fields, release));
  }
  if (driver.empty()) driver = loaded_driver();
  checks.push_back(driver_check(driver, release));
  if (gpus.empty()) gpus.push_back({"GPU", false, fmt::format("none; {}", kWithoutIt)});
  checks.insert(checks.end(), gpus.begin(), gpus.end());
  return checks;
}

}  // namespace octocell::doctor
