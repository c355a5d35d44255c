// SPDX-License-Identifier: MIT
// Bullet's bt32BitAxisSweep3: the same sweep in integers of 32 bits.
#include <memory>

#include "baselines/baselines.hpp"
#include "baselines/bullet/axis_sweep_finder.hpp"

namespace octocell::baselines {
namespace {

class AxisSweep32 final : public AxisSweepFinder<bt32BitAxisSweep3, unsigned> {};

}  // namespace

std::unique_ptr<PairFinder> make_bullet_axis_sweep_32() { return std::make_unique<AxisSweep32>(); }

}  // namespace octocell::baselines
