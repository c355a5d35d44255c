// SPDX-License-Identifier: MIT
#include "harness/doctor/doctor.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "harness/doctor/parts.hpp"

namespace octocell::doctor {
namespace {

bool has(const std::vector<Check>& checks, std::string_view name) {
  return std::any_of(checks.begin(), checks.end(),
                     [&](const Check& check) { return check.name == name && check.here; });
}

}  // namespace

bool Report::is_well() const {
  return std::all_of(ways.begin(), ways.end(),
                     [](const Way& way) { return way.works || way.needs_a_gpu; });
}

Report examine(const std::string& python) {
  Report report;
  report.ways = try_ways(python);
  const auto add = [&](std::vector<Check> checks) {
    std::move(checks.begin(), checks.end(), std::back_inserter(report.checks));
  };
  add({compiler(report.ways.front())});
  add(python_packages(python));
  Way& last = report.ways.back();
  add(cuda(last));
  if (!last.works && !last.compiler.empty() && !has(report.checks, "GPU"))
    last.reason = "compiles, but there is no GPU to run it";
  add(machine());
  return report;
}

}  // namespace octocell::doctor
