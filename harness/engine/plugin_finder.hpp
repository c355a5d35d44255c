// SPDX-License-Identifier: MIT
// A plug-in behind the interface of all finders.
#pragma once

#include <memory>

#include "core/finder.hpp"
#include "harness/plugin/plugin_library.hpp"

namespace octocell {

/// A plug-in knows nothing of flags: pairs that they forbid are left out afterwards. Throws
/// InputError when the pairs are read if one of them names no two spheres.
std::unique_ptr<PairFinder> make_plugin_finder(std::shared_ptr<const PluginLibrary> library);

}  // namespace octocell
