// SPDX-License-Identifier: MIT
// The C functions give what the C++ functions give, and a status for every error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "harness/scenes/scenes.hpp"
#include "include/octocell/octocell.h"
#include "include/octocell/octocell.hpp"

namespace octocell {
namespace {

using List = std::vector<Pair>;

std::vector<octocell_sphere> in_c(const std::vector<Sphere>& spheres) {
  std::vector<octocell_sphere> same;
  for (const Sphere& s : spheres) same.push_back({s.x, s.y, s.z, s.r});
  return same;
}

List listed(const octocell_pair* first, std::size_t count) {
  List list;
  for (const octocell_pair& pair : std::span(first, count)) list.push_back({pair.i, pair.j});
  return list;
}

/// Returns the pairs of a list and frees it.
List taken(octocell_pairs* pairs) {
  List list = listed(octocell_pairs_data(pairs), octocell_pairs_size(pairs));
  octocell_pairs_free(pairs);
  return list;
}

class LibraryC : public testing::Test {
 protected:
  const std::vector<Sphere> scene_ = generate("gas:n=1000").spheres;
  const std::vector<octocell_sphere> spheres_ = in_c(scene_);
  const Pairs found_ = find_pairs(scene_);
  const List truth_ = {found_.begin(), found_.end()};
  octocell_error error_ = {};
};

TEST_F(LibraryC, ABoxGivesShifts) {
  const octocell_sphere two[] = {{0.5F, 5, 5, 1}, {9, 5, 5, 1}};
  const octocell_box box = {{{10, 0, 0}, {0, 10, 0}, {0, 0, 10}}, {1, 0, 0}};
  octocell_options options = OCTOCELL_OPTIONS;
  options.box = &box;
  octocell_pairs* pairs = nullptr;
  ASSERT_EQ(octocell_find_pairs(two, 2, &options, &pairs, &error_), OCTOCELL_OK);
  ASSERT_EQ(octocell_pairs_size(pairs), 1U);
  const octocell_shift shift = *octocell_pairs_shifts(pairs);
  EXPECT_EQ((Shift{shift.a, shift.b, shift.c}), (Shift{1, 0, 0}));
  EXPECT_EQ(taken(pairs), (List{{0, 1}}));

  const octocell_sphere third[] = {{0, 0, 0, 1}, {4, 5, 5, 2.5F}};
  ASSERT_EQ(octocell_find_pairs_between(third, 2, two, 2, &options, &pairs, &error_), OCTOCELL_OK);
  EXPECT_EQ(taken(pairs), (List{{1, 0}}));
  options.cutoff = -1;
  ASSERT_EQ(octocell_find_pairs(two, 2, &options, &pairs, &error_), OCTOCELL_INVALID_ARGUMENT);
}

TEST_F(LibraryC, FindsAndCounts) {
  octocell_pairs* pairs = nullptr;
  ASSERT_EQ(octocell_find_pairs(spheres_.data(), spheres_.size(), nullptr, &pairs, &error_),
            OCTOCELL_OK);
  EXPECT_EQ(taken(pairs), truth_);
  std::uint64_t count = 0;
  octocell_options options = OCTOCELL_OPTIONS;
  options.threads = 2;
  ASSERT_EQ(octocell_count(spheres_.data(), spheres_.size(), &options, &count, nullptr),
            OCTOCELL_OK);
  EXPECT_EQ(count, truth_.size());
  ASSERT_EQ(octocell_find_pairs(nullptr, 0, nullptr, &pairs, nullptr), OCTOCELL_OK);
  EXPECT_TRUE(taken(pairs).empty());
}

TEST_F(LibraryC, FindsByFramesAndInChunks) {
  octocell_finder* finder = nullptr;
  ASSERT_EQ(octocell_finder_new(nullptr, 0, &finder, &error_), OCTOCELL_OK);
  for (int frame = 0; frame < 3; ++frame) {
    const octocell_pair* first = nullptr;
    std::size_t count = 0;
    ASSERT_EQ(
        octocell_finder_find(finder, spheres_.data(), spheres_.size(), &first, &count, &error_),
        OCTOCELL_OK);
    EXPECT_EQ(listed(first, count), truth_);
  }
  octocell_pairs* pairs = nullptr;
  ASSERT_EQ(octocell_finder_take(finder, &pairs, &error_), OCTOCELL_OK);
  octocell_finder_free(finder);
  EXPECT_EQ(taken(pairs), truth_);

  octocell_chunks* chunks = nullptr;
  ASSERT_EQ(octocell_chunks_new(spheres_.data(), spheres_.size(), truth_.size() / 3, nullptr,
                                &chunks, &error_),
            OCTOCELL_OK);
  List all;
  for (List chunk(1); !chunk.empty(); all.insert(all.end(), chunk.begin(), chunk.end())) {
    ASSERT_EQ(octocell_chunks_next(chunks, &pairs, &error_), OCTOCELL_OK);
    chunk = taken(pairs);
  }
  octocell_chunks_free(chunks);
  EXPECT_EQ(all, truth_);
}

TEST_F(LibraryC, KnowsFlags) {
  std::vector<std::uint32_t> all_static(spheres_.size(), make_flags(true, 1, kMaxMask).word);
  octocell_options options = OCTOCELL_OPTIONS;
  options.flags = all_static.data();
  std::uint64_t count = 1;
  ASSERT_EQ(octocell_count(spheres_.data(), spheres_.size(), &options, &count, &error_),
            OCTOCELL_OK);
  EXPECT_EQ(count, 0U);
}

TEST_F(LibraryC, VerifiesAndExplains) {
  std::vector<octocell_pair> list;
  for (const Pair& pair : truth_) list.push_back({pair.j, pair.i});
  list[2] = {7, 7};
  list.push_back(list[4]);
  octocell_verification result = {};
  ASSERT_EQ(octocell_verify(spheres_.data(), spheres_.size(), list.data(), list.size(), nullptr,
                            &result, &error_),
            OCTOCELL_OK);
  EXPECT_EQ(result.missed, 1U);
  EXPECT_EQ(result.first_missed.j, truth_[2].j);
  EXPECT_EQ(result.false_pairs, 1U);
  EXPECT_EQ(result.first_false.i, 7U);
  EXPECT_EQ(result.duplicates, 1U);
  EXPECT_EQ(result.first_duplicate.j, truth_[4].j);

  octocell_plan* plan = nullptr;
  ASSERT_EQ(octocell_plan_new(spheres_.data(), spheres_.size(), nullptr, &plan, &error_),
            OCTOCELL_OK);
  EXPECT_NE(std::string(octocell_plan_explain(plan)).find("half_shell"), std::string::npos);
  octocell_plan_free(plan);
}

TEST_F(LibraryC, ReturnsErrors) {
  std::vector<octocell_sphere> spheres = spheres_;
  spheres[12].y = std::numeric_limits<float>::infinity();
  octocell_pairs* pairs = nullptr;
  EXPECT_EQ(octocell_find_pairs(spheres.data(), spheres.size(), nullptr, &pairs, nullptr),
            OCTOCELL_INVALID_SPHERE);
  EXPECT_EQ(octocell_find_pairs(spheres.data(), spheres.size(), nullptr, &pairs, &error_),
            OCTOCELL_INVALID_SPHERE);
  EXPECT_EQ(pairs, nullptr);
  EXPECT_EQ(error_.status, OCTOCELL_INVALID_SPHERE);
  EXPECT_EQ(error_.sphere, 12U);
  EXPECT_EQ(std::string(error_.message).substr(0, 10), "sphere 12:");

  const auto status_with = [&](const octocell_options& options) {
    return octocell_find_pairs(spheres_.data(), spheres_.size(), &options, &pairs, &error_);
  };
  octocell_options options = OCTOCELL_OPTIONS;
  options.threads = -5;
  EXPECT_EQ(status_with(options), OCTOCELL_INVALID_ARGUMENT);
  options = OCTOCELL_OPTIONS;
  options.size = 8;
  EXPECT_EQ(status_with(options), OCTOCELL_INVALID_ARGUMENT);
  options = OCTOCELL_OPTIONS;
  options.device = 9;
  EXPECT_EQ(status_with(options), OCTOCELL_INVALID_ARGUMENT);
  EXPECT_EQ(octocell_find_pairs(nullptr, 3, nullptr, &pairs, &error_), OCTOCELL_INVALID_ARGUMENT);
  octocell_chunks* chunks = nullptr;
  EXPECT_EQ(octocell_chunks_new(spheres_.data(), 5, 0, nullptr, &chunks, &error_),
            OCTOCELL_INVALID_ARGUMENT);
  options = OCTOCELL_OPTIONS;
  EXPECT_EQ(status_with(options), OCTOCELL_OK);
  EXPECT_EQ(error_.status, OCTOCELL_OK);
  EXPECT_EQ(taken(pairs), truth_);
}

TEST_F(LibraryC, AcceptsNullWhereNothingIsToBeFreed) {
  octocell_pairs_free(nullptr);
  octocell_finder_free(nullptr);
  octocell_chunks_free(nullptr);
  octocell_plan_free(nullptr);
  EXPECT_EQ(octocell_version(), version());
}

}  // namespace
}  // namespace octocell
