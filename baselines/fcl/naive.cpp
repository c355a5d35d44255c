// SPDX-License-Identifier: MIT
// FCL's NaiveCollisionManager: every box against every other.
#include <fcl/broadphase/broadphase_bruteforce.h>

#include <cstdint>
#include <memory>

#include "baselines/all_pairs.hpp"
#include "baselines/baselines.hpp"
#include "baselines/fcl/fcl_finder.hpp"

namespace octocell::baselines {
namespace {

class Naive final : public FclFinder<fcl::NaiveCollisionManagerd> {
  std::uint64_t pairs_ahead() override { return all_pairs(spheres().size()); }
};

}  // namespace

std::unique_ptr<PairFinder> make_fcl_naive() { return std::make_unique<Naive>(); }

}  // namespace octocell::baselines
