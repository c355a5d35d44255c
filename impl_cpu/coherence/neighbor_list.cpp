// SPDX-License-Identifier: MIT
#include "impl_cpu/coherence/neighbor_list.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "core/flags.hpp"
#include "core/plan_facts.hpp"
#include "core/same_bits.hpp"
#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"
#include "impl_cpu/pair_sink.hpp"

namespace octocell::cpu::coherence {
namespace {

constexpr std::uint64_t kSpheresPerBlock = block_size(1 << 13, 16);
constexpr std::uint64_t kPairsPerBlock = block_size(1 << 12, 8);
constexpr std::uint64_t kPrefetchAhead = 128;
constexpr std::uint64_t kMostPerPair = 2;  // the most neighbor pairs, for each pair that there is
                                           // room for

bool same_radius(const Sphere& a, const Sphere& b) {
  return std::bit_cast<std::uint32_t>(a.r) == std::bit_cast<std::uint32_t>(b.r);
}

/// Without static spheres, the n-th movable sphere has place n.
struct AllPlaces {
  std::uint64_t count;
  [[nodiscard]] std::uint64_t size() const { return count; }
  std::uint64_t operator[](std::uint64_t n) const { return n; }
};

/// Returns true if the plan's facts still hold as long as radii stay the same and no sphere moves
/// further than `step`.
bool steps_keep_facts(const Workspace& w, float step) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  PlanFacts then = w.facts;
  for (int a = 0; a < 3; ++a) {
    then.lowest[a] = std::nextafter(then.lowest[a] - step, -kInfinity);
    then.highest[a] = std::nextafter(then.highest[a] + step, kInfinity);
  }
  return w.plan.facts.lattice_units_per_length == 0.0 && are_within(then, w.plan.facts);
}

}  // namespace

void NeighborList::allocate(const Workspace& whole) {
  const std::uint64_t count = whole.scene.spheres.size();
  const SkinCells& cells = whole.plan.skin;
  is_valid_ = false;
  if (cells.growth == 0.0F) return;
  places_.resize(count);
  std::iota(places_.begin(), places_.end(), 0U);
  for (Buffer<Sphere>* spheres : {&spheres_, &then_, &now_}) spheres->allocate(count);
  grown_.plan = whole.plan;
  grown_.plan.levels = cells.levels;
  grown_.plan.key_bits = cells.key_bits;
  grown_.plan.test =
      PairTest::filter_safe;  // enlarged radii may leave the range that the plan knows
  const std::uint64_t pairs = whole.plan.capacity.pairs;
  grown_.plan.capacity = {.ids = count, .uncertain_pairs = pairs, .pairs = kMostPerPair * pairs};
  grown_.scene.spheres = {spheres_.data(), count};
  grown_.threads = whole.threads;
  grown_.allocate();
}

void NeighborList::grow(const Workspace& whole, float half_skin) {
  const std::span<const Sphere> spheres = whole.scene.spheres;
  const std::span<const Flags> flags = whole.scene.flags;
  is_valid_ = false;
  half_skin_ = half_skin;
  implies_facts_ = steps_keep_facts(whole, half_skin);
  const auto grow_block = [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) {
      const Sphere& s = spheres[i];
      const bool stands = !flags.empty() && is_static(flags[i]);
      spheres_[i] = {s.x, s.y, s.z, stands ? s.r : grown_radius(s.r, half_skin)};
    }
  };
  whole.threads->for_blocks(spheres.size(), kSpheresPerBlock, grow_block);
  grown_.scene.spheres = {spheres_.data(), spheres.size()};
  grown_.candidates = 0;
}

bool NeighborList::find(Workspace& whole) {
  grown_.ordered.sphere = places_.data();
  put_flags_in_order(whole.scene.flags);
  cpu::pair_tests(grown_);
  const bool complete = grown_.pairs.complete() && grown_.uncertain_pairs.complete();
  is_valid_ = complete && grown_.candidates + size() <= whole.plan.candidate_limit;
  if (!is_valid_) return false;
  fetch_then(whole);
  decide(whole);
  whole.candidates += grown_.candidates;
  return true;
}

/// Pairs that may not collide would only cost time in every frame.
void NeighborList::put_flags_in_order(std::span<const Flags> flags) {
  flags_.resize(flags.size());
  for (std::size_t k = 0; k < flags.size(); ++k) flags_[k] = flags[order()[k]];
  grown_.scene.flags = flags_;
  movable_ = movable_among(flags_);
  movable_ids_.clear();
  for (const std::uint32_t k : movable_) movable_ids_.push_back(order()[k]);
}

void NeighborList::fetch_then(const Workspace& whole) {
  const Sphere* const spheres = whole.scene.spheres.data();
  const std::uint64_t last = whole.scene.spheres.size() - 1;
  whole.threads->for_blocks(
      last + 1, kSpheresPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
        for (std::uint64_t k = begin; k < end; ++k) {
          __builtin_prefetch(&spheres[order()[std::min(k + kPrefetchAhead, last)]]);
          now_[k] = spheres[order()[k]];
          if (flags_.empty()) then_[k] = now_[k];
        }
      });
  for (std::size_t n = 0; n < movable_.size(); ++n) then_[n] = now_[movable_[n]];
}

/// Calls the exact predicate: is the point within the ball of half the skin?
bool NeighborList::is_within_skin(const Sphere& then, const Sphere& now) const {
  return same_radius(then, now) && std::isfinite(now.x + now.y + now.z) &&
         overlap_exact({then.x, then.y, then.z, half_skin_}, {now.x, now.y, now.z, 0.0F});
}

/// Fetches spheres [begin, end) and proves that each is within the skin. Float32 is certain for
/// nearly all; the others are tested one by one. `places[n]` is the place, in column order, of the
/// n-th movable sphere.
template <typename Places>
bool NeighborList::fetch(const Workspace& whole, const Places& places, std::uint64_t begin,
                         std::uint64_t end) {
  const Sphere* const spheres = whole.scene.spheres.data();
  const Object* const ids = some_are_static() ? movable_ids_.data() : order();
  const std::uint64_t last = places.size() - 1;
  const float ball = filter_radius<Filter::safe>(half_skin_);
  const float point = filter_radius<Filter::safe>(0.0F);
  bool sure = true;
  for (std::uint64_t n = begin; n < end; ++n) {
    const std::uint64_t ahead = std::min(n + kPrefetchAhead, last);
    __builtin_prefetch(&spheres[ids[ahead]]);
    __builtin_prefetch(&now_[places[ahead]], 1);
    const Sphere s = spheres[ids[n]];
    const Sphere& t = then_[n];
    now_[places[n]] = s;
    sure &= same_radius(s, t);
    sure &= filter_is_sure<Filter::safe>({t.x, t.y, t.z, ball}, {s.x, s.y, s.z, point});
  }
  for (std::uint64_t n = begin; !sure && n < end; ++n) {
    if (!is_within_skin(then_[n], now_[places[n]])) return false;
  }
  return true;
}

bool NeighborList::is_valid_for(const Workspace& whole) {
  if (!some_are_static()) return movable_are_near(whole, AllPlaces{whole.scene.spheres.size()});
  return statics_stand(whole) && movable_are_near(whole, std::span(movable_));
}

/// Compares static spheres in the scene's own order, which needs no gather.
bool NeighborList::statics_stand(const Workspace& whole) const {
  const Sphere* const spheres = whole.scene.spheres.data();
  const Flags* const flags = whole.scene.flags.data();
  const auto stand = [&](std::uint64_t begin, std::uint64_t end) {
    bool all = true;
    for (std::uint64_t i = begin; i < end; ++i) {
      all &= !is_static(flags[i]) | same_bits(spheres[i], spheres_[i]);
    }
    return all;
  };
  return whole.threads->for_all_blocks(whole.scene.spheres.size(), kSpheresPerBlock, stand);
}

template <typename Places>
bool NeighborList::movable_are_near(const Workspace& whole, const Places& places) {
  return whole.threads->for_all_blocks(
      places.size(), kSpheresPerBlock,
      [&](std::uint64_t begin, std::uint64_t end) { return fetch(whole, places, begin, end); });
}

/// Whether a neighbor pair overlaps cannot be predicted, so candidates are collected without a
/// branch.
template <PairTest test>
void NeighborList::decide_block(Workspace& whole, std::span<const Pair> near) const {
  std::array<std::uint32_t, kPairsPerBlock> picked;
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < near.size(); ++k) {
    const Pair ahead = near[std::min<std::size_t>(k + kPrefetchAhead, near.size() - 1)];
    __builtin_prefetch(&now_[ahead.i]);
    __builtin_prefetch(&now_[ahead.j]);
    const Sphere a = stored<test>(now_[near[k].i]);
    const Sphere b = stored<test>(now_[near[k].j]);
    picked[count] = k;
    count += may_overlap<test>(a, b) ? 1 : 0;
  }
  PairSink sink(whole, {});
  for (std::size_t n = 0; n < count; ++n) {
    const Pair pair = near[picked[n]];
    sink.take<test>(stored<test>(now_[pair.i]), order()[pair.i], stored<test>(now_[pair.j]),
                    order()[pair.j]);
  }
}

template <PairTest test>
void NeighborList::decide_all(Workspace& whole) const {
  const std::span<const Pair> lists[] = {grown_.pairs.items(), grown_.uncertain_pairs.items()};
  for (const std::span<const Pair> near : lists) {
    whole.threads->for_blocks(near.size(), kPairsPerBlock,
                              [&](std::uint64_t begin, std::uint64_t end) {
                                decide_block<test>(whole, near.subspan(begin, end - begin));
                              });
  }
}

void NeighborList::decide(Workspace& whole) const {
  whole.pairs.clear(false);
  whole.uncertain_pairs.clear();
  whole.candidates = size();
  with_filter_test(whole.plan.test, [&]<PairTest test>() { decide_all<test>(whole); });
}

}  // namespace octocell::cpu::coherence
