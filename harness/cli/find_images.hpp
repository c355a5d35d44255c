// SPDX-License-Identifier: MIT
// find in a box that repeats, or with a cutoff.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "core/planner/planner.hpp"
#include "harness/engine/images/find_images.hpp"
#include "harness/engine/registry.hpp"
#include "harness/files/named_files.hpp"
#include "harness/scenes/scene.hpp"

namespace octocell::cli {

struct ImageOptions {
  std::optional<std::string> box;
  std::optional<std::string> periodic;
  std::optional<std::string> shifts;
  double cutoff = 0.0;

  [[nodiscard]] bool any() const { return box || periodic || shifts || cutoff != 0.0; }
};

void add_image_options(CLI::App& sub, ImageOptions& options);

/// Returns what the options ask of a scene. Throws InputError for a box that cannot be read.
images::Question question_of(SceneView scene, const ImageOptions& options);

/// Finds the pairs, writes them to files, and prints what was found.
struct ImageOutputs {
  std::optional<std::string> pairs;
  bool count = false;
  bool json = false;
};
int find_images(const Scene& scene, const ImageOptions& options, const Implementation& how,
                const PlanOptions& plan_options, const ImageOutputs& outputs);

}  // namespace octocell::cli
