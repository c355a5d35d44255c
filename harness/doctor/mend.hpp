// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace octocell::doctor {

/// The name of a package for each package manager.
struct Package {
  const char* apt;
  const char* dnf;
  const char* pacman;
  const char* conda;
};

/// Returns the command that installs it here, with sudo unless the user is root.
std::string install(const Package& package);

/// Runs a program; returns the lines that it printed, or none if it is not there or fails.
std::vector<std::string> lines_of(const std::vector<std::string>& command);

}  // namespace octocell::doctor
