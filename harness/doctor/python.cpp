// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

#include "harness/doctor/mend.hpp"
#include "harness/doctor/parts.hpp"

namespace octocell::doctor {
namespace {

/// Prints the version of Python, how to install a package for it, and a line for each package.
/// Finds packages without importing them, because that takes seconds.
constexpr const char* kQuestion = R"py(
import importlib.metadata, importlib.util, os, sys, sysconfig
print(sys.version.split()[0])
managed = os.path.exists(os.path.join(sysconfig.get_path("stdlib"), "EXTERNALLY-MANAGED"))
own = sys.prefix != sys.base_prefix or not managed
new = "python3 -m venv mine && mine/bin/python -m pip install {} (then --python mine/bin/python)"
print(sys.executable + " -m pip install {}" if own else new)
for name in ("numpy", "numba", "cupy", "torch", "triton", "warp"):
    try:
        version = importlib.metadata.version("warp-lang" if name == "warp" else name)
    except importlib.metadata.PackageNotFoundError:
        version = "here" if importlib.util.find_spec(name) else ""
    print(name, version)
)py";

std::string replace_braces(std::string text, const std::string& name) {
  const std::size_t place = text.find("{}");
  return place == std::string::npos ? text : text.replace(place, 2, name);
}

}  // namespace

std::vector<Check> python_packages(const std::string& python) {
  const auto lines = lines_of({python, "-c", kQuestion});
  if (lines.size() < 3) {
    return {{"Python", false, fmt::format("{} does not run", python),
             install({"python3-numpy", "python3-numpy", "python-numpy", "numpy"})}};
  }
  std::vector<Check> checks = {{"Python", true, fmt::format("{} {}", python, lines[0])}};
  std::string others;
  for (std::size_t k = 2; k < lines.size(); ++k) {
    const std::size_t blank = lines[k].find(' ');
    const std::string name = lines[k].substr(0, blank);
    const std::string version = lines[k].substr(blank + 1);
    if (name == "numpy") {
      const bool here = !version.empty();
      checks.push_back({"NumPy", here, here ? version : "not here; hand-ins in Python need it",
                        here ? "" : replace_braces(lines[1], "numpy")});
    } else if (!version.empty()) {
      others += fmt::format("{}{} {}", others.empty() ? "" : ", ", name, version);
    }
  }
  // A matter of taste: nothing to mend.
  checks.push_back({"fast Python", !others.empty(),
                    others.empty() ? "none of numba, cupy, torch, triton, warp" : others});
  return checks;
}

}  // namespace octocell::doctor
