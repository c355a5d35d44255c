// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "impl_cpu/block_size.hpp"
#include "impl_cpu/half_shell/column_ids.hpp"
#include "impl_cpu/half_shell/ordered_spheres.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"
#include "impl_cpu/pair_sink.hpp"

namespace octocell::cpu::half_shell {

static_assert(OrderedSpheres::kMargin >= kMostLanes && OrderedSpheres::kMargin >= kPassed);

/// Returns the index of the k-th sphere: k itself, or the k-th entry of a list.
struct InOrder {
  std::uint32_t operator()(std::uint64_t k) const { return static_cast<std::uint32_t>(k); }
};
struct Listed {
  const std::uint32_t* spheres;
  std::uint32_t operator()(std::uint64_t k) const { return spheres[k]; }
};

/// Collects hits, each a group of lanes and one sphere that may overlap some of them, and decides
/// many at a time. A hit comes every few rounds, and no branch predictor can foresee it, so the
/// loop that searches for hits does not branch on them.
template <PairTest test, typename InLanes = InOrder>
class Hits {
 public:
  using Neighbours = Lanes<test, kLanes>;

  /// The spheres in lanes and those tested one by one may belong to two structures.
  Hits(Workspace& w, const OrderedSpheres& in_lanes, const OrderedSpheres& one_by_one,
       InLanes which_in_lanes = {})
      : in_lanes_(in_lanes), which_in_lanes_(which_in_lanes), one_by_one_(one_by_one), sink_(w) {}
  Hits(const Hits&) = delete;
  Hits& operator=(const Hits&) = delete;
  ~Hits() { decide(); }

  /// Tests the spheres of the run against the first `size` lanes, which hold the spheres from
  /// `begin` on.
  template <typename Ones = InOrder>
  void find(std::uint32_t begin, std::uint32_t size, const Neighbours& lanes, IndexRange run,
            Ones which = {}) {
    const LaneBits taken = first_bits(size);
    look_through(begin, lanes, run, which, [taken](std::uint64_t) { return taken; });
  }

  /// Tests each sphere of the run against the lanes before it. The run follows the spheres of the
  /// lanes or overlaps them.
  void find_behind(std::uint32_t begin, std::uint32_t size, const Neighbours& lanes,
                   IndexRange run) {
    const LaneBits taken = first_bits(size);
    look_through(begin, lanes, run, InOrder{}, [begin, taken](std::uint64_t j) {
      return static_cast<LaneBits>(first_bits(static_cast<std::uint32_t>(j) - begin) & taken);
    });
  }

  void add(std::uint32_t begin, LaneBits bits, std::uint32_t sphere) {
    spheres_[count_] = std::uint64_t{begin} << 32 | sphere;
    lanes_[count_] = bits;
    count_ += bits != 0 ? 1 : 0;
    if (count_ == kRoom) decide();
  }

  /// Flushes pending hits; call before changing the lists they index.
  void decide() {
    for (std::uint32_t k = 0; k < count_; ++k) {
      const auto sphere = static_cast<std::uint32_t>(spheres_[k]);
      const auto begin = static_cast<std::uint32_t>(spheres_[k] >> 32);
      const Sphere other = one_by_one_.at<test>(sphere);
      const std::uint32_t other_id = one_by_one_.sphere[sphere];
      for_each_lane(lanes_[k], [&](std::uint32_t lane) {
        const std::uint32_t i = which_in_lanes_(begin + lane);
        sink_.take<test>(in_lanes_.at<test>(i), in_lanes_.sphere[i], other, other_id);
      });
    }
    count_ = 0;
  }

 private:
  static constexpr std::uint32_t kMostAtOnce = block_size(256, 8);
  static constexpr std::uint32_t kRoom = block_size(1024, 16);

  template <typename Ones, typename Taken>
  void look_through(std::uint32_t begin, const Neighbours& lanes, IndexRange run, Ones which,
                    const Taken& taken) {
    while (!run.empty()) {
      const IndexRange some = {run.begin, std::min(run.end, run.begin + kMostAtOnce)};
      if (count_ + kMostAtOnce > kRoom) decide();
      count_ = note(lanes, one_by_one_.fields<test>(), std::uint64_t{begin} << 32, some, which,
                    taken, count_);
      run.begin = some.end;
    }
  }

  /// The innermost loop of stage 5. It is a function of its own so that its data stay in registers.
  template <typename Ones, typename Taken>
  [[gnu::noinline]] std::uint32_t note(const Neighbours lanes, const FieldsOf<test> ones,
                                       std::uint64_t begin, IndexRange run, Ones which, Taken taken,
                                       std::uint32_t count) {
    std::uint64_t* const spheres = spheres_;
    LaneBits* const found = lanes_;
    for (std::uint64_t k = run.begin; k < run.end; ++k) {
      const std::uint64_t j = which(k);
      const LaneBits bits = lanes.may_overlap(ones, j) & taken(j);
      spheres[count] = begin | j;
      found[count] = bits;
      count += bits != 0 ? 1 : 0;
    }
    return count;
  }

  const OrderedSpheres& in_lanes_;
  const InLanes which_in_lanes_;
  const OrderedSpheres& one_by_one_;
  PairSink sink_;
  std::uint32_t count_ = 0;
  std::uint64_t spheres_[kRoom];  // the first sphere of the lanes, and the one tested against them
  LaneBits lanes_[kRoom];
};

}  // namespace octocell::cpu::half_shell
