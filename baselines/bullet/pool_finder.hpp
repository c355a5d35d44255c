// SPDX-License-Identifier: MIT
// Drives Bullet's older broad phases: proxies from a pool of fixed size, pairs in a cache.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "baselines/all_pairs.hpp"
#include "baselines/baseline_finder.hpp"
#include "baselines/bullet/bullet_box.hpp"
#include "baselines/bullet/client.hpp"
#include "baselines/bullet/pair_limit.hpp"

namespace octocell::baselines {

template <class Broadphase>
class PoolFinder : public BaselineFinder {
 protected:
  /// Untimed. Called before make_broadphase(), which needs the number and the box of the spheres.
  void make_objects() override { proxies_.reserve(spheres().size()); }
  /// Makes an empty broad phase with room for the spheres. Timed.
  virtual std::unique_ptr<Broadphase> make_broadphase() = 0;

  // Each insertion goes past the ends of all boxes before it; the pool cannot be built in bulk.
  std::uint64_t pairs_ahead() override { return all_pairs(spheres().size()); }

 private:
  // The pool is freed with the broad phase: destroyProxy() would search the cache for every proxy.
  void tear_down() final {
    proxies_.clear();
    limit_.reset();
    broadphase_.reset();
  }

  void build() final {
    broadphase_ = make_broadphase();
    limit_.emplace(*broadphase_->getOverlappingPairCache(), PairLimit::OnReached::refuse_pairs);
    limit_->set(kMaxCachedPairs);
    broadphase_->getOverlappingPairCache()->setOverlapFilterCallback(&*limit_);
    for (const Sphere& s : spheres()) {
      const BulletBox box = bullet_box(s);
      proxies_.push_back(broadphase_->createProxy(box.lowest, box.highest, SPHERE_SHAPE_PROXYTYPE,
                                                  client_of(proxies_.size()), 1, 1, nullptr));
    }
  }

  void follow() final {
    for (std::size_t i = 0; i < proxies_.size(); ++i) {
      const BulletBox box = bullet_box(spheres()[i]);
      broadphase_->setAabb(proxies_[i], box.lowest, box.highest, nullptr);
    }
  }

  void query() final {
    broadphase_->calculateOverlappingPairs(nullptr);
    if (limit_->reached()) return sink().refuse(kPairCacheFull);
    const btBroadphasePairArray& pairs =
        broadphase_->getOverlappingPairCache()->getOverlappingPairArray();
    for (int k = 0; k < pairs.size(); ++k) {
      if (!sink().test(id_of(pairs[k].m_pProxy0), id_of(pairs[k].m_pProxy1))) return;
    }
  }

  std::unique_ptr<Broadphase> broadphase_;
  std::optional<PairLimit> limit_;
  std::vector<btBroadphaseProxy*> proxies_;  // [sphere] owned by the broad phase
};

}  // namespace octocell::baselines
