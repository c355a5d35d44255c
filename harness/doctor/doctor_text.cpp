// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string>

#include <nlohmann/json.hpp>

#include "harness/doctor/doctor.hpp"

namespace octocell::doctor {

std::string to_text(const Report& report) {
  std::string text;
  for (const Check& check : report.checks) {
    text += fmt::format("{} {:<10} {}\n", check.here ? " " : "-", check.name, check.found);
    if (!check.mend.empty()) text += fmt::format("  {:<10} mend: {}\n", "", check.mend);
  }
  text += "\n";
  for (const Way& way : report.ways) {
    text += fmt::format("{} {:<10} {:<22} {}\n", way.works ? " " : "-", way.name, way.command,
                        way.works ? "works" : way.reason);
  }
  return text;
}

nlohmann::ordered_json to_json(const Report& report) {
  auto checks = nlohmann::ordered_json::array();
  for (const Check& check : report.checks) {
    checks.push_back(
        {{"name", check.name}, {"here", check.here}, {"found", check.found}, {"mend", check.mend}});
  }
  auto ways = nlohmann::ordered_json::array();
  for (const Way& way : report.ways) {
    ways.push_back({{"name", way.name},
                    {"command", way.command},
                    {"works", way.works},
                    {"reason", way.reason}});
  }
  return {{"well", report.is_well()}, {"checks", checks}, {"ways", ways}};
}

}  // namespace octocell::doctor
