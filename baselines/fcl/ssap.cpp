// SPDX-License-Identifier: MIT
// FCL's SSaPCollisionManager: boxes are sorted by their lower ends and swept along one axis at each
// query.
#include <fcl/broadphase/broadphase_SSaP.h>

#include <cstdint>
#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_finder.hpp"
#include "baselines/fcl/sweep.hpp"

namespace octocell::baselines {
namespace {

class Ssap final : public FclFinder<fcl::SSaPCollisionManagerd> {
  std::uint64_t pairs_ahead() override { return sweep_pairs(spheres(), SweepAlong::longest); }
};

}  // namespace

std::unique_ptr<PairFinder> make_fcl_ssap() { return std::make_unique<Ssap>(); }

}  // namespace octocell::baselines
