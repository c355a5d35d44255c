// SPDX-License-Identifier: MIT
#include "harness/doctor/mend.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <sstream>

#include "core/text.hpp"
#include "harness/try/output_of.hpp"

namespace octocell::doctor {
namespace {

constexpr std::chrono::seconds kPatience{30};

bool is_here(const char* program) {
  return hand_in::output_of({program, "--version"}, kPatience).exit_code != 127;
}

}  // namespace

std::string install(const Package& package) {
  // A conda environment needs no root, so it comes first where one is active.
  if (std::getenv("CONDA_PREFIX") != nullptr)
    return fmt::format("conda install -c conda-forge {}", package.conda);
  const char* const sudo = geteuid() == 0 ? "" : "sudo ";
  if (is_here("apt-get")) return fmt::format("{}apt-get install {}", sudo, package.apt);
  if (is_here("dnf")) return fmt::format("{}dnf install {}", sudo, package.dnf);
  if (is_here("pacman")) return fmt::format("{}pacman -S {}", sudo, package.pacman);
  return fmt::format("install {} with this system's package manager", package.apt);
}

std::vector<std::string> lines_of(const std::vector<std::string>& command) {
  const hand_in::Output output = hand_in::output_of(command, kPatience);
  std::vector<std::string> lines;
  if (output.timed_out || output.exit_code != 0) return lines;
  std::istringstream text(output.text);
  for (std::string line; std::getline(text, line);) lines.push_back(printable(line));
  return lines;
}

}  // namespace octocell::doctor
