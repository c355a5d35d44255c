// SPDX-License-Identifier: MIT
#include "harness/cli/scene_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/files/decimal.hpp"

namespace octocell::cli {
namespace {

float radius_in(const std::string& text) {
  const DecimalFloat parsed = parse_float(text);
  const bool is_radius = parsed.kind == DecimalFloat::Kind::number && std::isfinite(parsed.value) &&
                         parsed.value >= 0.0F;
  if (!is_radius) throw InputError(fmt::format("--radius {}: must be a number >= 0", text));
  return parsed.value;
}

}  // namespace

void add_scene_options(CLI::App& sub, LoadOptions& options) {
  sub.add_option("--flags", options.flags,
                 "NPY beside the scene, (N,): uint32 words of flags, or bool: which spheres are "
                 "static");
  sub.add_flag("--round-input", options.round_input,
               "Accept a float64 NPY and round it to float32; find and bench say of it, and of "
               "generators, which pairs that changed");
  sub.add_option_function<std::string>(
      "--radius", [&options](const std::string& text) { options.radius = radius_in(text); },
      "One radius for all spheres of a file that holds none");
  sub.add_option("--columns", options.columns,
                 "Name the columns of a table: id,x,y,z,r; names beside x, y, z, r, static, group "
                 "and mask are not read");
  sub.add_flag("--decimal-comma", options.decimal_comma, "Read 0,5 in a table as a half");
  sub.add_option_function<std::string>(
      "--format", [&options](const std::string& name) { options.format = format_named(name); },
      "npy, table (CSV or text) or pqr, where the file's name does not say it");
  sub.add_option("--frame", options.frame, "Of a PQR file with models, from 0 (default)");
  sub.add_flag("--drop-invalid", options.drop_invalid,
               "Leave spheres out that are not finite or have r < 0, and say how many");
}

Scene load_and_say(std::string_view scene_argument, const LoadOptions& options) {
  Scene scene = load_or_generate(scene_argument, options);
  for (const std::string& note : scene.notes) {
    fmt::print(stderr, "octocell: {}: {}\n", printable(scene_argument), printable(note));
  }
  return scene;
}

}  // namespace octocell::cli
