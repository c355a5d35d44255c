// SPDX-License-Identifier: MIT
// How long work takes on this machine, against what the cost model was fitted to.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/planner/planner.hpp"

namespace octocell {

/// Measured time / expected time of each method, on scenes where it is at home. Only their ratios
/// matter to a plan. They change which exact method is chosen, never an answer.
struct Calibration {
  double home_phantom = 1.0;
  double half_shell = 1.0;
  double brute_force = 1.0;
};

/// Costs as they would be had they been fitted here.
constexpr Costs calibrated(Costs costs, const Calibration& factors) {
  costs.per_id *= factors.home_phantom;
  costs.per_id_and_pass *= factors.home_phantom;
  costs.per_candidate *= factors.home_phantom;
  costs.per_id_of_one *= factors.home_phantom;
  costs.per_run *= factors.home_phantom;
  costs.per_pair *= factors.brute_force;
  costs.per_row *= factors.brute_force;
  ShellCosts& shell = costs.shell;
  for (double* cost : {&shell.per_sphere, &shell.per_row, &shell.per_window, &shell.per_candidate,
                       &shell.per_probe, &shell.per_id, &shell.per_pass, &shell.per_wrapped}) {
    *cost *= factors.half_shell;
  }
  return costs;
}

/// $OCTOCELL_CALIBRATION, or octocell/calibration.json in $XDG_CONFIG_HOME (~/.config). A variable
/// that is set and empty stands for none.
std::filesystem::path calibration_file();

/// What `octocell calibrate` has stored, by backend; empty where nothing is, or where it was
/// measured on another processor. Throws InputError for a file that is not one of ours.
std::map<std::string, Calibration> stored_calibrations();

/// Replaces the file as a whole.
void store(const std::map<std::string, Calibration>& calibrations);

}  // namespace octocell
