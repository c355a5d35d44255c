// SPDX-License-Identifier: MIT
// FCL's IntervalTreeCollisionManager. All pairs at once come from a sweep over its sorted end
// points with a std::set of open boxes; the trees that it builds beside them serve other queries.
#include <fcl/broadphase/broadphase_interval_tree.h>

#include <cstdint>
#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_finder.hpp"
#include "baselines/fcl/sweep.hpp"

namespace octocell::baselines {
namespace {

class IntervalTree final : public FclFinder<fcl::IntervalTreeCollisionManagerd> {
  // It takes first minus last for an extent, so that the shortest side looks longest to it.
  std::uint64_t pairs_ahead() override { return sweep_pairs(spheres(), SweepAlong::shortest); }
};

}  // namespace

std::unique_ptr<PairFinder> make_fcl_interval_tree() { return std::make_unique<IntervalTree>(); }

}  // namespace octocell::baselines
