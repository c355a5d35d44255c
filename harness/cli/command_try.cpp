// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/cli/commands.hpp"
#include "harness/files/json_text.hpp"
#include "harness/files/save.hpp"
#include "harness/try/library_runner.hpp"
#include "harness/try/protocol.hpp"
#include "harness/try/try.hpp"

namespace octocell::cli {
namespace {

struct Options {
  hand_in::Options trial;
  std::string stage;
  bool json = false;
};

void require_positive(std::string_view option, double value) {
  if (!(value > 0.0) || value > 1e6)
    throw InputError(fmt::format("{} {}: must be above 0 and at most 1e6", option, value));
}

int exit_code_of(const hand_in::Trial& trial) {
  if (trial.verdict == "exact") return 0;
  return trial.is_wrong() ? kExitWrongAnswer : kExitBadInput;
}

void choose_stage(Options& options) {
  if (options.stage.empty()) return;
  const auto stage = hand_in::function_named(options.stage);
  if (!stage || *stage == hand_in::Function::find_pairs) {
    throw InputError(fmt::format("--stage {}: expected cell_ids, sort, cell_index or pair_tests",
                                 quote(options.stage)));
  }
  options.trial.function = *stage;
}

int try_file(Options options) {
  choose_stage(options);
  if (options.trial.bench && (options.trial.sanitize || !options.stage.empty()))
    throw InputError("--bench: not with --sanitize or --stage");
  if (!options.trial.save.empty()) {
    if (!options.stage.empty()) throw InputError("--save: not with --stage");
    require_savable_scene(options.trial.save);
  }
  require_positive("--budget", options.trial.budget_s);
  require_positive("--timeout", options.trial.timeout_s);
  require_positive("--memory", options.trial.memory_gib);
  const hand_in::Trial trial = hand_in::try_hand_in(options.trial);
  const std::string file = printable(options.trial.file);
  if (options.json) {
    fmt::print("{}\n", json_text(hand_in::to_json(trial, file), 2));
  } else {
    fmt::print("{}", hand_in::to_text(trial, file));
  }
  return exit_code_of(trial);
}

}  // namespace

void add_try(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  hand_in::Options& trial = o->trial;
  sub.description("Try a broad phase of yours: is it exact, and if not, why?");
  sub.add_option("FILE", trial.file,
                 "find_pairs in C++ (.cpp), CUDA (.cu), a shared library (.so) or Python (.py)")
      ->required();
  sub.add_option(
      "--stage", o->stage,
      "Only this stage is in the file, the others are ours: cell_ids, sort, cell_index or "
      "pair_tests");
  sub.add_option("--budget", trial.budget_s, "Seconds after which no larger scene begins (20)");
  sub.add_option("--timeout", trial.timeout_s, "Seconds for one scene (10)");
  sub.add_option("--memory", trial.memory_gib, "GiB of resident memory for its process (4)");
  sub.add_option("--seed", trial.seed, "Of the scenes (1)");
  sub.add_option("--python", trial.python, "The interpreter of .py files (python3)");
  sub.add_flag("--sanitize", trial.sanitize,
               "Run it under ASan and UBSan (.cpp) or compute-sanitizer (.cu)");
  sub.add_flag("--bench", trial.bench, "If it is exact, time it beside Octocell and the libraries");
  sub.add_option("--save", trial.save, "Write the first scene with wrong pairs there, as NPY");
  sub.add_flag("--json", o->json, "Print JSON");
  sub.callback([&command, o] { command = [o] { return try_file(*o); }; });
}

void add_run_hand_in(CLI::App& sub, Command& command) {
  struct Arguments {
    std::string library;
    std::string function;
  };
  auto o = std::make_shared<Arguments>();
  sub.group("");  // for `try` alone: it speaks the protocol of harness/try
  sub.add_option("LIBRARY", o->library)->required();
  sub.add_option("FUNCTION", o->function)
      ->required()
      ->check(CLI::IsMember(hand_in::kFunctionNames));
  sub.callback(
      [&command, o] { command = [o] { return hand_in::run_library(o->library, o->function); }; });
}

}  // namespace octocell::cli
