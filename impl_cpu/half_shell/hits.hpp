// SPDX-License-Identifier: MIT
#pragma once

#include "impl_cpu/half_shell/lanes.hpp"
#include "impl_cpu/half_shell/ordered_spheres.hpp"
#include "impl_cpu/half_shell/row_cursor.hpp"
#include "impl_cpu/pair_sink.hpp"

namespace octocell::cpu::half_shell {

static_assert(OrderedSpheres::kMargin >= kLanes);

/// Eight neighbours and a sphere that may overlap some of them, noted down as they are found and
/// decided many at a time: a hit comes every few rounds, when no predictor expects it, so the loop
/// that looks for hits has no branch on them.
template <Band band>
class Hits {
 public:
  explicit Hits(Workspace& w) : o_(w.ordered), sink_(w) {}
  Hits(const Hits&) = delete;
  Hits& operator=(const Hits&) = delete;
  ~Hits() { decide(); }

  /// The spheres of the run against all lanes, which begin at sphere `begin`.
  void find(std::uint32_t begin, const Lanes& lanes, Run run) {
    while (!run.empty()) {
      const Run some = {run.begin, std::min(run.end, run.begin + kMostAtOnce)};
      look_through(begin, lanes, some, [](std::uint32_t) { return LaneBits{0xff}; });
      run.begin = some.end;
    }
  }

  /// The spheres of the run, which are those of the lanes, against the lanes before them.
  void find_behind(std::uint32_t begin, const Lanes& lanes, Run run) {
    look_through(begin, lanes, run, [begin](std::uint32_t j) { return first_bits(j - begin); });
  }

  void add(std::uint32_t begin, const LaneMask& found, std::uint32_t sphere) {
    const LaneBits bits = bits_of(found);
    hits_[count_] = {begin, sphere, bits};
    count_ += bits != 0 ? 1 : 0;
    if (count_ == kRoom) decide();
  }

 private:
  static constexpr std::uint32_t kMostAtOnce = 256;
  static constexpr std::uint32_t kRoom = 1024;
  struct Hit {
    std::uint32_t begin;
    std::uint32_t sphere;
    std::uint32_t lanes;
  };

  template <typename Which>
  void look_through(std::uint32_t begin, const Lanes& lanes, Run run, const Which& which) {
    if (count_ + kMostAtOnce > kRoom) decide();
    const float* const x = o_.x.data();
    const float* const y = o_.y.data();
    const float* const z = o_.z.data();
    const float* const r = o_.r.data();
    Hit* next = hits_ + count_;
    for (std::uint32_t j = run.begin; j < run.end; ++j) {
      const std::uint32_t bits = bits_of(lanes.may_overlap(x[j], y[j], z[j], r[j])) & which(j);
      *next = {begin, j, bits};
      next += bits != 0 ? 1 : 0;
    }
    count_ = static_cast<std::uint32_t>(next - hits_);
  }

  void decide() {
    for (std::uint32_t k = 0; k < count_; ++k) {
      const Hit hit = hits_[k];
      const Sphere other = o_.at(hit.sphere);
      const std::uint32_t other_id = o_.sphere[hit.sphere];
      for_each_lane(hit.lanes, [&](std::uint32_t lane) {
        const std::uint32_t i = hit.begin + lane;
        sink_.take<band>(o_.at(i), o_.sphere[i], other, other_id);
      });
    }
    count_ = 0;
  }

  const OrderedSpheres& o_;
  PairSink sink_;
  std::uint32_t count_ = 0;
  Hit hits_[kRoom];
};

}  // namespace octocell::cpu::half_shell
