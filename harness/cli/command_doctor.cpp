// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/cli/commands.hpp"
#include "harness/doctor/doctor.hpp"
#include "harness/files/json_text.hpp"

namespace octocell::cli {
namespace {

struct Options {
  std::string python = "python3";
  bool json = false;
};

int report_health(const Options& options) {
  const doctor::Report report = doctor::examine(options.python);
  if (options.json) {
    fmt::print("{}\n", json_text(doctor::to_json(report), 2));
  } else {
    fmt::print("{}", doctor::to_text(report));
  }
  return report.is_well() ? 0 : kExitLacking;
}

}  // namespace

void add_doctor(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Say what this machine has for hand-ins, what it lacks, and how to mend that");
  sub.add_option("--python", o->python, "The interpreter of .py files (python3)");
  sub.add_flag("--json", o->json, "Print JSON");
  sub.callback([&command, o] { command = [o] { return report_health(*o); }; });
}

}  // namespace octocell::cli
