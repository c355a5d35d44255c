// SPDX-License-Identifier: MIT
// Batches side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "harness/engine/images/image_parts.hpp"
#include "harness/engine/images/image_scene.hpp"

namespace octocell::images {

/// Puts the batches into equal slots, which fill a cube. Where a slot begins matters only for
/// speed: what lies in one batch is moved by one vector, and pairs of two batches are left out
/// later.
void Images::place_batches() {
  offsets_.clear();
  batches_ = 1.0;
  batches_end_ = 0.0;
  const auto batch = question_.batch;
  if (batch.empty()) return;
  const std::uint32_t last = *std::ranges::max_element(batch);
  if (last >= kMaxSpheres) {
    throw InputError(fmt::format("batch: number {}; must be below {}", last, kMaxSpheres));
  }
  struct Extent {
    Range along[3] = {kNothing, kNothing, kNothing};
  };
  require_memory((last + 1.0) * (sizeof(Extent) + sizeof(Offset)), "batches");
  std::vector<Extent> extents(last + std::size_t{1});
  for (std::uint32_t i = 0; i < batch.size(); ++i) {
    const Moved home = moved(i, home_of(i));
    for (int k = 0; k < 3; ++k) widen(extents[batch[i]].along[k], home.at[k], home.at[k]);
  }
  const auto is_used = [](const Extent& e) { return e.along[0].lowest <= e.along[0].highest; };
  const auto used = static_cast<std::uint64_t>(std::ranges::count_if(extents, is_used));
  const auto side = static_cast<std::uint64_t>(std::ceil(std::cbrt(static_cast<double>(used))));
  double pitch[3];
  for (int k = 0; k < 3; ++k) {
    pitch[k] = 4.0 * (r_max_ + question_.gap);
    for (int a = 0; a < 3; ++a) pitch[k] += box_.periodic[a] ? std::abs(box_.h[a][k]) : 0.0;
    double widest = 0.0;
    for (const Extent& e : extents) {
      if (is_used(e)) widest = std::max(widest, e.along[k].highest - e.along[k].lowest);
    }
    pitch[k] += widest;
    batches_end_ = std::max(batches_end_, pitch[k] * static_cast<double>(side));
  }
  offsets_.resize(extents.size());
  std::uint64_t slot = 0;
  for (std::size_t b = 0; b < extents.size(); ++b) {
    if (!is_used(extents[b])) continue;
    const std::uint64_t at[3] = {slot % side, slot / side % side, slot / side / side};
    for (int k = 0; k < 3; ++k) {
      offsets_[b].along[k] = static_cast<double>(at[k]) * pitch[k] - extents[b].along[k].lowest;
    }
    ++slot;
  }
  batches_ = static_cast<double>(used);
}

}  // namespace octocell::images
