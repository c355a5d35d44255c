// SPDX-License-Identifier: MIT
// Which scenes, frames and rows a preset has.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/bench/groups.hpp"
#include "harness/bench/rows.hpp"

namespace octocell::bench {
namespace {

const std::regex kAll("");

std::vector<Group> preset(const char* name) {
  BenchOptions options;
  options.preset = name;
  return choose_groups(options);
}

bool same_spheres(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Sphere)) == 0;
}

TEST(BenchGroups, WithoutFlagsKeepSpheresStillAllTheSame) {
  Group group = {
      .scene = "gas", .argument = "gas:n=200,static=0.9", .motion = Motion::brownian, .frames = 3};
  const Footage told = footage_of(group);
  group.without_flags = true;
  const Footage without_flags = footage_of(group);
  ASSERT_EQ(told.flags.size(), 200U);
  EXPECT_TRUE(without_flags.flags.empty());
  EXPECT_NE(told.spec, without_flags.spec);
  ASSERT_EQ(told.frames.size(), without_flags.frames.size());
  for (std::size_t f = 0; f < told.frames.size(); ++f) {
    EXPECT_TRUE(same_spheres(told.frames[f], without_flags.frames[f])) << "frame " << f;
  }
  EXPECT_FALSE(same_spheres(told.frames[0], told.frames[1])) << "some do move";
}

TEST(BenchGroups, FramesOfFlaggedSpheresStandBesideTheSameWithoutFlags) {
  const std::vector<Group> groups = preset("frames");
  ASSERT_GE(groups.size(), 2U);
  const Group& told = groups[groups.size() - 2];
  const Group& without_flags = groups.back();
  EXPECT_EQ(without_flags.scene, told.scene + "_without_flags");
  EXPECT_EQ(without_flags.argument, told.argument);
  EXPECT_EQ(without_flags.motion, told.motion);
  EXPECT_EQ(without_flags.frames, told.frames);
  EXPECT_TRUE(without_flags.without_flags && !told.without_flags);
}

TEST(BenchGroups, FramesAreTimedBesideTheSameSearchedAnew) {
  for (const Group& group : preset("frames")) {
    std::set<std::string> backends;
    std::set<std::string> rebuilt;
    for (const RowSpec& row : rows_of(group, "all", kAll)) {
      EXPECT_EQ(row.run, Run::dynamic);
      (row.skips.empty() ? backends : rebuilt).emplace(row.how.backend->name);
    }
    EXPECT_EQ(backends, (std::set<std::string>{"impl_cpu", "impl_cuda_custom"})) << group.scene;
    EXPECT_EQ(rebuilt, backends) << group.scene;
  }
}

TEST(BenchGroups, LabelsOfAPresetAreDistinct) {
  for (const char* name : {"quick", "full", "gpu", "frames", "ablation", "error", "real"}) {
    std::set<std::pair<std::string, std::uint64_t>> labels;
    for (const Group& group : preset(name)) {
      EXPECT_TRUE(labels.emplace(group.scene, group.n).second) << name << ' ' << group.scene;
    }
  }
}

}  // namespace
}  // namespace octocell::bench
