// SPDX-License-Identifier: MIT
#include "impl_cpu/coherence/movers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/half_shell.hpp"

namespace octocell::cpu::coherence {
namespace {

/// One sphere in six: with more movers, working on them takes as long as working on all
/// (docs/decisions/0016).
constexpr std::uint64_t kOneIn = 6;
constexpr std::uint64_t kAlwaysAllowed = block_size(16, 4);
constexpr std::uint64_t kPairsPerBlock = block_size(1 << 15, 16);
constexpr std::uint64_t kSpheresPerBlock = block_size(1 << 14, 16);

}  // namespace

void Movers::allocate(const Workspace& whole) {
  const std::uint64_t count = whole.scene.spheres.size();
  most_ = std::min(count, std::max(count / kOneIn, kAlwaysAllowed));
  movers_.allocate(most_);
  now_.allocate(most_);
  is_mover_.assign(count / 64 + 1, 0);
  standing_.resize(whole.plan.capacity.pairs / kPairsPerBlock + 1);
  moved_.plan = whole.plan;
  moved_.plan.capacity = {.ids = most_};
  moved_.scene.spheres = {now_.data(), most_};
  moved_.threads = whole.threads;
  moved_.allocate();
  count_ = taken_out_ = 0;
  others_stand_ = false;
}

void Movers::start() {
  for (std::uint64_t k = 0; k < count_; ++k) is_mover_[movers_[k] / 64] = 0;
  count_ = taken_out_ = 0;
  others_stand_ = true;
}

bool Movers::add(std::span<const std::uint32_t> changed) {
  for (const std::uint32_t sphere : changed) {
    if (has(sphere)) continue;
    if (count_ == most_) return false;
    is_mover_[sphere / 64] |= std::uint64_t{1} << sphere % 64;
    movers_[count_++] = sphere;
  }
  return true;
}

void Movers::gather(const Workspace& whole) {
  constexpr std::uint64_t kPrefetchAhead = 128;
  const Sphere* const spheres = whole.scene.spheres.data();
  for (std::uint64_t k = 0; k < count_; ++k) {
    __builtin_prefetch(&spheres[movers_[std::min(k + kPrefetchAhead, count_ - 1)]]);
    now_[k] = spheres[movers_[k]];
  }
  moved_.scene.spheres = {now_.data(), count_};
}

void Movers::find_pairs(Workspace& whole) {
  whole.uncertain_pairs.clear();
  drop_pairs(whole);
  if (count_ == 0) return;
  take_out_of_order(whole);
  name_by_id();
  whole.candidates = half_shell::test_between(whole, whole.ordered, moved_.ordered) +
                     half_shell::test_among(whole, moved_.ordered);
}

/// Removes the pairs of movers: closes the gaps within each block, then between the blocks.
void Movers::drop_pairs(Workspace& whole) {
  const std::span<Pair> pairs = whole.pairs.stored();
  const auto per_block = [&](std::uint64_t begin, std::uint64_t end) {
    std::uint64_t stands = begin;
    for (std::uint64_t k = begin; k < end; ++k) {
      const Pair pair = pairs[k];
      pairs[stands] = pair;
      stands +=
          (has(pair.i) | has(pair.j)) ? 0 : 1;  // no branch, because it could not be predicted
    }
    standing_[begin / kPairsPerBlock] = stands - begin;
  };
  whole.threads->for_blocks(pairs.size(), kPairsPerBlock, per_block);
  std::uint64_t stand = 0;
  for (std::uint64_t begin = 0; begin < pairs.size(); begin += kPairsPerBlock) {
    const auto first = pairs.begin() + static_cast<std::ptrdiff_t>(begin);
    const std::uint64_t some = standing_[begin / kPairsPerBlock];
    std::copy_n(first, some, pairs.begin() + static_cast<std::ptrdiff_t>(stand));
    stand += some;
  }
  whole.pairs.cut(stand);
}

/// Takes movers out of the old order: a sphere whose x is not a number overlaps nothing.
void Movers::take_out_of_order(Workspace& whole) {
  if (taken_out_ == count_) return;
  OrderedSpheres& o = whole.ordered;
  whole.threads->for_blocks(whole.scene.spheres.size(), kSpheresPerBlock,
                            [&](std::uint64_t begin, std::uint64_t end) {
                              for (std::uint64_t k = begin; k < end; ++k) {
                                if (has(o.sphere[k]))
                                  o.x[k] = std::numeric_limits<float>::quiet_NaN();
                              }
                            });
  taken_out_ = count_;
}

/// Stages 2 to 4 number the movers from 0; this replaces those numbers by sphere ids.
void Movers::name_by_id() {
  Object* const names = moved_.ids[moved_.current].objects.data();
  for (std::uint64_t k = 0; k < count_; ++k) names[k] = movers_[names[k]];
}

}  // namespace octocell::cpu::coherence
