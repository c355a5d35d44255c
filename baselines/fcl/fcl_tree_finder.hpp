// SPDX-License-Identifier: MIT
// FCL's two dynamic AABB trees. They differ in memory layout, not in interface.
#pragma once

#include <optional>

#include "baselines/fcl/fcl_finder.hpp"

namespace octocell::baselines {

/// The setting `tree_init_level` of both managers; 0 is FCL's default.
enum class FclTreeInit : int { median_split = 0, morton = 1 };

template <class Manager>
class FclTreeFinder final : public FclFinder<Manager> {
 public:
  explicit FclTreeFinder(FclTreeInit init) : init_(init) {}

 private:
  void make_manager(std::optional<Manager>& manager) override {
    manager.emplace();
    manager->tree_init_level = static_cast<int>(init_);
  }

  FclTreeInit init_;
};

}  // namespace octocell::baselines
