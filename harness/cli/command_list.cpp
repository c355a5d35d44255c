// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <span>
#include <string>

#include "harness/cli/commands.hpp"
#include "harness/engine/registry.hpp"
#include "harness/files/format.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell::cli {
namespace {

void list_backends(Kind kind) {
  for (const BackendInfo& b : backends()) {
    if (b.kind != kind) continue;
    const std::optional<std::string> reason = b.why_unavailable();
    fmt::print("  {:<36} {:<54} {}\n", b.name, b.summary,
               reason ? "not here: " + *reason : "available");
    if (!b.known_issues.empty()) fmt::print("      known issue: {}\n", b.known_issues);
  }
}

void list_parameters(std::span<const ParameterInfo> parameters) {
  for (const ParameterInfo& p : parameters) {
    fmt::print("      {:<10} {} (default {})\n", p.name, p.summary, p.preset);
  }
}

void list_scenes() {
  for (const SceneInfo& scene : scenes()) {
    fmt::print("  {:<12} {}\n", scene.name, scene.summary);
    list_parameters(scene.parameters);
  }
  fmt::print("    every scene also takes flags:\n");
  list_parameters(flag_parameters());
}

int list() {
  fmt::print("backends\n");
  list_backends(Kind::backend);
  fmt::print("    methods: {}\n", fmt::join(kMethodNames, ", "));
  fmt::print("    rules of home_phantom: {} (as_written is a negative control: it loses pairs)\n",
             fmt::join(kRuleNames, ", "));
  fmt::print("\nbaselines\n");
  list_backends(Kind::baseline);
  fmt::print("\nscenes (NAME or NAME:parameter=value,...; or a file: {})\n", kOwnSuffixes);
  list_scenes();
  return 0;
}

}  // namespace

void add_list(CLI::App& sub, Command& command) {
  sub.description("Backends, methods, rules, baselines and scenes");
  sub.callback([&command] { command = list; });
}

}  // namespace octocell::cli
