// SPDX-License-Identifier: MIT
// NPY: an array of shape (n, 4), columns x, y, z, r; or (n, 3), and one radius for all.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/available_memory.hpp"
#include "core/text.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/files/npy_header.hpp"
#include "harness/files/validate.hpp"

namespace octocell {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are read as they lie in the file");
constexpr std::string_view kFloat32 = "<f4";
constexpr std::string_view kFloat64 = "<f8";

void check_type(const InputFile& file, const NpyHeader& header, const LoadOptions& options) {
  if (header.descr == kFloat32 || (header.descr == kFloat64 && options.round_input)) return;
  std::string_view hint;
  if (header.descr == kFloat64) hint = "; --round-input rounds float64 to it";
  if (header.descr.starts_with('>')) hint = "; this file is big-endian";
  file.refuse(fmt::format("numbers of type {}, expected '{}' (float32){}", quote(header.descr),
                          kFloat32, hint));
}

void check_columns(const InputFile& file, const NpyHeader& header, const LoadOptions& options) {
  const std::string shape = header.shape_text();
  const std::uint64_t columns = header.shape.size() == 2 ? header.shape[1] : 0;
  if (columns == 3 && !options.radius) {
    file.refuse(fmt::format("shape {} has no radii; --radius R gives all spheres one", shape));
  }
  if (columns == 4 && options.radius) {
    file.refuse(fmt::format("shape {} has radii; --radius is for (n, 3): x, y, z", shape));
  }
  if (columns != 3 && columns != 4) {
    file.refuse(fmt::format("shape {}, expected (n, 4): x, y, z, r", shape));
  }
}

void check_layout(const InputFile& file, const NpyHeader& header) {
  if (header.shape[0] > kMaxSpheres) {
    file.refuse(fmt::format("{} spheres (at most {})", header.shape[0], kMaxSpheres));
  }
  if (header.fortran_order) {
    file.refuse("Fortran order, expected C order (save numpy.ascontiguousarray of it)");
  }
}

template <class AnySphere>
std::vector<AnySphere> read_spheres(InputFile& file, const NpyHeader& header,
                                    const LoadOptions& options) {
  if (!options.radius) return read_npy_rows<AnySphere>(file, header);
  using Number = decltype(AnySphere::x);
  const auto points = read_npy_rows<std::array<Number, 3>>(file, header);
  require_memory(static_cast<double>(points.size()) * sizeof(AnySphere), file.path());
  std::vector<AnySphere> spheres;
  spheres.reserve(points.size());
  for (const auto& [x, y, z] : points) spheres.push_back({x, y, z, Number{*options.radius}});
  return spheres;
}

template <class AnySphere>
std::vector<AnySphere> read_valid(InputFile& file, const NpyHeader& header,
                                  const LoadOptions& options) {
  std::vector<AnySphere> spheres = read_spheres<AnySphere>(file, header, options);
  if (!options.drop_invalid) validate(std::span<const AnySphere>(spheres), file.path());
  return spheres;
}

}  // namespace

void load_npy(InputFile& file, const LoadOptions& options, Scene& scene) {
  const NpyHeader header = read_npy_header(file);
  check_type(file, header, options);
  check_columns(file, header, options);
  check_layout(file, header);
  if (header.descr == kFloat32) {
    scene.spheres = read_valid<Sphere>(file, header, options);
    return;
  }
  scene.unrounded = read_valid<DoubleSphere>(file, header, options);
  scene.spheres.reserve(scene.unrounded->size());
  for (const DoubleSphere& s : *scene.unrounded) scene.spheres.push_back(rounded(s));
}

}  // namespace octocell
