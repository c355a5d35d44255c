// SPDX-License-Identifier: MIT
#include "harness/scenes/save.hpp"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

#include "harness/interface/error.hpp"
#include "harness/scenes/npy_header.hpp"
#include "harness/scenes/output_file.hpp"
#include "harness/scenes/text.hpp"

namespace octocell {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are written as they lie in memory");
static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));

void check_name(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type != fs::file_type::not_found && type != fs::file_type::regular) return;
  if (lower_case(fs::path(path).extension().string()) == ".npy") return;
  throw InputError(
      fmt::format("cannot write {}: the name must end in .npy, the format is NPY", path));
}

void save_table(const std::string& path, const std::string& header,
                std::span<const std::byte> rows) {
  check_name(path);
  write_whole_file(path, {std::as_bytes(std::span(header)), rows});
}

}  // namespace

void save_scene(const std::string& path, std::span<const Sphere> spheres) {
  save_table(path, npy_header_bytes("<f4", spheres.size(), 4), std::as_bytes(spheres));
}

void save_pairs(const std::string& path, std::span<const Pair> pairs) {
  save_table(path, npy_header_bytes("<u4", pairs.size(), 2), std::as_bytes(pairs));
}

}  // namespace octocell
