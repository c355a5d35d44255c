// SPDX-License-Identifier: MIT
// Bullet's pair cache grows without a limit; this filter, which it calls for each pair, sets one.
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <algorithm>
#include <cstdint>

namespace octocell::baselines {

/// The most entries in a btHashedOverlappingPairCache; with one more, its capacity, an int, would
/// be doubled to 2^31.
inline constexpr std::uint64_t kMaxCachedPairs = std::uint64_t{1} << 30;
inline constexpr const char* kPairCacheFull =
    "btHashedOverlappingPairCache cannot hold more than 2^30 pairs";

class PairLimit final : public btOverlapFilterCallback {
 public:
  struct Reached {};
  enum class OnReached : bool { refuse_pairs, leave };

  /// With `leave`, throws Reached: Bullet's deferred pass tests all pairs in one call.
  PairLimit(const btOverlappingPairCache& cache, OnReached on_reached)
      : cache_(cache), on_reached_(on_reached) {}

  /// Sets the limit. The cache may hold one pair more, which shows that the limit was exceeded.
  void set(std::uint64_t limit) {
    limit_ = static_cast<int>(std::min<std::uint64_t>(limit, kMaxCachedPairs - 1));
  }
  [[nodiscard]] bool reached() const { return cache_.getNumOverlappingPairs() > limit_; }

  // All proxies have the same group and mask, so there is nothing else to filter. Pairs that are
  // already in the cache come here, too.
  bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override {
    if (!reached()) return true;
    if (on_reached_ == OnReached::leave) throw Reached{};
    return false;
  }

 private:
  const btOverlappingPairCache& cache_;
  OnReached on_reached_;
  int limit_ = 0;
};

}  // namespace octocell::baselines
