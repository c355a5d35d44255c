// SPDX-License-Identifier: MIT
// Flags in a file of their own, NPY of shape (n,): words as in sphere.hpp (uint32), or only which
// spheres are static (bool, or uint8 with 0 and 1).
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/text.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/files/npy_header.hpp"

namespace octocell {
namespace {

constexpr std::string_view kWords = "<u4";

bool only_tells_static(const NpyHeader& header) {
  return header.descr == "|b1" || header.descr == "|u1";
}

void check_type(const InputFile& file, const NpyHeader& header) {
  if (header.descr == kWords || only_tells_static(header)) return;
  file.refuse(fmt::format(
      "numbers of type {}, expected '{}' (uint32: words of flags), or '|b1' (bool: static or not)",
      quote(header.descr), kWords));
}

void check_length(const InputFile& file, const NpyHeader& header, std::size_t sphere_count) {
  if (header.shape.size() != 1) {
    file.refuse(fmt::format("shape {}, expected (n,): one a sphere", header.shape_text()));
  }
  if (header.shape[0] != sphere_count) {
    file.refuse(
        fmt::format("flags of {} spheres, and the scene has {}", header.shape[0], sphere_count));
  }
}

}  // namespace

std::vector<Flags> load_flags(InputFile& file, std::size_t sphere_count) {
  const NpyHeader header = read_npy_header(file);
  check_type(file, header);
  check_length(file, header, sphere_count);
  if (!only_tells_static(header)) return read_npy_rows<Flags>(file, header);
  std::vector<Flags> flags;
  flags.reserve(sphere_count);
  for (const std::uint8_t value : read_npy_rows<std::uint8_t>(file, header)) {
    if (value > 1) {
      file.refuse(fmt::format("sphere {}: static is {} (must be 0 or 1)", flags.size(), value));
    }
    flags.push_back(make_flags(value == 1, 1, kMaxMask));
  }
  return flags;
}

}  // namespace octocell
