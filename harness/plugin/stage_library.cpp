// SPDX-License-Identifier: MIT
#include "harness/plugin/stage_library.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "core/error.hpp"
#include "harness/plugin/plugin_library.hpp"

namespace octocell {
namespace {

const octocell_sphere* first_of(std::span<const Sphere> spheres) {
  return reinterpret_cast<const octocell_sphere*>(spheres.data());
}

template <typename T>
std::uint32_t count_of(std::span<const T> items) {
  return static_cast<std::uint32_t>(items.size());
}

void require_red_zones(const EntryRoom& room) {
  octocell::require_red_zones(room.ids, "ids");
  octocell::require_red_zones(room.objects, "objects");
}

}  // namespace

StageLibrary::StageLibrary(const std::string& path, const std::string& stage)
    : function_(SharedLibrary(path).function<void()>(stage.c_str())) {
  if (function_ != nullptr) return;
  throw InputError(fmt::format(
      "it has no function {}; in C++, extern \"C\" keeps its name, and octocell_stage.h declares "
      "it so",
      stage));
}

std::uint64_t StageLibrary::cell_ids(std::span<const Sphere> spheres, const octocell_grid& grid,
                                     EntryRoom& room) const {
  std::uint64_t count = 0;
  const int code =
      as<decltype(::cell_ids)>()(first_of(spheres), count_of(spheres), &grid, room.ids.data(),
                                 room.objects.data(), room.ids.capacity(), &count);
  require_success("cell_ids", code);
  require_red_zones(room);
  return count;
}

void StageLibrary::sort(EntryView entries, std::uint32_t key_bits, EntryRoom& room) const {
  const int code =
      as<decltype(::sort)>()(entries.ids.data(), entries.objects.data(), count_of(entries.ids),
                             key_bits, room.ids.data(), room.objects.data());
  require_success("sort", code);
  require_red_zones(room);
}

std::uint64_t StageLibrary::cell_index(EntryView sorted, Room<octocell_cell>& room) const {
  std::uint64_t count = 0;
  const int code =
      as<decltype(::cell_index)>()(sorted.ids.data(), sorted.objects.data(), count_of(sorted.ids),
                                   room.data(), room.capacity(), &count);
  require_success("cell_index", code);
  octocell::require_red_zones(room, "cells");
  return count;
}

std::uint64_t StageLibrary::pair_tests(std::span<const Sphere> spheres, EntryView sorted,
                                       std::span<const octocell_cell> cells,
                                       Room<octocell_pair>& room) const {
  std::uint64_t count = 0;
  const int code = as<decltype(::pair_tests)>()(
      first_of(spheres), count_of(spheres), sorted.ids.data(), sorted.objects.data(),
      count_of(sorted.ids), cells.data(), count_of(cells), room.data(), room.capacity(), &count);
  require_success("pair_tests", code);
  octocell::require_red_zones(room, "pairs");
  return count;
}

}  // namespace octocell
