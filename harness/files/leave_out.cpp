// SPDX-License-Identifier: MIT
#include "harness/files/leave_out.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

#include "harness/files/validate.hpp"

namespace octocell {
namespace {

std::string flaw_of(const Scene& scene, std::size_t i) {
  return scene.unrounded ? flaw_of((*scene.unrounded)[i]) : flaw_of(scene.spheres[i]);
}

template <typename T>
void keep(std::vector<T>& list, const std::vector<bool>& is_kept) {
  if (list.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i]) list[kept++] = list[i];
  }
  list.resize(kept);
}

}  // namespace

void leave_out_invalid(Scene& scene) {
  std::vector<bool> is_kept(scene.spheres.size(), true);
  std::size_t left_out = 0;
  std::string first;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    const std::string flaw = flaw_of(scene, i);
    if (flaw.empty()) continue;
    is_kept[i] = false;
    if (left_out++ == 0) first = fmt::format("sphere {}: {}", i, flaw);
  }
  if (left_out == 0) return;
  keep(scene.spheres, is_kept);
  keep(scene.flags, is_kept);
  if (scene.unrounded) keep(*scene.unrounded, is_kept);
  scene.notes.push_back(fmt::format("{} of {} spheres are left out, the first is {}", left_out,
                                    is_kept.size(), first));
}

}  // namespace octocell
