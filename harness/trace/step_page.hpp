// SPDX-License-Identifier: MIT
// The page that steps through small scenes: one file with style, script, scenes, programs and the
// course's own C++ as WebAssembly inside (course/page).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "harness/trace/run_trace.hpp"

namespace octocell::trace {

inline constexpr std::size_t kMostDrawn = 32;

/// Throws LimitError if the page cannot show the scene: no spheres, or too many.
void require_drawable(SceneView scene, std::string_view name);

/// Returns the page. It shows the first scene first, and compares its own arrays with those of the
/// runs.
std::string step_page(std::span<const RunTrace> runs);

/// The files of course/ that the page is made of, as they were when the program was built.
struct PageFile {
  std::string_view name;
  std::string_view text;
};
std::span<const PageFile> page_scripts();   // in the order in which the page needs them
std::span<const PageFile> page_programs();  // of course/pipeline
std::string_view page_frame();
std::string_view page_style();
std::string_view page_module();

}  // namespace octocell::trace
