// SPDX-License-Identifier: MIT
#include "harness/registry/calibration.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "harness/interface/error.hpp"

namespace octocell {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 1);
  }
  return "unknown";
}

double factor(const Json& json, const char* method) {
  const double value = json.at(method).get<double>();
  if (!(value > 1e-6) || value > 1e6) {
    throw InputError(
        fmt::format("{}: factor {} of {}", calibration_file().string(), value, method));
  }
  return value;
}

std::map<std::string, Calibration> read(const fs::path& path) {
  std::map<std::string, Calibration> found;
  try {
    const Json json = Json::parse(std::ifstream(path));
    if (json.at("processor") != processor()) return found;
    for (const auto& [backend, factors] : json.at("backends").items()) {
      found[backend] = {.home_phantom = factor(factors, "home_phantom"),
                        .half_shell = factor(factors, "half_shell"),
                        .brute_force = factor(factors, "brute_force")};
    }
  } catch (const Json::exception& error) {
    throw InputError(
        fmt::format("{}: not what 'octocell calibrate' writes ({}); remove it or "
                    "calibrate again",
                    path.string(), error.what()));
  }
  return found;
}

}  // namespace

fs::path calibration_file() {
  if (const char* const named = std::getenv("OCTOCELL_CALIBRATION")) return named;
  if (const char* const config = std::getenv("XDG_CONFIG_HOME");
      config != nullptr && *config != 0) {
    return fs::path(config) / "octocell" / "calibration.json";
  }
  const char* const home = std::getenv("HOME");
  return home == nullptr ? fs::path()
                         : fs::path(home) / ".config" / "octocell" / "calibration.json";
}

std::map<std::string, Calibration> stored_calibrations() {
  const fs::path path = calibration_file();
  std::error_code ignored;
  if (path.empty() || !fs::is_regular_file(path, ignored)) return {};
  return read(path);
}

void store(const std::map<std::string, Calibration>& calibrations) {
  const fs::path path = calibration_file();
  if (path.empty())
    throw InputError("there is no place for a calibration: set OCTOCELL_CALIBRATION");
  Json backends = Json::object();
  for (const auto& [backend, factors] : calibrations) {
    backends[backend] = {{"home_phantom", factors.home_phantom},
                         {"half_shell", factors.half_shell},
                         {"brute_force", factors.brute_force}};
  }
  const Json json = {{"processor", processor()}, {"backends", backends}};
  std::error_code failed;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
  const fs::path fresh = path.string() + ".new";
  std::ofstream file(fresh);
  file << json.dump(2) << '\n';
  file.close();
  if (!file) {
    fs::remove(fresh, failed);
    throw InputError(fmt::format("cannot write {}", path.string()));
  }
  fs::rename(fresh, path, failed);
  if (failed) throw InputError(fmt::format("cannot write {}: {}", path.string(), failed.message()));
}

}  // namespace octocell
