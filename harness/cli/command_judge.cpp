// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/files/input_file.hpp"
#include "harness/files/json_text.hpp"
#include "harness/files/load_pairs.hpp"
#include "harness/judge/judge.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string scene;
  std::string pairs;
  LoadOptions load;
  bool json = false;
};

int judge_list(const Options& options) {
  if (options.scene == kStandardInput && options.pairs == kStandardInput)
    throw InputError("SCENE and PAIRS cannot both be standard input");
  const Scene scene = load_and_say(options.scene, options.load);
  const std::vector<ListedPair> list = load_pairs(options.pairs);
  const judge::Judgement judgement = judge::judge(list, scene);
  const std::string name = printable(options.pairs);
  if (options.json) {
    fmt::print("{}\n", json_text(judge::to_json(judgement, scene.spec, name), 2));
  } else {
    fmt::print("{}", judge::to_text(judgement, scene.spec, name));
  }
  return judgement.exact() ? 0 : kExitWrongAnswer;
}

}  // namespace

void add_judge(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Judge a list of pairs that another program made, and say what is wrong with it");
  sub.add_option("SCENE", o->scene, kSceneHelp)->required();
  sub.add_option("PAIRS", o->pairs,
                 "NPY (M, 2) of integers, or text with two numbers a line; - for standard input")
      ->required();
  add_scene_options(sub, o->load);
  sub.add_flag("--json", o->json, "Print JSON");
  sub.callback([&command, o] { command = [o] { return judge_list(*o); }; });
}

}  // namespace octocell::cli
