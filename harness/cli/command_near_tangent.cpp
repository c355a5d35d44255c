// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "harness/bench/machine.hpp"
#include "harness/bench/result_file.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/verify/near_tangent/near_tangent.hpp"

namespace octocell::cli {
namespace {

using near_tangent::Family;
using near_tangent::Tally;

struct Options {
  double pairs = 1e6;  // near-tangent pairs of each family
  bool device = false;
  int threads = 0;
  std::string output;
};

/// Tries pairs until enough of them were near-tangent pairs. Parts are large enough to keep a GPU
/// busy.
Tally try_family(Family family, const Options& options) {
  constexpr std::uint64_t kPart = 1 << 26;
  constexpr double kMostTriedPerNear = 100.0;
  const auto wanted = static_cast<std::uint64_t>(options.pairs);
  const std::uint64_t part = std::min(kPart, wanted + 1024);
  Tally sum;
  for (std::uint64_t begin = 0; sum.near < wanted; begin += part) {
    near_tangent::add(sum, options.device ? near_tangent::try_on_device(family, begin, begin + part)
                                          : near_tangent::try_on_host(family, begin, begin + part,
                                                                      options.threads));
    if (static_cast<double>(begin) > kMostTriedPerNear * options.pairs) {
      throw Error(fmt::format("family {} makes too few near-tangent pairs",
                              near_tangent::kFamilyNames[static_cast<std::size_t>(family)]));
    }
  }
  return sum;
}

int run(Options options) {
  if (!(options.pairs >= 1.0) || options.pairs > 1e12) {
    throw InputError(fmt::format("--pairs {}: must be 1 to 1e12", options.pairs));
  }
  options.threads = thread_count(options.threads);
  if (options.device) {
    if (const auto reason = near_tangent::why_no_device()) {
      throw LimitError("no device to run on: " + *reason);
    }
  }
  std::optional<bench::ResultFile> file;
  if (!options.output.empty()) {
    file.emplace(options.output);
    file->make_folder();
    file->require_writable();
  }
  nlohmann::ordered_json families = nlohmann::ordered_json::array();
  std::uint64_t mismatches = 0;
  fmt::print("{:<10} {:>14} {:>14} {:>11} {:>14}\n", "", "tried", "near-tangent", "mismatches",
             "float32 wrong");
  for (std::size_t f = 0; f < near_tangent::kFamilyNames.size(); ++f) {
    const Tally tally = try_family(static_cast<Family>(f), options);
    mismatches += tally.mismatches;
    fmt::print("{:<10} {:>14} {:>14} {:>11} {:>14}  {}\n", near_tangent::kFamilyNames[f],
               tally.tried, tally.near, tally.mismatches, tally.float32_wrong,
               near_tangent::kFamilyWords[f]);
    if (tally.mismatches != 0) fmt::print("           the first is pair {}\n", tally.first_wrong);
    std::fflush(stdout);
    families.push_back({{"name", near_tangent::kFamilyNames[f]},
                        {"asks", near_tangent::kFamilyWords[f]},
                        {"tried", tally.tried},
                        {"pairs", tally.near},
                        {"mismatches", tally.mismatches},
                        {"float32_wrong", tally.float32_wrong}});
  }
  if (file) {
    file->write({{"schema", 2},
                 {"context", bench::describe_build_and_machine()},
                 {"where", options.device ? "GPU" : "CPU"},
                 {"families", families}});
  }
  return mismatches == 0 ? 0 : kExitWrongAnswer;
}

}  // namespace

void add_near_tangent(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Compare the exact test with integers on pairs that nearly touch");
  sub.add_option("--pairs", o->pairs, "Near-tangent pairs of each family to try (default 1e6)");
  sub.add_flag("--device", o->device, "Run on the GPU");
  sub.add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub.add_option("-o,--output", o->output, "Write JSON");
  sub.callback([&command, o] { command = [o] { return run(*o); }; });
}

}  // namespace octocell::cli
