// SPDX-License-Identifier: MIT
// The library's functions, as a program calls them: the exact pairs, whole, by frames and in
// chunks.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <typeinfo>
#include <utility>
#include <vector>

#include "harness/scenes/motion.hpp"
#include "harness/scenes/scenes.hpp"
#include "harness/verify/reference/reference.hpp"
#include "include/octocell/octocell.hpp"
#include "tests/support/sanitized.hpp"

namespace octocell {
namespace {

using List = std::vector<Pair>;

List listed(std::span<const Pair> pairs) { return {pairs.begin(), pairs.end()}; }

List sorted(List pairs) {
  std::ranges::sort(pairs);
  return pairs;
}

struct Case {
  std::string spec;
  Scene scene;
  List truth;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const SceneInfo& info : scenes()) {
    for (const int n : {0, 1, 2, 33, kSanitized ? 300 : 1500}) {
      const std::string spec = fmt::format("{}:n={}", info.name, n);
      Scene scene = generate(spec);
      List truth = reference::exact_pairs(scene);
      all.push_back({spec, std::move(scene), std::move(truth)});
    }
  }
  for (const char* spec : {"gas:n=500,static=0.5,groups=3", "cluster:n=300,static=0.2"}) {
    Scene scene = generate(spec);
    List truth = reference::exact_pairs(scene);
    all.push_back({spec, std::move(scene), std::move(truth)});
  }
  return all;
}

TEST(Library, FindsTheExactPairsOfEveryKindOfScene) {
  for (const auto& [spec, scene, truth] : cases()) {
    for (const int threads : {1, 2}) {
      const Options options = {.threads = threads, .flags = scene.flags};
      EXPECT_EQ(listed(find_pairs(scene.spheres, options)), truth) << spec;
      EXPECT_EQ(count(scene.spheres, options), truth.size()) << spec;
      EXPECT_TRUE(verify(scene.spheres, truth, options).exact()) << spec;
    }
    const Options unsorted = {.sorted = false, .flags = scene.flags};
    EXPECT_EQ(sorted(listed(find_pairs(scene.spheres, unsorted))), truth) << spec;
  }
}

/// Returns the largest number of pairs with one smaller id.
std::size_t most_of_one(std::span<const Pair> truth) {
  std::vector<std::size_t> counts(1);
  for (const Pair& pair : truth) {
    counts.resize(std::max<std::size_t>(counts.size(), pair.i + 1));
    ++counts[pair.i];
  }
  return std::ranges::max(counts);
}

TEST(Library, ChunksFollowEachOtherToTheWholeList) {
  for (const auto& [spec, scene, truth] : cases()) {
    if (truth.size() > 20000) continue;
    const std::size_t most = most_of_one(truth);
    const std::uint64_t quarter = truth.size() / 4 + 1;
    for (const std::uint64_t size : {quarter, quarter * 2, std::uint64_t{1} << 60}) {
      List all;
      for (const Pairs& chunk : Chunks(scene.spheres, size, {.flags = scene.flags})) {
        EXPECT_FALSE(chunk.empty());
        EXPECT_LE(chunk.size(), std::max<std::uint64_t>(size, most)) << spec;
        all.insert(all.end(), chunk.begin(), chunk.end());
      }
      EXPECT_EQ(all, truth) << spec << ", " << size;
    }
  }
}

TEST(Library, ChunksOfOnePairAreThoseOfOneSphere) {
  const std::vector<Sphere> spheres = generate("identical:n=20").spheres;
  Chunks chunks(spheres, 1, {.threads = 1});
  for (std::uint32_t i = 0; i < 19; ++i) {
    const Pairs chunk = chunks.next();
    ASSERT_EQ(chunk.size(), 19 - i);
    EXPECT_EQ(chunk[0], (Pair{i, i + 1}));
  }
  EXPECT_TRUE(chunks.next().empty());
  EXPECT_TRUE(chunks.next().empty());
}

TEST(Library, AFinderFindsFrameAfterFrame) {
  const Scene start = generate("gas:n=2000,static=0.3");
  for (const Motion motion : {Motion::slow, Motion::few, Motion::still, Motion::darts}) {
    for (const bool takes : {false, true}) {
      Finder finder({.threads = 2, .flags = start.flags});
      for (const auto& spheres : move(start.spheres, motion, kSanitized ? 4 : 8, 7, start.flags)) {
        const List truth = reference::exact_pairs(spheres, start.flags);
        EXPECT_EQ(listed(finder.find(spheres)), truth) << "motion " << static_cast<int>(motion);
        if (!takes) continue;
        EXPECT_EQ(listed(finder.take()), truth) << "motion " << static_cast<int>(motion);
        EXPECT_TRUE(finder.take().empty());
      }
    }
  }
}

TEST(Library, SpheresMayComeAndGo) {
  Finder finder;
  for (const char* spec : {"gas:n=1000", "gas:n=10", "gas:n=0", "gas:n=3000", "identical:n=300",
                           "poly:n=300", "gas:n=300", "lattice:n=300", "gas:n=1", "gas:n=1000"}) {
    const Scene scene = generate(spec);
    EXPECT_EQ(listed(finder.find(scene.spheres)), reference::exact_pairs(scene)) << spec;
  }
}

TEST(Library, PairsAreMovedOutWithoutACopy) {
  const Scene scene = generate("gas:n=20000");
  Finder finder;
  const std::span<const Pair> found = finder.find(scene.spheres);
  const Pair* const first = found.data();
  const List truth = listed(found);
  const Pairs taken = finder.take();
  EXPECT_TRUE(taken.data() == first || kSanitized) << "sanitizers move what is cut";
  finder.find(scene.spheres);
  finder = Finder();
  EXPECT_EQ(listed(taken), truth) << "they outlive their finder";
}

/// Expects an Error of this kind from each function that reads spheres; `sphere` is what it names.
void expect_refusal(std::span<const Sphere> spheres, const Options& options, ErrorKind kind,
                    std::optional<std::uint64_t> sphere, const std::string& words) {
  const auto refused = [&](const char* function, const auto& call) {
    try {
      call();
      ADD_FAILURE() << function << " accepts it: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << function << ": " << error.what();
      EXPECT_EQ(error.sphere(), sphere) << function;
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_EQ(typeid(error), typeid(Error)) << function;
    }
  };
  refused("find_pairs", [&] { find_pairs(spheres, options); });
  refused("count", [&] { count(spheres, options); });
  refused("find", [&] { Finder(options).find(spheres); });
  refused("next", [&] { Chunks(spheres, 10, options).next(); });
  refused("verify", [&] { verify(spheres, {}, options); });
  refused("plan", [&] { plan(spheres, options); });
}

TEST(Library, NamesTheFirstInvalidSphere) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const Sphere bad :
       {Sphere{kNan, 0, 0, 1}, {0, kInfinity, 0, 1}, {0, 0, 0, kNan}, {0, 0, 0, -1e-40F}}) {
    std::vector<Sphere> spheres = generate("gas:n=100").spheres;
    spheres[41] = spheres[77] = bad;
    expect_refusal(spheres, {}, ErrorKind::invalid_sphere, 41, "sphere 41: ");
  }
}

TEST(Library, RefusesWhatItCannotUse) {
  const std::vector<Sphere> spheres = generate("gas:n=10").spheres;
  const std::vector<Flags> flags(9);
  constexpr auto kArgument = ErrorKind::invalid_argument;
  expect_refusal(spheres, {.flags = flags}, kArgument, {}, "flags of 9 spheres for 10");
  expect_refusal(spheres, {.threads = -1}, kArgument, {}, "threads = -1");
  expect_refusal(spheres, {.threads = 1025}, kArgument, {}, "threads = 1025");
  try {
    Chunks(spheres, 0);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kArgument);
  }
  if (why_unavailable(Device::cuda)) {
    expect_refusal(spheres, {.device = Device::cuda}, ErrorKind::unavailable, {},
                   "cannot run here");
  }
  EXPECT_FALSE(why_unavailable(Device::cpu));
}

TEST(Library, StopsWhenAskedTo) {
  const Scene scene = generate("gas:n=3000");
  const List truth = reference::exact_pairs(scene);
  int asked = 0;
  int last = 0;
  const Options options = {.threads = 2, .stop = [&] { return ++asked > last; }};
  const std::thread::id caller = std::this_thread::get_id();
  Finder finder(options);
  for (bool stopped = true; stopped; ++last) {
    asked = 0;
    try {
      EXPECT_EQ(listed(finder.find(scene.spheres)), truth);
      stopped = false;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::stopped);
      EXPECT_TRUE(finder.take().empty());
    }
  }
  EXPECT_GT(last, 3);
  last = 0;
  EXPECT_THROW(find_pairs(scene.spheres, options), Error);
  find_pairs(scene.spheres, {.threads = 3, .stop = [&] {
                               EXPECT_EQ(std::this_thread::get_id(), caller);
                               return false;
                             }});
}

TEST(Library, AFinderGoesOnAfterAnError) {
  const Scene scene = generate("gas:n=500");
  std::vector<Sphere> bad = scene.spheres;
  bad[3].r = -1;
  const List truth = reference::exact_pairs(scene);
  Finder finder;
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(listed(finder.find(scene.spheres)), truth);
    EXPECT_THROW(finder.find(bad), Error);
    EXPECT_TRUE(finder.take().empty()) << "of a frame that failed there are no pairs";
  }
}

TEST(Library, ComparesAnyList) {
  const Scene scene = generate("lattice:n=1000");
  const List truth = reference::exact_pairs(scene);
  const auto verified = [&](const List& list) { return verify(scene.spheres, list); };
  List list = truth;
  std::ranges::reverse(list);
  for (Pair& pair : list) std::swap(pair.i, pair.j);
  EXPECT_TRUE(verified(list).exact()) << "any order is as good";

  list.erase(std::ranges::find(list, Pair{truth[5].j, truth[5].i}));
  list.erase(std::ranges::find(list, Pair{truth[9].j, truth[9].i}));
  EXPECT_EQ(verified(list).missed, 2U);
  EXPECT_EQ(verified(list).first_missed, truth[5]);
  EXPECT_EQ(verified(list).false_pairs + verified(list).duplicates, 0U);

  list = truth;
  list.push_back(truth[7]);
  list.push_back(truth[7]);
  list.push_back({truth[3].j, truth[3].i});
  EXPECT_EQ(verified(list).duplicates, 3U);
  EXPECT_EQ(verified(list).first_duplicate, truth[3]);
  EXPECT_EQ(verified(list).missed + verified(list).false_pairs, 0U);

  list = truth;
  for (const Pair wrong : {Pair{4, 4}, {4, 1000}, {4000000000, 3}, {999, 0}}) list.push_back(wrong);
  EXPECT_EQ(verified(list).false_pairs, 4U);
  EXPECT_EQ(verified(list).first_false, (Pair{0, 999}));
  EXPECT_EQ(verified(list).missed + verified(list).duplicates, 0U);

  EXPECT_EQ(verified({}).missed, truth.size());
  EXPECT_EQ(verify({}, List{{0, 1}}).false_pairs, 1U);
}

TEST(Library, PlansAndExplains) {
  const std::string text = plan(generate("gas:n=100000").spheres).explain();
  EXPECT_NE(text.find("half_shell"), std::string::npos) << text;
  EXPECT_NE(text.find("100000"), std::string::npos) << text;
  EXPECT_FALSE(plan({}).explain().empty());
}

TEST(Library, FindersInThreadsShareNothing) {
  const Scene shared = generate("gas:n=3000");
  const List truth = reference::exact_pairs(shared);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      Finder finder({.threads = t % 2 == 0 ? 1 : 2});
      const Scene own = generate(fmt::format("gas:n=1000,seed={}", t));
      for (int round = 0; round < 4; ++round) {
        if (!std::ranges::equal(finder.find(shared.spheres), truth)) ++wrong[t];
        const std::span<const Pair> pairs = finder.find(own.spheres);
        if (!verify(own.spheres, pairs, {.threads = 1}).exact()) ++wrong[t];
        if (count(shared.spheres, {.threads = 2}) != truth.size()) ++wrong[t];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

/// The same functions where spheres and pairs travel to a device and back.
TEST(LibraryOnDevice, GivesTheSamePairs) {
  if (const auto reason = why_unavailable(Device::cuda)) GTEST_SKIP() << *reason;
  for (const auto& [spec, scene, truth] : cases()) {
    const Options options = {.device = Device::cuda, .flags = scene.flags};
    EXPECT_EQ(listed(find_pairs(scene.spheres, options)), truth) << spec;
    EXPECT_EQ(count(scene.spheres, options), truth.size()) << spec;
    EXPECT_TRUE(verify(scene.spheres, truth, options).exact()) << spec;
    if (truth.size() > 20000) continue;
    List all;
    for (const Pairs& chunk : Chunks(scene.spheres, truth.size() / 3 + 1, options)) {
      all.insert(all.end(), chunk.begin(), chunk.end());
    }
    EXPECT_EQ(all, truth) << spec;
  }
}

TEST(LibraryOnDevice, FindsFrameAfterFrame) {
  if (const auto reason = why_unavailable(Device::cuda)) GTEST_SKIP() << *reason;
  const Scene start = generate("gas:n=2000,static=0.3");
  for (const bool takes : {false, true}) {
    Finder finder({.device = Device::cuda, .flags = start.flags});
    for (const auto& spheres : move(start.spheres, Motion::slow, 6, 7, start.flags)) {
      const List truth = reference::exact_pairs(spheres, start.flags);
      EXPECT_EQ(listed(finder.find(spheres)), truth);
      if (takes) {
        EXPECT_EQ(listed(finder.take()), truth);
      }
    }
  }
}

}  // namespace
}  // namespace octocell
