// SPDX-License-Identifier: MIT
// Prints checksums of scenes and of answers, one a line. compilers.py builds this program with many
// compilers and flags: all must print the same.
#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "impl_cpu/backend.hpp"

namespace {

using namespace octocell;

/// Every generator as it comes; below, what else tempts a compiler: ties everywhere, far offsets.
std::vector<std::string> specs() {
  std::vector<std::string> specs;
  for (const SceneInfo& scene : scenes()) specs.push_back(std::string(scene.name) + ":n=300");
  for (const char* hard : {"lattice:n=343,spacing=0.1", "shifted:n=300,offset=1e7",
                           "poly:n=300,ratio=1e6", "gas:n=700,seed=5,phi=0.3"}) {
    specs.push_back(hard);
  }
  return specs;
}

struct Case {
  std::string name;
  std::vector<Sphere> spheres;
};

/// Beside the scene itself: its double of the smallest numbers, and one whose squares overflow.
std::vector<Case> cases_of(const std::string& spec) {
  std::vector<Case> cases = {{spec, generate(spec).spheres}};
  for (const float factor : {0x1p-145F, 0x1p100F}) {
    Case scaled = {fmt::format("{} times {:g}", spec, factor), cases[0].spheres};
    for (Sphere& s : scaled.spheres) {
      s = {s.x * factor, s.y * factor, s.z * factor, s.r * factor};
    }
    cases.push_back(std::move(scaled));
  }
  return cases;
}

/// As of pairs: the words of four bytes, two by two.
std::uint64_t checksum_of(std::span<const Sphere> spheres) {
  std::uint64_t sum = 0;
  for (const Sphere& s : spheres) {
    const Pair low = {std::bit_cast<std::uint32_t>(s.x), std::bit_cast<std::uint32_t>(s.y)};
    const Pair high = {std::bit_cast<std::uint32_t>(s.z), std::bit_cast<std::uint32_t>(s.r)};
    sum = sum * 31 + mix_pair(low) + 3 * mix_pair(high);
  }
  return sum;
}

std::string answer(std::span<const Sphere> spheres, const PlanOptions& options) {
  try {
    const auto finder = cpu::make_backend();
    find_completely(*finder, {spheres}, options);
    const PairDigest digest = finder->digest();
    return fmt::format("{} {:#018x}", digest.count, digest.checksum);
  } catch (const LimitError& refusal) {
    return "refused";
  }
}

void print_answers(const Case& scene) {
  fmt::print("{} | spheres {} {:#018x}\n", scene.name, scene.spheres.size(),
             checksum_of(scene.spheres));
  const PairDigest truth = digest_of(reference::exact_pairs(scene.spheres));
  fmt::print("{} | exact {} {:#018x}\n", scene.name, truth.count, truth.checksum);
  for (const Method method : {Method::home_phantom, Method::half_shell, Method::brute_force}) {
    for (std::size_t r = 0; r < kRuleNames.size(); ++r) {
      const PlanOptions options = {.method = method, .rule = static_cast<Rule>(r), .threads = 2};
      fmt::print("{} | {} {} {}\n", scene.name, name_of(method), kRuleNames[r],
                 answer(scene.spheres, options));
      // A lattice spares its scene all uncertain pairs, which are what tempts compilers.
      PlanOptions uncertain = options;
      uncertain.allowed = uncertain.allowed.without(Skip::uncertain_pairs);
      fmt::print("{} | {} {} uncertain {}\n", scene.name, name_of(method), kRuleNames[r],
                 answer(scene.spheres, uncertain));
    }
  }
}

}  // namespace

int main() {
  for (const std::string& spec : specs()) {
    for (const Case& scene : cases_of(spec)) print_answers(scene);
  }
}
