// SPDX-License-Identifier: MIT
// FCL's IntervalTreeCollisionManager. It finds all pairs by a sweep over its sorted end points with
// a std::set of open boxes. The trees that it also builds serve other queries.
#include <fcl/broadphase/broadphase_interval_tree.h>

#include <cstdint>
#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_finder.hpp"
#include "baselines/fcl/sweep.hpp"

namespace octocell::baselines {
namespace {

class IntervalTree final : public FclFinder<fcl::IntervalTreeCollisionManagerd> {
  // FCL computes an extent as first minus last, so it takes the shortest side for the longest.
  std::uint64_t pairs_ahead() override { return sweep_pairs(spheres(), SweepAlong::shortest); }
};

}  // namespace

std::unique_ptr<PairFinder> make_fcl_interval_tree() { return std::make_unique<IntervalTree>(); }

}  // namespace octocell::baselines
