// SPDX-License-Identifier: MIT
// Bullet's btDbvtBroadphase: two btDbvt (moving and resting proxies), and a cache of pairs.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "baselines/baseline_finder.hpp"
#include "baselines/baselines.hpp"
#include "baselines/bullet/branch_limit.hpp"
#include "baselines/bullet/bullet_box.hpp"
#include "baselines/bullet/client.hpp"
#include "baselines/bullet/pair_limit.hpp"

namespace octocell::baselines {
namespace {

/// m_deferedcollide: finds pairs while proxies are inserted, or all in one tree-tree pass.
enum class Collide : bool { immediately, deferred };

/// A broad phase with its proxies, which Bullet does not free.
class World {
 public:
  World(Collide collide, std::uint64_t candidate_limit)
      : limit_(*broadphase_.getOverlappingPairCache(), collide == Collide::deferred
                                                           ? PairLimit::OnReached::leave
                                                           : PairLimit::OnReached::refuse_pairs) {
    limit_.set(candidate_limit);
    broadphase_.m_deferedcollide = collide == Collide::deferred;
    broadphase_.getOverlappingPairCache()->setOverlapFilterCallback(&limit_);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // destroyProxy() would search the whole pair cache for every proxy.
  ~World() {
    for (btBroadphaseProxy* proxy : proxies_) btAlignedFree(proxy);
  }

  void reserve(std::size_t count) { proxies_.reserve(count); }

  /// Returns false if Bullet cannot continue.
  [[nodiscard]] bool insert(std::span<const Sphere> spheres) {
    for (const Sphere& s : spheres) {
      const BulletBox box = bullet_box(s);
      proxies_.push_back(broadphase_.createProxy(box.lowest, box.highest, SPHERE_SHAPE_PROXYTYPE,
                                                 client_of(proxies_.size()), 1, 1, nullptr));
      if (limit_.reached()) return true;
      if (branch_too_long(leaf(proxies_.back()), proxies_.size())) return false;
    }
    return true;
  }

  /// Returns false if Bullet cannot continue.
  [[nodiscard]] bool move(std::span<const Sphere> spheres) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const BulletBox box = bullet_box(spheres[i]);
      broadphase_.setAabb(proxies_[i], box.lowest, box.highest, nullptr);
      if (limit_.reached()) return true;
      if (branch_too_long(leaf(proxies_[i]), i)) return false;
    }
    return true;
  }

  void collide() {
    if (limit_.reached()) return;
    try {
      broadphase_.calculateOverlappingPairs(nullptr);
    } catch (const PairLimit::Reached&) {
      return;
    }
  }

  [[nodiscard]] bool limit_reached() const { return limit_.reached(); }
  [[nodiscard]] const btBroadphasePairArray& pairs() {
    return broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
  }

 private:
  static const btDbvtNode* leaf(const btBroadphaseProxy* proxy) {
    return static_cast<const btDbvtProxy*>(proxy)->leaf;
  }

  btDbvtBroadphase broadphase_;
  PairLimit limit_;
  std::vector<btBroadphaseProxy*> proxies_;  // [sphere]
};

class DbvtBroadphase final : public BaselineFinder {
 public:
  explicit DbvtBroadphase(Collide collide) : collide_(collide) {}

 private:
  void make_objects() override { all_narrow_ = narrow(spheres()); }

  bool can_follow(SceneView scene) override {
    const bool were_narrow = std::exchange(all_narrow_, narrow(scene.spheres));
    return were_narrow && all_narrow_;
  }

  // setAabb() multiplies a box's extent by a predicted motion of 0. For an infinite extent that
  // gives NaN, and such a box meets nothing.
  static bool narrow(std::span<const Sphere> spheres) {
    return std::ranges::all_of(spheres, [](const Sphere& s) { return s.r < kFloatMax / 4; });
  }

  void tear_down() override { world_.reset(); }

  void build() override {
    world_.emplace(collide_, sink().candidate_limit());
    world_->reserve(spheres().size());
    if (!world_->insert(spheres())) sink().refuse(kBranchTooLong);
  }

  void follow() override {
    if (!world_->move(spheres())) sink().refuse(kBranchTooLong);
  }

  // The cache holds more than the pairs whose boxes meet: boxes have a margin, and each call drops
  // only a tenth of the pairs that have separated.
  void query() override {
    world_->collide();
    const btBroadphasePairArray& pairs = world_->pairs();
    for (int k = 0; k < pairs.size(); ++k) {
      if (!sink().test(id_of(pairs[k].m_pProxy0), id_of(pairs[k].m_pProxy1))) return;
    }
    if (world_->limit_reached()) sink().refuse(kPairCacheFull);
  }

  Collide collide_;
  bool all_narrow_ = true;
  std::optional<World> world_;
};

}  // namespace

std::unique_ptr<PairFinder> make_bullet_dbvt_broadphase() {
  return std::make_unique<DbvtBroadphase>(Collide::immediately);
}

std::unique_ptr<PairFinder> make_bullet_dbvt_broadphase_deferred() {
  return std::make_unique<DbvtBroadphase>(Collide::deferred);
}

}  // namespace octocell::baselines
