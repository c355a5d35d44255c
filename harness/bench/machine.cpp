// SPDX-License-Identifier: MIT
#include "harness/bench/machine.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <thread>

#include "baselines/baselines.hpp"
#include "git_revision.hpp"

namespace octocell::bench {
namespace {

/// Returns the value of `key` in a file of "key<separator>value" lines; "unknown" if it is not
/// there.
std::string value_in(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind(key, 0) != 0) continue;
    std::string value = line.substr(line.find(separator) + 1);
    std::erase(value, '"');
    value.erase(0, value.find_first_not_of(" \t"));
    return value;
  }
  return "unknown";
}

std::string host_name() {
  std::array<char, 256> name = {};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

/// Returns the instruction set that the CPU kernels were compiled for, not that of the machine.
std::string instruction_set() {
  std::string set = "x86-64";
#ifdef __SSE4_2__
  set += " sse4.2";
#endif
#ifdef __AVX2__
  set += " avx2";
#endif
#ifdef __FMA__
  set += " fma";
#endif
#ifdef __AVX512F__
  set += " avx512f";
#endif
  return set;
}

std::string compiler() {
#ifdef __clang__
  return fmt::format("clang++ {}", __clang_version__);
#else
  return fmt::format("g++ {}", __VERSION__);
#endif
}

}  // namespace

nlohmann::ordered_json describe_build_and_machine() {
  const auto memory = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                      static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return {
      {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()))},
      {"commit", OCTOCELL_COMMIT},
      {"dirty", OCTOCELL_DIRTY},
      {"version", OCTOCELL_VERSION},
      {"machine",
       {{"name", host_name()},
        {"cpu", value_in("/proc/cpuinfo", "model name", ':')},
        {"cores", std::thread::hardware_concurrency()},
        {"memory_bytes", memory},
        {"os", value_in("/etc/os-release", "PRETTY_NAME", '=')}}},
      {"compiler", compiler()},
      {"flags", OCTOCELL_FLAGS},
      {"instruction_set", instruction_set()},
      {"build_type", OCTOCELL_BUILD_TYPE},
      {"libraries", {{"fcl", baselines::fcl_version()}, {"bullet", baselines::bullet_version()}}}};
}

nlohmann::ordered_json to_json(const Gpu& gpu) {
  return {{"name", gpu.name},
          {"driver", gpu.driver},
          {"copy_gigabytes_per_second", gpu.copy_gigabytes_per_second}};
}

}  // namespace octocell::bench
