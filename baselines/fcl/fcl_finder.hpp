// SPDX-License-Identifier: MIT
// Drives every collision manager of FCL through their common interface.
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "baselines/baseline_finder.hpp"
#include "baselines/fcl/fcl_objects.hpp"

namespace octocell::baselines {

template <class Manager>
class FclFinder : public BaselineFinder {
 protected:
  /// Makes an empty manager for the current spheres. Override it if the settings matter.
  virtual void make_manager(std::optional<Manager>& manager) {
    if constexpr (std::is_default_constructible_v<Manager>) manager.emplace();
  }

  void make_objects() override { objects_.make(spheres()); }

  bool can_follow(SceneView scene) override {
    objects_.change_radii(scene.spheres);
    return true;
  }

  [[nodiscard]] const FclObjects& objects() const { return objects_; }

 private:
  // Makes a new manager instead of calling clear(), which keeps the buckets of a tree's table and
  // forgets some lists of other managers.
  void tear_down() final { manager_.reset(); }

  // registerObjects() builds in bulk only if the manager is empty.
  void build() final {
    make_manager(manager_);
    manager_->registerObjects(objects_.pointers());
    manager_->setup();
  }

  void follow() final {
    objects_.move(spheres());
    manager_->update();
  }

  void query() final {
    Query query = {&sink(), objects_.first()};
    manager_->collide(&query, on_candidate);
  }

  struct Query {
    CandidateSink* sink;
    const FclObjects::Object* first;
  };

  // Returns true to stop. Ids follow from addresses, so the objects are not loaded into the cache.
  static bool on_candidate(FclObjects::Object* a, FclObjects::Object* b, void* data) {
    const Query& query = *static_cast<const Query*>(data);
    return !query.sink->test(static_cast<std::uint32_t>(a - query.first),
                             static_cast<std::uint32_t>(b - query.first));
  }

  FclObjects objects_;
  std::optional<Manager> manager_;
};

}  // namespace octocell::baselines
