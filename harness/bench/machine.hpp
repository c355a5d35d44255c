// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace octocell::bench {

/// Where and from what the numbers come: machine, compiler, flags, commit, libraries, date.
nlohmann::ordered_json describe_build_and_machine();

}  // namespace octocell::bench
