// SPDX-License-Identifier: MIT
#include "harness/files/load.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "harness/files/format.hpp"
#include "harness/files/leave_out.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

namespace fs = std::filesystem;

Format format_of_stream(const InputFile& file) {
  return file.beginning().starts_with("\x93NUMPY") ? Format::npy : Format::table;
}

Format format_of(const InputFile& file, const std::string& path, const LoadOptions& options) {
  if (options.format) return *options.format;
  if (path == kStandardInput) return format_of_stream(file);
  if (const auto format = format_by_suffix(path)) return *format;
  if (const std::string way_out = way_out_by_suffix(path); !way_out.empty()) file.refuse(way_out);
  const std::string suffix = fs::path(path).extension().string();
  file.refuse(fmt::format("suffix {}, expected {}; --format says what it is: {}", quote(suffix),
                          kOwnSuffixes, fmt::join(kFormatNames, ", ")));
}

/// Throws InputError for an option that does not apply to this format.
void check_options(const InputFile& file, Format format, const LoadOptions& options) {
  const auto refuse_unless = [&](bool allowed, bool is_set, std::string_view option) {
    if (is_set && !allowed) {
      file.refuse(fmt::format("{} does not go with format {}", option, name_of(format)));
    }
  };
  refuse_unless(format != Format::pqr, options.radius.has_value(), "--radius");
  refuse_unless(format == Format::table, options.columns.has_value(), "--columns");
  refuse_unless(format == Format::table, options.decimal_comma, "--decimal-comma");
  refuse_unless(format == Format::pqr, options.frame != 0, "--frame");
}

void load_spheres(InputFile& file, Format format, const LoadOptions& options, Scene& scene) {
  check_options(file, format, options);
  switch (format) {
    case Format::npy:
      return load_npy(file, options, scene);
    case Format::table:
      return load_table(file, options, scene);
    case Format::pqr:
      return load_pqr(file, options, scene);
  }
}

void add_side_file(Scene& scene, const LoadOptions& options) {
  if (!options.flags) return;
  if (options.flags->empty()) throw InputError("cannot read --flags: no file is named");
  InputFile file(*options.flags);
  if (!scene.flags.empty()) {
    file.refuse(fmt::format("{} has flags of its own; only one can count", scene.spec));
  }
  scene.flags = load_flags(file, scene.spheres.size());
}

bool is_generator(std::string_view spec) {
  const std::string_view name = spec.substr(0, spec.find(':'));
  const auto all = scenes();
  return std::any_of(all.begin(), all.end(),
                     [&](const SceneInfo& scene) { return scene.name == name; });
}

bool names_a_file(const std::string& argument) {
  if (argument == kStandardInput || argument.find('/') != std::string::npos) return true;
  if (format_by_suffix(argument) || !way_out_by_suffix(argument).empty()) return true;
  std::error_code ignored;
  return !is_generator(argument) && fs::exists(argument, ignored);
}

/// Returns for instance "a.csv --radius 0.5 --flags a.npy".
std::string spec_of(const std::string& source, std::vector<std::string> words,
                    const LoadOptions& options) {
  if (options.flags) words.insert(words.end(), {"--flags", *options.flags});
  return printable(words.empty() ? source : fmt::format("{} {}", source, fmt::join(words, " ")));
}

}  // namespace

Scene load_scene(const std::string& path, const LoadOptions& options) {
  InputFile file(path);
  Scene scene;
  scene.name = printable(path == kStandardInput ? file.path() : stem_of(path));
  scene.spec = printable(path);
  try {
    load_spheres(file, format_of(file, path, options), options, scene);
    add_side_file(scene, options);
    if (options.drop_invalid) leave_out_invalid(scene);
  } catch (const std::bad_alloc&) {
    throw LimitError(fmt::format("{}: not enough memory for what it holds", path));
  }
  scene.spec = spec_of(path, words_about_file(options), options);
  return scene;
}

std::optional<std::string> file_of(std::string_view scene_argument) {
  std::string argument(scene_argument);
  return names_a_file(argument) ? std::optional(std::move(argument)) : std::nullopt;
}

Scene load_or_generate(std::string_view scene_argument, const LoadOptions& options) {
  if (const auto path = file_of(scene_argument)) return load_scene(*path, options);
  Scene scene = generate(scene_argument, options.round_input ? Unrounded::keep : Unrounded::forget);
  if (const auto words = words_about_file(options); !words.empty()) {
    throw InputError(fmt::format("{} is no file: {} cannot be used", scene.spec, words.front()));
  }
  add_side_file(scene, options);
  scene.spec = spec_of(scene.spec, {}, options);
  return scene;
}

}  // namespace octocell
