// SPDX-License-Identifier: MIT
#include "harness/scenes/save.hpp"

#include <fmt/format.h>

#include <bit>
#include <filesystem>
#include <iterator>

#include "harness/interface/error.hpp"
#include "harness/interface/flags.hpp"
#include "harness/scenes/npy_header.hpp"
#include "harness/scenes/output_file.hpp"
#include "harness/scenes/text.hpp"

namespace octocell {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");
static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));

std::string ending_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

bool is_csv(const std::string& path) { return ending_of(path) == ".csv"; }

enum class Csv : bool { never, possible };

void check_name(const std::string& path, Csv csv) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type != fs::file_type::not_found && type != fs::file_type::regular) return;
  if (ending_of(path) == ".npy" || (csv == Csv::possible && is_csv(path))) return;
  throw InputError(
      fmt::format("cannot write {}: the name must end in .npy{}", path,
                  csv == Csv::possible ? " or .csv, which say the format" : ", the format is NPY"));
}

void check_two_files(const std::string& path, const std::string& other, std::string_view what) {
  namespace fs = std::filesystem;
  if (fs::path(path).lexically_normal() != fs::path(other).lexically_normal()) return;
  throw InputError(fmt::format("cannot write {}: {} need a file each", path, what));
}

void check_flags(const std::string& path, SceneView scene, const std::string& flags_path) {
  if (flags_path.empty() && !scene.flags.empty() && !is_csv(path)) {
    throw InputError(fmt::format(
        "cannot write {}: NPY has no room for the scene's flags; --flags-output names a file for "
        "them, and .csv has columns",
        path));
  }
  check_two_files(path, flags_path, "spheres and flags");
}

std::string table_header(std::string_view descr, std::size_t rows, std::size_t columns) {
  return npy_header_bytes(descr, fmt::format("({}, {})", rows, columns));
}

std::string list_header(std::string_view descr, std::size_t count) {
  return npy_header_bytes(descr, fmt::format("({},)", count));
}

std::string pairs_header(std::span<const Pair> pairs) {
  return table_header("<u4", pairs.size(), 2);
}

/// Shortest decimals that are read as the same floats.
std::string csv_of(std::span<const Sphere> spheres, std::span<const Flags> flags) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "x,y,z,r{}\n", flags.empty() ? "" : ",static,group,mask");
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Sphere& s = spheres[i];
    fmt::format_to(out, "{},{},{},{}", s.x, s.y, s.z, s.r);
    if (!flags.empty()) {
      fmt::format_to(out, ",{},{},{}", is_static(flags[i]) ? 1 : 0, group_of(flags[i]),
                     mask_of(flags[i]));
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace

void save_scene(const std::string& path, SceneView scene, const std::string& flags_path) {
  check_name(path, Csv::possible);
  check_flags(path, scene, flags_path);
  std::vector<FileToWrite> files;
  const std::string begin =
      is_csv(path)
          ? csv_of(scene.spheres, flags_path.empty() ? scene.flags : std::span<const Flags>())
          : table_header("<f4", scene.spheres.size(), 4);
  files.push_back({path, {std::as_bytes(std::span(begin))}});
  if (!is_csv(path)) files.back().parts.push_back(std::as_bytes(scene.spheres));
  if (flags_path.empty()) return write_whole_files(files);

  check_name(flags_path, Csv::never);
  const std::string header = list_header("<u4", scene.spheres.size());
  const std::vector<Flags> none(scene.flags.empty() ? scene.spheres.size() : 0);
  files.push_back(
      {flags_path,
       {std::as_bytes(std::span(header)),
        std::as_bytes(scene.flags.empty() ? std::span<const Flags>(none) : scene.flags)}});
  write_whole_files(files);
}

void save_pairs(const std::string& path, std::span<const Pair> pairs) {
  check_name(path, Csv::never);
  const std::string header = pairs_header(pairs);
  write_whole_file(path, {std::as_bytes(std::span(header)), std::as_bytes(pairs)});
}

void save_depths(const std::string& path, std::span<const float> depths,
                 const std::string& pairs_path, std::span<const Pair> pairs) {
  check_name(path, Csv::never);
  const std::string header = list_header("<f4", depths.size());
  std::vector<FileToWrite> files = {
      {path, {std::as_bytes(std::span(header)), std::as_bytes(depths)}}};
  const std::string header_of_pairs = pairs_header(pairs);
  if (!pairs_path.empty()) {
    check_name(pairs_path, Csv::never);
    check_two_files(path, pairs_path, "depths and pairs");
    files.push_back(
        {pairs_path, {std::as_bytes(std::span(header_of_pairs)), std::as_bytes(pairs)}});
  }
  write_whole_files(files);
}

}  // namespace octocell
