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
  const std::uint64_t count = w.scene.spheres.size();
  is_used_ =
      plan.moving && plan.method == Method::half_shell && !plan.count_only && !plan.nothing_to_find;
  mode_ = FrameMode::everything;
  forget();
  if (!is_used_) return;
  sample_.reset(w.scene);
  kept_.allocate(count);
  movers_.allocate(w);
  changed_.allocate(movers_.most());
  near_.allocate(w);
  skin_.reset(plan.skin.growth, {}, plan.skin.static_share);
}

bool Coherence::nothing_changed(Workspace& w) {
  mode_ = FrameMode::everything;
  motion_.reset();
  changes_are_listed_ = false;
  if (!is_used_ || !is_planned(w)) return false;
  motion_ = sample_.observe(w.scene);
  list_changed(w);
  if (!changes_are_listed_ || changed_.size() != 0 || !w.plan.allowed.has(Skip::unchanged)) {
    return false;
  }
  mode_ = FrameMode::nothing;
  w.candidates = 0;
  w.uncertain_pairs.clear();
  return true;
}

bool Coherence::list_is_valid(Workspace& w) {
  if (!is_used_ || !is_planned(w) || !near_.imply_facts()) return false;
  w.forget_last_run();
  return reuse_list(w);
}

void Coherence::choose_mode(Workspace& w) {
  if (!is_used_) return;
  if (w.violation || !is_planned(w)) return forget();
  if (repair(w) || reuse_list(w)) return;
  copy_anew(w);
  if (make_list(w)) return;
  movers_.start_anew();
}

Workspace& Coherence::ordered_now(Workspace& w) {
  if (mode_ == FrameMode::movers) return movers_.workspace();
  if (mode_ == FrameMode::new_list) return near_.workspace();
  return w;
}

void Coherence::pair_tests(Workspace& w) {
  if (mode_ == FrameMode::movers) return movers_.find_pairs(w);
  if (mode_ == FrameMode::new_list) return search_with_skin(w);
  if (mode_ == FrameMode::neighbor_list) return near_.decide(w);
  cpu::pair_tests(w);
}

void Coherence::remember(const Workspace& w) {
  if (is_used_ && !has_all_pairs(w)) forget();
}

bool Coherence::runs(Stage stage) const {
  if (mode_ == FrameMode::nothing) return stage == Stage::bounds;
  const bool puts_in_order = stage >= Stage::cell_ids && stage <= Stage::cell_index;
  return mode_ != FrameMode::neighbor_list || !puts_in_order;
}

std::optional<Skip> Coherence::reused() const {
  switch (mode_) {
    case FrameMode::everything:
    case FrameMode::new_list:
      break;
    case FrameMode::nothing:
      return Skip::unchanged;
    case FrameMode::movers:
      return Skip::few_movers;
    case FrameMode::neighbor_list:
      return Skip::skin;
  }
  return std::nullopt;
}

void Coherence::forget() {
  kept_.forget();
  movers_.forget();
  near_.forget();
}

/// Returns true if a snapshot of this frame may save the next one work.
bool Coherence::copy_pays(const Workspace& w) const {
  return repairs_pay(w) || (w.plan.allowed.has(Skip::unchanged) && none_moves());
}

/// Returns true if no sphere of the sample moved; the first frame, without a sample, counts as
/// such.
bool Coherence::none_moves() const { return !motion_ || motion_->still_share == 1.0F; }

bool Coherence::repairs_pay(const Workspace& w) const {
  if (!w.plan.allowed.has(Skip::few_movers)) return false;
  if (!motion_ || motion_->still_share >= kNearlyAllStill) return true;
  return motion_->still_share >= kMostlyStill && !(has_skin(w) && skin_.pays_for(*motion_));
}

/// Lists the spheres that differ from the snapshot, if there is one and this looks worthwhile.
/// Stops when there are more than can be of use.
void Coherence::list_changed(const Workspace& w) {
  const bool may_repair = movers_.others_stand() && repairs_pay(w);
  const bool is_of_use = may_repair || (w.plan.allowed.has(Skip::unchanged) && none_moves());
  if (!is_of_use || !kept_.is_kept()) return;
  const std::uint64_t most = may_repair ? movers_.most() : 0;
  kept_.list_changed(w.scene, *w.threads, most, changed_);
  changes_are_listed_ = changed_.size() <= most;
}

/// Returns false if no earlier pairs can be reused, or too few.
bool Coherence::repair(Workspace& w) {
  const bool may_repair = movers_.others_stand() && repairs_pay(w);
  if (!may_repair || !changes_are_listed_ || !movers_.add(changed_.items())) return false;
  mode_ = FrameMode::movers;
  kept_.keep(w.scene, changed_.items());
  movers_.gather(w);
  return true;
}

bool Coherence::has_skin(const Workspace& w) {
  return w.plan.allowed.has(Skip::skin) && w.plan.skin.growth > 0.0F;
}

bool Coherence::reuse_list(Workspace& w) {
  if (!near_.are_known() || repairs_pay(w)) return false;
  if (!near_.still_hold(w)) {
    near_.forget();
    skin_.left();
    return false;
  }
  copy_anew(w);
  mode_ = FrameMode::neighbor_list;
  skin_.served();
  return true;
}

/// Starts without movers from here on, with a snapshot of this frame if one may be of use.
void Coherence::copy_anew(const Workspace& w) {
  kept_.forget();
  movers_.forget();
  if (copy_pays(w)) kept_.keep(w.scene, *w.threads);
}

bool Coherence::make_list(Workspace& w) {
  if (!has_skin(w) || !motion_ || repairs_pay(w)) return false;
  const std::optional<float> half_skin = skin_.half_skin_for(*motion_);
  if (!half_skin) return false;
  mode_ = FrameMode::new_list;
  near_.grow(w, *half_skin);
  skin_.made(*half_skin, *motion_);
  return true;
}

/// Searches with a skin; if the list overflows, searches every sphere.
void Coherence::search_with_skin(Workspace& w) {
  if (near_.find(w)) return;
  skin_.left();
  w.candidates = 0;
  cpu::cell_ids(w);
  cpu::sort(w);
  cpu::cell_index(w);
  cpu::pair_tests(w);
}

}  // namespace octocell::cpu::coherence
