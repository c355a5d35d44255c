// SPDX-License-Identifier: MIT
#include "harness/files/table_guess.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "core/available_memory.hpp"

namespace octocell {
namespace {

/// Accepts any spelling of a whole number: 7, 7.0, 7.000e+00.
std::optional<std::uint64_t> whole_number(std::string_view text) {
  constexpr double kMost = 0x1p53;
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && stop == text.data() + text.size();
  if (!is_number || value < 0 || value > kMost || value != std::floor(value)) return std::nullopt;
  return static_cast<std::uint64_t>(value);
}

bool is_whole(float value) { return value == std::floor(value); }

}  // namespace

void TableGuess::add(std::string_view first, const Sphere& sphere) {
  if (!may_have_ids_) return;
  const auto id = whole_number(first);
  const bool grows =
      ids_.size() == ids_.capacity();  // most coordinates repeat: then no memory is needed
  if (!id || (grows && !has_each_id_once())) {
    may_have_ids_ = false;
    ids_ = {};
    return;
  }
  append_within_memory(ids_, *id, "ids of a table");
  all_y_whole_ &= is_whole(sphere.y);
  all_z_whole_ &= is_whole(sphere.z);
  all_z_positive_ &= sphere.z > 0;
  all_r_whole_ &= is_whole(sphere.r);
}

bool TableGuess::has_each_id_once() {
  std::ranges::sort(ids_);
  return std::ranges::adjacent_find(ids_) == ids_.end();
}

std::string TableGuess::other_meaning() {
  const bool are_ids = may_have_ids_ && has_each_id_once();
  if (field_count_ == 4) {
    const bool look_like_ids = are_ids && ids_.size() > 1 && !all_y_whole_ && !all_z_whole_;
    if (!look_like_ids) return "";
    return "4 fields and no header, and the first are whole numbers, each once: --columns x,y,z,r "
           "says that they are coordinates, --columns id,x,y,z that they are ids";
  }
  if (field_count_ == 5) {
    if (!are_ids) return "5 fields and no header, and the first are no ids; --columns names them";
    const bool last_may_be_another = all_r_whole_ && all_z_positive_;
    if (!last_may_be_another) return "";
    return "5 fields and no header: --columns id,x,y,z,r or --columns x,y,z,r,id says which they "
           "are";
  }
  return "";
}

}  // namespace octocell
