// SPDX-License-Identifier: MIT
// Compares every host backend, method and correct rule with the reference on any scene.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/registry.hpp"
#include "harness/verify/reference/reference.hpp"
#include "tests/fuzz/scene_of_bytes.hpp"

namespace octocell::fuzz {
namespace {

/// Returns our backends that run here without a GPU, without negative controls, which are wrong by
/// intent.
std::vector<Implementation> judged() {
  std::vector<Implementation> list = implementations();
  std::erase_if(list, [](const Implementation& how) {
    return how.is_baseline() || how.negative_control() || how.backend->device;
  });
  return list;
}

[[noreturn]] void fail(const Implementation& how, const FuzzScene& scene, const char* what) {
  std::fprintf(stderr, "%s: %s\n", how.label().c_str(), what);
  for (const Sphere& s : scene.spheres) {
    std::fprintf(stderr, "  {%aF, %aF, %aF, %aF},\n", double{s.x}, double{s.y}, double{s.z},
                 double{s.r});
  }
  std::abort();
}

Outcome find(PairFinder& finder, const FuzzScene& scene, const PlanOptions& options) {
  const SceneView view = {scene.spheres};
  if (!scene.no_room) return find_completely(finder, view, options);
  Plan plan = plan_scene(view, options);
  plan.capacity = {};
  HostClock clock;
  return complete(finder, view, plan, clock);
}

void judge(const Implementation& how, const FuzzScene& scene, const std::vector<Pair>& truth) {
  PlanOptions options = how.plan_options(scene.threads);
  if (how.rule == Rule::lowest_cell && how.has_rule()) options.cell_side = scene.cell_side;
  const std::unique_ptr<PairFinder> finder = how.backend->create();
  try {
    find(*finder, scene, options);
  } catch (const LimitError& refusal) {
    if (how.rule == Rule::lowest_cell) fail(how, scene, refusal.what());
    return;  // other rules have conditions
  }
  if (finder->download() != truth) fail(how, scene, "the pairs are not the exact ones");
  if (finder->digest() != digest_of(truth)) fail(how, scene, "the digest is not that of the pairs");
}

}  // namespace
}  // namespace octocell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace octocell;
  static const std::vector<Implementation> all = fuzz::judged();
  const fuzz::FuzzScene scene = fuzz::scene_of({data, size});
  const std::vector<Pair> truth = reference::brute_force(scene.spheres);
  for (const Implementation& how : all) fuzz::judge(how, scene, truth);
  return 0;
}
