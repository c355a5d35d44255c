// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "core/text.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/named_files.hpp"
#include "harness/cli/names.hpp"
#include "harness/files/load.hpp"
#include "harness/files/save.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string scene;
  std::string output;
  std::optional<std::string> flags;
  std::string flags_output;
  bool round_input = false;
};

/// Runs before anything is read or made.
void check_files(const Options& options) {
  NamedFiles files;
  files.read_scene(options.scene, options.flags);
  files.write("--output", options.output);
  files.write("--flags-output", options.flags_output);
  files.require_separate();
  require_savable_scene(options.output);
  if (!options.flags_output.empty()) require_savable_list(options.flags_output);
}

int generate_scene(const Options& options) {
  check_files(options);
  const Scene scene =
      load_or_generate(options.scene, {.flags = options.flags, .round_input = options.round_input});
  save_scene(options.output, scene.view(), options.flags_output);
  fmt::print("{}: {} spheres from {}\n", printable(options.output), scene.spheres.size(),
             scene.spec);
  return 0;
}

}  // namespace

void add_generate(CLI::App& app, Command& command) {
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("generate", "Write a scene as NPY, (N, 4) float32, or as CSV");
  sub->add_option("SCENE", options->scene, "A generator, such as gas:n=100000,seed=7, or a file")
      ->required();
  sub->add_option("-o,--output", options->output, "The file to write")->required();
  sub->add_option("--flags", options->flags, kFlagsHelp);
  sub->add_option("--flags-output", options->flags_output,
                  "Another NPY, (N,) uint32, for the flags of a scene that has some");
  sub->add_flag("--round-input", options->round_input, "Accept float64 input and round it");
  sub->callback([&command, options] { command = [options] { return generate_scene(*options); }; });
}

}  // namespace octocell::cli
