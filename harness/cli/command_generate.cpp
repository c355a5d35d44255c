// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <string>

#include "core/text.hpp"
#include "harness/cli/commands.hpp"
#include "harness/files/named_files.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/files/save.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string scene;
  std::string output;
  LoadOptions load;
  std::string flags_output;
};

/// Runs before anything is read or made.
void check_files(const Options& options) {
  NamedFiles files;
  files.read_scene(options.scene, options.load.flags);
  files.write("--output", options.output);
  files.write("--flags-output", options.flags_output);
  files.require_separate();
  require_savable_scene(options.output);
  if (!options.flags_output.empty()) require_savable_list(options.flags_output);
}

int generate_scene(const Options& options) {
  check_files(options);
  const Scene scene = load_and_say(options.scene, options.load);
  save_scene(options.output, scene.view(), options.flags_output);
  fmt::print("{}: {} spheres from {}\n", printable(options.output), scene.spheres.size(),
             scene.spec);
  return 0;
}

}  // namespace

void add_generate(CLI::App& sub, Command& command) {
  auto options = std::make_shared<Options>();
  sub.description("Write a scene as NPY, (N, 4) float32, or as CSV");
  sub.add_option("SCENE", options->scene, kSceneHelp)->required();
  sub.add_option("-o,--output", options->output, "The file to write")->required();
  add_scene_options(sub, options->load);
  sub.add_option("--flags-output", options->flags_output,
                 "Another NPY, (N,) uint32, for the flags of a scene that has some");
  sub.callback([&command, options] { command = [options] { return generate_scene(*options); }; });
}

}  // namespace octocell::cli
