// SPDX-License-Identifier: MIT
#include "impl_cpu/coherence/coherence.hpp"

#include <cstdint>
#include <optional>

namespace octocell::cpu::coherence {
namespace {

/// If a smaller share of spheres than this stand still, it is not worthwhile to search only the
/// others.
constexpr float kMostlyStill = 0.75F;
/// If more than this stand still, searching the others is cheaper than a neighbor list, which reads
/// all spheres.
constexpr float kNearlyAllStill = 0.97F;

bool has_all_pairs(const Workspace& w) {
  return w.may_test_pairs() && w.pairs.size() <= w.plan.capacity.pairs &&
         w.uncertain_pairs.size() <= w.plan.capacity.uncertain_pairs;
}

/// Returns false in a frame whose number of spheres is not the plan's.
bool is_planned(const Workspace& w) { return w.scene.spheres.size() == w.plan.facts.sphere_count; }

}  // namespace

void Coherence::reset(const Workspace& w) {
  const Plan& plan = w.plan;
  is_used_ =
      plan.moving && plan.method == Method::half_shell && !plan.count_only && !plan.nothing_to_find;
  mode_ = FrameMode::search;
  makes_list_ = false;
  forget();
  if (!is_used_) return;
  sample_.reset(w.scene);
  snapshot_.allocate(w.scene.spheres.size());
  movers_.allocate(w);
  changed_.allocate(movers_.most());
  list_.allocate(w);
  skin_.reset(plan.skin.growth, {}, plan.skin.static_share);
}

void Coherence::forget() {
  snapshot_.forget();
  movers_.forget();
  list_.forget();
}

void Coherence::bounds(Workspace& w) {
  mode_ = FrameMode::search;
  makes_list_ = false;
  if (!is_used_) return cpu::bounds(w);
  if (!is_planned(w)) {
    cpu::bounds(w);
    return forget();
  }
  motion_ = sample_.observe(w.scene);
  list_changes(w);
  if (is_unchanged(w)) return;
  if (list_.implies_facts() && reuse_list(w)) return;
  cpu::bounds(w);
  if (w.violation) return forget();
  if (search_movers(w) || reuse_list(w)) return;
  start_again(w);
  if (!make_list(w)) movers_.start();
}

Workspace& Coherence::ordered_now(Workspace& w) {
  if (mode_ == FrameMode::few_movers) return movers_.workspace();
  return makes_list_ ? list_.workspace() : w;
}

bool Coherence::pair_tests(Workspace& w) {
  if (makes_list_) {
    makes_list_ = list_.find(w);
    if (makes_list_) return true;
    skin_.left();
    w.candidates = 0;
    return false;
  }
  if (mode_ == FrameMode::few_movers) {
    movers_.find_pairs(w);
  } else if (mode_ == FrameMode::neighbor_list) {
    list_.decide(w);
  } else {
    cpu::pair_tests(w);
  }
  return true;
}

void Coherence::resolve(Workspace& w) {
  cpu::resolve(w);
  if (is_used_ && !has_all_pairs(w)) forget();
}

/// Returns true if no sphere of the sample moved; the first frame, without a sample, counts as
/// such.
bool Coherence::none_moves() const { return !motion_ || motion_->still_share == 1.0F; }

/// Returns true if a snapshot of this frame may save the next one work.
bool Coherence::snapshot_pays(const Workspace& w) const {
  return few_movers_pay(w) || (w.plan.allowed.has(Skip::unchanged) && none_moves());
}

bool Coherence::few_movers_pay(const Workspace& w) const {
  if (!w.plan.allowed.has(Skip::few_movers)) return false;
  if (!motion_ || motion_->still_share >= kNearlyAllStill) return true;
  return motion_->still_share >= kMostlyStill && !(has_skin(w) && skin_.pays_for(*motion_));
}

/// Lists the spheres that differ from the snapshot, if there is one and this looks worthwhile.
/// Stops when there are more than can be of use.
void Coherence::list_changes(const Workspace& w) {
  changes_are_listed_ = false;
  const bool for_movers = movers_.others_stand() && few_movers_pay(w);
  const bool is_of_use = for_movers || (w.plan.allowed.has(Skip::unchanged) && none_moves());
  if (!is_of_use || !snapshot_.is_valid()) return;
  const std::uint64_t most = for_movers ? movers_.most() : 0;
  snapshot_.list_changed(w.scene, *w.threads, most, changed_);
  changes_are_listed_ = changed_.size() <= most;
}

/// Returns true if no sphere changed since the pairs in w were found.
bool Coherence::is_unchanged(Workspace& w) {
  if (!w.plan.allowed.has(Skip::unchanged)) return false;
  if (!changes_are_listed_ || changed_.size() != 0) return false;
  mode_ = FrameMode::unchanged;
  w.candidates = 0;
  w.uncertain_pairs.clear();
  return true;
}

/// Returns false if no earlier pairs can be reused, or too few.
bool Coherence::search_movers(Workspace& w) {
  const bool may_search = movers_.others_stand() && few_movers_pay(w);
  if (!may_search || !changes_are_listed_ || !movers_.add(changed_.items())) return false;
  mode_ = FrameMode::few_movers;
  snapshot_.update(w.scene, changed_.items());
  movers_.gather(w);
  return true;
}

bool Coherence::has_skin(const Workspace& w) {
  return w.plan.allowed.has(Skip::skin) && w.plan.skin.growth > 0.0F;
}

/// Returns true if the neighbor list is still valid. The plan's facts then hold, because no sphere
/// has moved far.
bool Coherence::reuse_list(Workspace& w) {
  if (!list_.is_valid() || few_movers_pay(w)) return false;
  if (!list_.is_valid_for(w)) {
    list_.forget();
    skin_.left();
    return false;
  }
  w.forget_last_run();
  start_again(w);
  mode_ = FrameMode::neighbor_list;
  skin_.served();
  return true;
}

/// Starts without movers from here on, with a snapshot of this frame if one may be of use.
void Coherence::start_again(const Workspace& w) {
  snapshot_.forget();
  movers_.forget();
  if (snapshot_pays(w)) snapshot_.take(w.scene, *w.threads);
}

/// Makes this frame a search of enlarged spheres, if a neighbor list pays.
bool Coherence::make_list(Workspace& w) {
  if (!has_skin(w) || !motion_ || few_movers_pay(w)) return false;
  const std::optional<float> half_skin = skin_.half_skin_for(*motion_);
  if (!half_skin) return false;
  makes_list_ = true;
  list_.grow(w, *half_skin);
  skin_.made(*half_skin, *motion_);
  return true;
}

}  // namespace octocell::cpu::coherence
