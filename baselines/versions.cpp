// SPDX-License-Identifier: MIT
#include <LinearMath/btScalar.h>
#include <fcl/config.h>

#include <string>

#include "baselines/baselines.hpp"

namespace octocell::baselines {

std::string fcl_version() { return FCL_VERSION; }

std::string bullet_version() {
  return std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
}

}  // namespace octocell::baselines
