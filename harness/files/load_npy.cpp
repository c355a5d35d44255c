// SPDX-License-Identifier: MIT
// NPY: an array of shape (n, 4), columns x, y, z, r.
#include <fmt/format.h>

#include <bit>
#include <span>
#include <string_view>
#include <vector>

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

void check_layout(const InputFile& file, const NpyHeader& header) {
  if (header.shape.size() != 2 || header.shape[1] != 4) {
    file.refuse(fmt::format("shape {}, expected (n, 4): x, y, z, r", header.shape_text()));
  }
  if (header.shape[0] > kMaxSpheres) {
    file.refuse(fmt::format("{} spheres (at most {})", header.shape[0], kMaxSpheres));
  }
  if (header.fortran_order) {
    file.refuse("Fortran order, expected C order (save numpy.ascontiguousarray of it)");
  }
}

template <class AnySphere>
std::vector<AnySphere> read_spheres(InputFile& file, const NpyHeader& header) {
  std::vector<AnySphere> spheres = read_npy_rows<AnySphere>(file, header);
  validate(std::span<const AnySphere>(spheres), file.path());
  return spheres;
}

}  // namespace

void load_npy(InputFile& file, const LoadOptions& options, Scene& scene) {
  const NpyHeader header = read_npy_header(file);
  check_type(file, header, options);
  check_layout(file, header);
  if (header.descr == kFloat32) {
    scene.spheres = read_spheres<Sphere>(file, header);
    return;
  }
  scene.unrounded = read_spheres<DoubleSphere>(file, header);
  scene.spheres.reserve(scene.unrounded->size());
  for (const DoubleSphere& s : *scene.unrounded) scene.spheres.push_back(rounded(s));
}

}  // namespace octocell
