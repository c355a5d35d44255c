// SPDX-License-Identifier: MIT
// How FCL's two dynamic AABB trees are driven. They differ in memory layout, not in interface.
#pragma once

#include <optional>

#include "baselines/baseline_finder.hpp"
#include "baselines/fcl/fcl_objects.hpp"

namespace octocell::baselines {

/// `tree_init_level` of both managers; 0 is what FCL does if it is not told otherwise.
enum class FclTreeInit : int { median_split = 0, morton = 1 };

template <class Manager>
class FclTreeFinder final : public BaselineFinder {
 public:
  explicit FclTreeFinder(FclTreeInit init) : init_(init) { tear_down(); }

 private:
  void make_objects() override { objects_.make(spheres()); }

  bool can_follow(SceneView scene) override {
    objects_.change_radii(scene.spheres);
    return true;
  }

  // A new manager instead of clear(), which would keep the buckets of its table.
  void tear_down() override {
    manager_.emplace();
    manager_->tree_init_level = static_cast<int>(init_);
  }

  // registerObjects() builds in bulk only while the manager is empty.
  void build() override {
    manager_->registerObjects(objects_.pointers());
    manager_->setup();
  }

  void follow() override {
    objects_.move(spheres());
    manager_->update();
  }

  void query() override {
    Query query = {&sink(), objects_.first()};
    manager_->collide(&query, on_candidate);
  }

  struct Query {
    CandidateSink* sink;
    const FclObjects::Object* first;
  };

  // Returns true to stop. Ids come from addresses: the objects themselves stay out of the cache.
  static bool on_candidate(FclObjects::Object* a, FclObjects::Object* b, void* data) {
    const Query& query = *static_cast<const Query*>(data);
    return !query.sink->test(static_cast<std::uint32_t>(a - query.first),
                             static_cast<std::uint32_t>(b - query.first));
  }

  FclTreeInit init_;
  FclObjects objects_;
  std::optional<Manager> manager_;
};

}  // namespace octocell::baselines
