// SPDX-License-Identifier: MIT
// A workspace of impl_cpu that tests run stage by stage.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/planner/planner.hpp"
#include "harness/scenes/scenes.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu {

/// Makes a workspace as the backend's upload() does.
inline std::unique_ptr<Workspace> workspace_for(SceneView scene, const PlanOptions& options) {
  auto w = std::make_unique<Workspace>();
  w->plan = make_plan(measure(scene), options);
  w->scene = scene;
  w->threads = std::make_unique<Threads>(w->plan.threads);
  w->allocate();
  return w;
}

inline std::span<const std::uint32_t> sorted_ids(const Workspace& w) {
  return {w.ids[w.current].cell_ids.data(), w.id_count};
}
inline std::span<const Object> sorted_objects(const Workspace& w) {
  return {w.ids[w.current].objects.data(), w.id_count};
}

}  // namespace octocell::cpu
