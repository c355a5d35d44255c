// SPDX-License-Identifier: MIT
// FCL's SpatialHashingCollisionManager: every box is in the list of each cell that it covers.
#include <fcl/broadphase/broadphase_spatialhash.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_finder.hpp"
#include "baselines/fcl/hash_bounds.hpp"

namespace octocell::baselines {
namespace {

using Manager = fcl::SpatialHashingCollisionManagerd<>;

class SpatialHashing final : public FclFinder<Manager> {
 public:
  explicit SpatialHashing(HashCells cells) : cells_(cells) {}

 private:
  // One list per entry, because a box covers 8 cells. With fewer, most candidates only share a list
  // by chance.
  void make_manager(std::optional<Manager>& manager) override {
    const auto corner = [](const double(&c)[3]) { return fcl::Vector3d(c[0], c[1], c[2]); };
    const auto lists = static_cast<unsigned>(std::max<std::size_t>(8 * spheres().size(), 1000));
    manager.emplace(bounds_->cell, corner(bounds_->lowest), corner(bounds_->highest), lists);
  }

  void make_objects() override {
    bounds_.emplace(spheres(), cells_);
    FclFinder::make_objects();
  }

  // The box and the cells are fixed: boxes outside are clipped, or all compared with each other.
  bool can_follow(SceneView scene) override {
    return std::ranges::all_of(scene.spheres,
                               [this](const Sphere& s) { return bounds_->hold(s); }) &&
           FclFinder::can_follow(scene);
  }

  std::uint64_t pairs_ahead() override {
    return countable() ? bounds_->pairs_in_cells(spheres()) : 0;
  }

  std::optional<std::string> why_impossible() override {
    if (countable()) return std::nullopt;
    return fmt::format("SpatialHash counts cells in int, and this scene has {:.2g} along an axis",
                       bounds_->most_cells());
  }

  [[nodiscard]] bool countable() const { return bounds_->most_cells() < 0x1p31; }

  HashCells cells_;
  std::optional<HashBounds> bounds_;
};

}  // namespace

std::unique_ptr<PairFinder> make_fcl_spatial_hashing() {
  return std::make_unique<SpatialHashing>(HashCells::apart_from_data);
}

std::unique_ptr<PairFinder> make_fcl_spatial_hashing_aligned() {
  return std::make_unique<SpatialHashing>(HashCells::aligned_with_data);
}

}  // namespace octocell::baselines
