// SPDX-License-Identifier: MIT
#include "harness/files/format.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "core/error.hpp"
#include "core/text.hpp"

namespace octocell {
namespace {

namespace fs = std::filesystem;

struct Suffix {
  std::string_view text;
  Format format;
};
constexpr Suffix kOurs[] = {{".npy", Format::npy},   {".csv", Format::table},
                            {".tsv", Format::table}, {".txt", Format::table},
                            {".dat", Format::table}, {".xyzr", Format::table},
                            {".pqr", Format::pqr},   {".spheres", Format::table}};

/// What octocell-import reads. tests/cli/test_cli_formats.py compares this list with the
/// importer's.
constexpr std::string_view kImporters[] = {
    ".pdb",  ".ent", ".pdbqt",  ".cif",  ".mmcif",     ".gro", ".trr", ".xyz", ".extxyz",
    ".data", ".lmp", ".lammps", ".dump", ".lammpstrj", ".vtk", ".ply", ".swc"};

std::string suffix_of(const fs::path& path) { return lower_case(path.extension().string()); }

bool is_packed(const std::string& suffix) {
  return suffix == ".gz" || suffix == ".bz2" || suffix == ".xz";
}

fs::path unpacked(const fs::path& path) {
  return is_packed(suffix_of(path)) ? fs::path(path).replace_extension() : path;
}

std::optional<Format> ours(const fs::path& path) {
  const auto* const known = std::ranges::find(kOurs, suffix_of(path), &Suffix::text);
  return known == std::end(kOurs) ? std::nullopt : std::optional(known->format);
}

bool is_importers(const fs::path& path) {
  return std::ranges::find(kImporters, suffix_of(path)) != std::end(kImporters);
}

}  // namespace

Format format_named(std::string_view name) {
  const auto* const known = std::ranges::find(kFormatNames, name);
  if (known != kFormatNames.end()) return static_cast<Format>(known - kFormatNames.begin());
  throw InputError(
      fmt::format("unknown format {}; known: {}", quote(name), fmt::join(kFormatNames, ", ")));
}

std::optional<Format> format_by_suffix(const std::string& path) {
  return ours(suffix_of(path) == ".gz" ? unpacked(path) : fs::path(path));
}

std::string stem_of(const std::string& path) { return unpacked(path).stem().string(); }

std::string way_out_by_suffix(const std::string& path) {
  const fs::path inner = unpacked(path);
  if (is_importers(inner)) {
    return fmt::format("octocell-import reads this format: octocell-import {} -o {}.npy", path,
                       stem_of(path));
  }
  if (ours(inner)) return "it is packed, and of packed files only .gz is read: unpack it first";
  return "";
}

}  // namespace octocell
