// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/files/load.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

std::string extension_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

bool is_known(std::string_view extension) {
  return extension == ".npy" || extension == ".csv" || extension == ".pqr";
}

/// Returns true for formats that octocell-import reads and octocell does not.
bool is_importers(std::string_view extension) {
  constexpr std::string_view kExtensions[] = {".gro",  ".pdb", ".ent",      ".xyz", ".extxyz",
                                              ".data", ".lmp", ".lammps",   ".ply", ".trr",
                                              ".dump", ".gz",  ".lammpstrj"};
  return std::ranges::find(kExtensions, extension) != std::end(kExtensions);
}

std::string words_for_importer(const std::string& path) {
  const std::string stem = std::filesystem::path(path).stem().string();
  return fmt::format("octocell-import reads this format: octocell-import {} -o {}.npy", path, stem);
}

void load_by_extension(InputFile& file, const LoadOptions& options, Scene& scene) {
  const std::string extension = extension_of(file.path());
  if (extension == ".npy") return load_npy(file, options, scene);
  if (extension == ".csv") {
    load_csv(file, scene);
    return;
  }
  if (extension == ".pqr") {
    scene.spheres = load_pqr(file);
    return;
  }
  if (is_importers(extension)) file.refuse(words_for_importer(file.path()));
  file.refuse(fmt::format("extension {}, expected .npy, .csv or .pqr", quote(extension)));
}

void add_side_file(Scene& scene, const LoadOptions& options) {
  if (!options.flags) return;
  if (options.flags->empty()) throw InputError("cannot read --flags: no file is named");
  InputFile file(*options.flags);
  if (!scene.flags.empty()) {
    file.refuse(fmt::format("{} has flags of its own; only one can count", scene.spec));
  }
  scene.flags = load_flags(file, scene.spheres.size());
  scene.spec += " --flags " + printable(*options.flags);
}

bool is_generator(std::string_view spec) {
  const std::string_view name = spec.substr(0, spec.find(':'));
  const auto all = scenes();
  return std::any_of(all.begin(), all.end(),
                     [&](const SceneInfo& scene) { return scene.name == name; });
}

bool names_a_file(const std::string& argument) {
  const std::string extension = extension_of(argument);
  const bool is_files = is_known(extension) || is_importers(extension);
  if (argument.find('/') != std::string::npos || is_files) return true;
  std::error_code ignored;
  return !is_generator(argument) && std::filesystem::exists(argument, ignored);
}

}  // namespace

Scene load_scene(const std::string& path, const LoadOptions& options) {
  InputFile file(path);
  Scene scene;
  scene.name = printable(std::filesystem::path(path).stem().string());
  scene.spec = printable(path);
  try {
    load_by_extension(file, options, scene);
    add_side_file(scene, options);
  } catch (const std::bad_alloc&) {
    throw LimitError(fmt::format("{}: not enough memory for its {} bytes", path, file.size()));
  }
  return scene;
}

std::optional<std::string> file_of(std::string_view scene_argument) {
  std::string argument(scene_argument);
  return names_a_file(argument) ? std::optional(std::move(argument)) : std::nullopt;
}

Scene load_or_generate(std::string_view scene_argument, const LoadOptions& options) {
  if (const auto path = file_of(scene_argument)) return load_scene(*path, options);
  Scene scene = generate(scene_argument, options);
  add_side_file(scene, options);
  return scene;
}

}  // namespace octocell
