// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "harness/bench/gpu.hpp"

namespace octocell::bench {

/// Describes where the numbers come from: machine, compiler, flags, commit, libraries, date.
nlohmann::ordered_json describe_build_and_machine();

/// {"name", "driver", "copy_gigabytes_per_second"}
nlohmann::ordered_json to_json(const Gpu& gpu);

}  // namespace octocell::bench
