// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/doctor/mend.hpp"
#include "harness/doctor/parts.hpp"
#include "harness/doctor/samples.hpp"
#include "harness/try/compile.hpp"
#include "harness/try/try.hpp"

namespace octocell::doctor {
namespace {

/// Only the small scenes, which take about a second.
constexpr double kNoLargerScenes = 1e-6;

std::string reason_of(const hand_in::Trial& trial) {
  if (trial.wrong) return fmt::format("gives wrong pairs for {}", trial.at);
  return fmt::format("{}: {}", trial.kind, trial.reason);
}

hand_in::Trial try_text(const char* suffix, const char* text, const std::string& python) {
  const hand_in::TemporaryFolder folder;
  const auto file = folder.path() / fmt::format("sample{}", suffix);
  std::ofstream(file) << text;
  hand_in::Options options;
  options.file = file.string();
  options.python = python;
  options.budget_s = kNoLargerScenes;
  return hand_in::try_hand_in(options);
}

Way try_sample(const char* name, const char* suffix, const char* text, const std::string& python) {
  Way way = {name, fmt::format("octocell try mine{}", suffix), false};
  try {
    const hand_in::Trial trial = try_text(suffix, text, python);
    way.works = trial.verdict == "exact";
    if (!way.works) way.reason = reason_of(trial);
    if (!trial.compiled_with.empty()) way.compiler = trial.compiled_with.front();
  } catch (const std::exception& error) {  // no folder for temporary files, no process
    way.reason = error.what();
  }
  return way;
}

}  // namespace

std::vector<Way> try_ways(const std::string& python) {
  Way cuda = try_sample("CUDA", ".cu", kSample_cu, python);
  cuda.needs_a_gpu = true;
  return {try_sample("C++", ".cpp", kSample_cpp, python),
          try_sample("Python", ".py", kSample_py, python), cuda};
}

Check compiler(const Way& cpp) {
  if (!cpp.works && cpp.compiler.empty()) {
    return {"compiler", false, cpp.reason,
            install({"g++", "gcc-c++", "gcc", "cxx-compiler"}) + " (or CXX=g++-12, a newer one)"};
  }
  const auto lines = lines_of({cpp.compiler, "--version"});
  const std::string version = lines.empty() ? "" : lines.front();
  return {"compiler", true, fmt::format("{}: {}", cpp.compiler, version)};
}

}  // namespace octocell::doctor
