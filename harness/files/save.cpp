// SPDX-License-Identifier: MIT
#include "harness/files/save.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/depth.hpp"
#include "core/error.hpp"
#include "core/flags.hpp"
#include "core/text.hpp"
#include "harness/files/npy_header.hpp"
#include "harness/files/output_file.hpp"

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

void check_flags(const std::string& path, SceneView scene, const std::string& flags_path) {
  if (flags_path.empty() && !scene.flags.empty() && !is_csv(path)) {
    throw InputError(fmt::format(
        "cannot write {}: NPY has no room for the scene's flags; --flags-output names a file for "
        "them, and .csv has columns",
        path));
  }
}

std::string table_header(std::string_view descr, std::size_t rows, std::size_t columns) {
  return npy_header_bytes(descr, fmt::format("({}, {})", rows, columns));
}

std::string list_header(std::string_view descr, std::size_t count) {
  return npy_header_bytes(descr, fmt::format("({},)", count));
}

/// That many rows are converted at a time.
constexpr std::size_t kRowsAtOnce = 1 << 14;

/// Appends rows [begin, end) in the shortest decimals that are read as the same floats.
void append_csv(fmt::memory_buffer& text, SceneView scene, std::size_t begin, std::size_t end) {
  const auto out = std::back_inserter(text);
  for (std::size_t i = begin; i < end; ++i) {
    const Sphere& s = scene.spheres[i];
    fmt::format_to(out, "{},{},{},{}", s.x, s.y, s.z, s.r);
    if (!scene.flags.empty()) {
      const Flags f = scene.flags[i];
      fmt::format_to(out, ",{},{},{}", is_static(f) ? 1 : 0, group_of(f), mask_of(f));
    }
    text.push_back('\n');
  }
}

FileToWrite csv_file(const std::string& path, SceneView scene) {
  return {path, [scene](const ByteSink& sink) {
            fmt::memory_buffer text;
            fmt::format_to(std::back_inserter(text), "x,y,z,r{}\n",
                           scene.flags.empty() ? "" : ",static,group,mask");
            for (std::size_t begin = 0; begin < scene.spheres.size(); begin += kRowsAtOnce) {
              append_csv(text, scene, begin, std::min(begin + kRowsAtOnce, scene.spheres.size()));
              sink(std::as_bytes(std::span(text.data(), text.size())));
              text.clear();
            }
            sink(std::as_bytes(std::span(text.data(), text.size())));
          }};
}

template <typename Row>
FileToWrite npy_file(const std::string& path, std::string header, std::span<const Row> rows) {
  return {path, [header = std::move(header), rows](const ByteSink& sink) {
            sink(std::as_bytes(std::span(header)));
            sink(std::as_bytes(rows));
          }};
}

FileToWrite pairs_file(const std::string& path, std::span<const Pair> pairs) {
  return npy_file(path, table_header("<u4", pairs.size(), 2), pairs);
}

FileToWrite depths_file(const std::string& path, std::span<const Sphere> spheres,
                        std::span<const Pair> pairs) {
  return {path, [=](const ByteSink& sink) {
            const std::string header = list_header("<f4", pairs.size());
            sink(std::as_bytes(std::span(header)));
            for (std::size_t begin = 0; begin < pairs.size(); begin += kRowsAtOnce) {
              const auto some = pairs.subspan(begin, std::min(kRowsAtOnce, pairs.size() - begin));
              const std::vector<float> depths = penetration_depths(spheres, some);
              sink(std::as_bytes(std::span(depths)));
            }
          }};
}

}  // namespace

void require_savable_scene(const std::string& path) {
  check_name(path, Csv::possible);
  require_writable(path);
}

void require_savable_list(const std::string& path) {
  check_name(path, Csv::never);
  require_writable(path);
}

void save_scene(const std::string& path, SceneView scene, const std::string& flags_path) {
  check_name(path, Csv::possible);
  check_flags(path, scene, flags_path);
  std::vector<FileToWrite> files;
  if (is_csv(path)) {
    files.push_back(csv_file(path, flags_path.empty() ? scene : SceneView{scene.spheres}));
  } else {
    files.push_back(npy_file(path, table_header("<f4", scene.spheres.size(), 4), scene.spheres));
  }
  if (flags_path.empty()) return write_whole_files(files);

  check_name(flags_path, Csv::never);
  const std::vector<Flags> none(scene.flags.empty() ? scene.spheres.size() : 0);
  files.push_back(npy_file(flags_path, list_header("<u4", scene.spheres.size()),
                           scene.flags.empty() ? std::span<const Flags>(none) : scene.flags));
  write_whole_files(files);
}

void save_pairs(const std::string& path, std::span<const Pair> pairs) {
  check_name(path, Csv::never);
  const FileToWrite file = pairs_file(path, pairs);
  write_whole_files({&file, 1});
}

void save_image_pairs(const std::string& path, std::span<const Pair> pairs,
                      const std::string& shifts_path, std::span<const Shift> shifts) {
  std::vector<FileToWrite> files;
  if (!path.empty()) {
    check_name(path, Csv::never);
    files.push_back(pairs_file(path, pairs));
  }
  if (!shifts_path.empty()) {
    check_name(shifts_path, Csv::never);
    files.push_back(npy_file(shifts_path, table_header("<i4", shifts.size(), 3), shifts));
  }
  if (!files.empty()) write_whole_files(files);
}

void save_depths(const std::string& path, std::span<const Sphere> spheres,
                 std::span<const Pair> pairs, const std::string& pairs_path) {
  check_name(path, Csv::never);
  std::vector<FileToWrite> files = {depths_file(path, spheres, pairs)};
  if (!pairs_path.empty()) {
    check_name(pairs_path, Csv::never);
    files.push_back(pairs_file(pairs_path, pairs));
  }
  write_whole_files(files);
}

}  // namespace octocell
