// SPDX-License-Identifier: MIT
// Where all baselines put their candidates: all use the same exact test and the same pair buffer,
// so rows differ only by their broad phase.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/buffer.hpp"
#include "core/finder.hpp"
#include "core/flags.hpp"
#include "core/overlap.hpp"

namespace octocell::baselines {

class CandidateSink {
 public:
  /// Reserves room for plan.capacity.pairs pairs, or for none in a count_only plan. Untimed.
  void prepare(const Plan& plan) {
    candidate_limit_ = plan.candidate_limit;
    room_size_ = plan.count_only ? 0 : plan.capacity.pairs;
    room_.allocate(room_size_);
    begin({});
  }

  /// Forgets what was found; from now on candidates are ids into `scene`. Untimed.
  void begin(SceneView scene) {
    spheres_ = scene.spheres.data();
    flags_ = scene.flags.empty() ? nullptr : scene.flags.data();
    counts_ = {};
    checksum_beyond_room_ = 0;
  }

  /// Returns false if the plan allows fewer comparisons; the caller must then not start. For a
  /// library that is going to compare this many pairs in any case.
  bool allows(std::uint64_t pairs_ahead) {
    if (pairs_ahead <= candidate_limit_) return true;
    counts_.candidates = pairs_ahead;
    counts_.over_candidate_limit = true;
    return false;
  }

  /// Tests one candidate, a != b, in any order. Returns false if there were more candidates than
  /// the plan allows; the caller must then stop.
  bool test(std::uint32_t a, std::uint32_t b) {
    if (++counts_.candidates > candidate_limit_) {
      counts_.over_candidate_limit = true;
      return false;
    }
    // Flags are checked here, where an engine would call its user's filter.
    if (flags_ != nullptr && !may_collide(flags_[a], flags_[b])) return true;
    if (overlap(spheres_[a], spheres_[b])) keep(make_pair_of(a, b));
    return true;
  }

  /// Notes in one line why the library cannot hold the scene.
  void refuse(std::string reason) { counts_.plan_violation = std::move(reason); }

  [[nodiscard]] std::uint64_t candidate_limit() const { return candidate_limit_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// Sorts the pairs in place. Untimed.
  std::span<const Pair> sort_pairs() {
    std::sort(room_.data(), room_.data() + stored().size());
    return stored();
  }

  /// Returns the digest of all pairs found, whether there was room for them or not.
  [[nodiscard]] PairDigest digest() const {
    PairDigest digest = digest_of(stored());
    digest.merge({counts_.pairs - digest.count, checksum_beyond_room_});
    return digest;
  }

 private:
  // The safe filter is right for every scene, and with a few candidates per sphere it costs hardly
  // more. For the same reason radii are enlarged here and not in a copy of the scene.
  bool overlap(const Sphere& a, const Sphere& b) {
    const Verdict verdict = filter_verdict<Filter::safe>(a, b);
    return verdict == Verdict::uncertain ? overlap_exact(a, b) : verdict == Verdict::overlap;
  }

  void keep(Pair pair) {
    const std::uint64_t place = counts_.pairs++;
    if (place < room_size_) {
      room_[place] = pair;
      return;
    }
    checksum_beyond_room_ += mix_pair(pair);
  }

  [[nodiscard]] std::span<const Pair> stored() const {
    return {room_.data(), std::min(counts_.pairs, room_size_)};
  }

  const Sphere* spheres_ = nullptr;
  const Flags* flags_ = nullptr;  // null: every pair may collide
  std::uint64_t candidate_limit_ = 0;
  Counts counts_;
  Buffer<Pair> room_;  // [room_size_]; the first counts_.pairs are in use
  std::uint64_t room_size_ = 0;
  std::uint64_t checksum_beyond_room_ = 0;
};

}  // namespace octocell::baselines
