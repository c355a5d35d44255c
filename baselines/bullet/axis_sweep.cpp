// SPDX-License-Identifier: MIT
// Bullet's btAxisSweep3: the ends of all boxes sorted along three axes, in integers of 16 bits.
#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "baselines/baselines.hpp"
#include "baselines/bullet/axis_sweep_finder.hpp"

namespace octocell::baselines {
namespace {

class AxisSweep final : public AxisSweepFinder<btAxisSweep3, unsigned short> {
  // Bullet only asserts this; a release build continues and writes past its arrays.
  static constexpr std::size_t kMaxProxies = 32766;

  std::optional<std::string> why_impossible() override {
    if (spheres().size() <= kMaxProxies) return std::nullopt;
    return fmt::format("btAxisSweep3 holds at most {} proxies, and there are {} spheres",
                       kMaxProxies, spheres().size());
  }
};

}  // namespace

std::unique_ptr<PairFinder> make_bullet_axis_sweep() { return std::make_unique<AxisSweep>(); }

}  // namespace octocell::baselines
