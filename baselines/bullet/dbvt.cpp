// SPDX-License-Identifier: MIT
// Bullet's btDbvt, the bare tree: no proxies, no margin, no pair cache.
#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "baselines/baseline_finder.hpp"
#include "baselines/baselines.hpp"
#include "baselines/bullet/branch_limit.hpp"
#include "baselines/bullet/bullet_box.hpp"

namespace octocell::baselines {
namespace {

/// Leaves store the sphere's id where Bullet has room for a pointer.
void* leaf_data(std::size_t id) { return reinterpret_cast<void*>(id); }
std::uint32_t id_of(const btDbvtNode* leaf) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::size_t>(leaf->data));
}

/// Thrown out of a traversal, which cannot end early in another way. It passes only through inline
/// code of btDbvt.h, and never leaves query().
struct CandidateLimitReached {};

struct LeafPairs final : btDbvt::ICollide {
  explicit LeafPairs(CandidateSink& s) : sink(s) {}
  using btDbvt::ICollide::Process;
  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    if (!sink.test(id_of(a), id_of(b))) throw CandidateLimitReached{};
  }
  CandidateSink& sink;
};

class Dbvt final : public BaselineFinder {
  void tear_down() override { tree_.clear(); }

  void make_objects() override { leaves_.assign(spheres().size(), nullptr); }

  void build() override {
    for (std::size_t i = 0; i < spheres().size(); ++i) {
      leaves_[i] = tree_.insert(bullet_box(spheres()[i]).volume(), leaf_data(i));
      if (branch_too_long(leaves_[i], i)) return sink().refuse(kBranchTooLong);
    }
  }

  // A leaf that moved a little finds its new place near the old one; a search from the root takes
  // longer. A leaf that jumped would enlarge the boxes there, so it starts at the root (m_lkhd <
  // 0).
  void follow() override {
    for (std::size_t i = 0; i < spheres().size(); ++i) {
      btDbvtVolume box = bullet_box(spheres()[i]).volume();
      tree_.m_lkhd = Intersect(leaves_[i]->volume, box) ? 1 : -1;
      tree_.update(leaves_[i], box);
      if (branch_too_long(leaves_[i], i)) return sink().refuse(kBranchTooLong);
    }
  }

  void query() override {
    LeafPairs pairs(sink());
    try {
      tree_.collideTTpersistentStack(tree_.m_root, tree_.m_root, pairs);
    } catch (const CandidateLimitReached&) {
      return;
    }
  }

  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;  // [sphere] owned by tree_
};

}  // namespace

std::unique_ptr<PairFinder> make_bullet_dbvt() { return std::make_unique<Dbvt>(); }

}  // namespace octocell::baselines
