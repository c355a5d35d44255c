// SPDX-License-Identifier: MIT
// The judge of the stress suite notices each kind of fault; its scenes are what they promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "harness/files/validate.hpp"
#include "harness/verify/stress/earlier.hpp"
#include "harness/verify/stress/run.hpp"

namespace octocell::stress {
namespace {

enum class Fault : std::uint8_t {
  none,
  loses_a_pair,
  makes_one_up,
  says_one_twice,
  digest_of_others,
  clips_when_full,
  ignores_updates,
  keeps_the_first_scene,
  takes_anything,
  refuses,
};

/// impl_cpu with a fault planted around it.
class Faulty final : public Wrapped {
 public:
  explicit Faulty(Fault fault) : Wrapped(backend_named("impl_cpu").create()), fault_(fault) {}

  void upload(const Plan& plan, SceneView scene) override {
    if (fault_ == Fault::refuses) throw LimitError("not today");
    if (fault_ == Fault::keeps_the_first_scene && uploaded_) return;
    uploaded_ = true;
    room_ = plan.capacity.pairs;
    inner_->upload(plan, scene);
  }
  void update(SceneView scene) override {
    if (fault_ != Fault::ignores_updates) inner_->update(scene);
  }
  Counts counts() override {
    Counts counts = inner_->counts();
    if (fault_ == Fault::clips_when_full) counts.pairs = std::min(counts.pairs, room_);
    return counts;
  }
  std::vector<Pair> download() override {
    std::vector<Pair> pairs = inner_->download();
    if (fault_ == Fault::loses_a_pair) pairs.pop_back();
    if (fault_ == Fault::makes_one_up) pairs.push_back({0xfffffff0U, 0xfffffff1U});
    if (fault_ == Fault::says_one_twice) pairs.push_back(pairs.back());
    return pairs;
  }
  PairDigest digest() override {
    PairDigest digest = inner_->digest();
    if (fault_ == Fault::digest_of_others) ++digest.checksum;
    return digest;
  }

 private:
  Fault fault_;
  bool uploaded_ = false;
  std::uint64_t room_ = 0;
};

template <Fault fault>
std::unique_ptr<PairFinder> make_faulty() {
  return std::make_unique<Faulty>(fault);
}

/// How the named entry judges impl_cpu with this fault.
template <Fault fault>
EntryResult row_of(std::string_view id) {
  static const BackendInfo backend = {
      .name = "faulty",
      .kind = Kind::backend,
      .summary = {},
      .methods = {},
      .threaded = true,
      .why_unavailable = [] { return std::optional<std::string>(); },
      .create = make_faulty<fault>};
  static const std::vector<Entry> entries = catalogue();
  const auto entry = std::ranges::find(entries, id, &Entry::id);
  const Implementation how[] = {{.backend = &backend}};
  const Limits limits = {.threads = 2, .candidates = 100'000'000, .repetitions = 2};
  return run_entry(*entry, Size::slice, how, limits, [] { return false; }).at(0);
}

TEST(Judge, FindsNoFaultWhereThereIsNone) {
  for (const char* id : {"A1", "B9", "C20", "F31", "F33", "G36", "G38", "H41", "M7"}) {
    const EntryResult row = row_of<Fault::none>(id);
    EXPECT_EQ(row.status(), Status::exact) << id << ": " << row.worst_case << ": " << row.reason;
    EXPECT_FALSE(row.failed());
  }
}

TEST(Judge, CountsWhatIsMissedMadeUpAndRepeated) {
  const EntryResult lossy = row_of<Fault::loses_a_pair>("A1");
  EXPECT_EQ(lossy.difference.missed, 3U) << "one in each of three cases";
  EXPECT_TRUE(lossy.failed());
  EXPECT_EQ(lossy.worst_case, "1");
  EXPECT_EQ(lossy.reason, "missed 1, false 0, duplicates 0");
  EXPECT_EQ(row_of<Fault::makes_one_up>("A1").difference.false_pairs, 3U);
  EXPECT_EQ(row_of<Fault::says_one_twice>("A1").difference.duplicates, 3U);
}

TEST(Judge, ComparesTheDigest) {
  EXPECT_TRUE(row_of<Fault::digest_of_others>("A1").failed());
  EXPECT_TRUE(row_of<Fault::digest_of_others>("H41").failed());
}

TEST(Judge, NoticesClippedBuffers) { EXPECT_TRUE(row_of<Fault::clips_when_full>("F31").failed()); }

TEST(Judge, NoticesFramesAndScenesThatAreForgotten) {
  EXPECT_TRUE(row_of<Fault::ignores_updates>("G36").failed());
  EXPECT_TRUE(row_of<Fault::ignores_updates>("G37").failed());
  EXPECT_TRUE(row_of<Fault::keeps_the_first_scene>("G38").failed());
  EXPECT_TRUE(row_of<Fault::keeps_the_first_scene>("G39").failed());
}

TEST(Judge, LetsNoRuleForAnySceneRefuse) {
  const EntryResult row = row_of<Fault::refuses>("A1");
  EXPECT_TRUE(row.failed());
  EXPECT_EQ(row.reason, "not today");
}

TEST(Judge, EndsALibraryThatHangsAndNamesOneThatCrashes) {
  const Case scene = {.name = "two", .spheres = {{0, 0, 0, 1}, {1, 0, 0, 1}}};
  Truth truth = {.pairs = {{0, 1}}, .digest = digest_of(std::vector<Pair>{{0, 1}})};
  const Limits limits = {.library_candidates = 100, .library_time = std::chrono::seconds(1)};
  BackendInfo library = backend_named("fcl_naive");
  library.create = []() -> std::unique_ptr<PairFinder> {
    std::this_thread::sleep_for(std::chrono::hours(1));
    return nullptr;
  };
  EXPECT_EQ(judge({.backend = &library}, Ask::pairs, scene, truth, limits).status, Status::late);
  library.create = []() -> std::unique_ptr<PairFinder> { std::abort(); };
  EXPECT_EQ(judge({.backend = &library}, Ask::pairs, scene, truth, limits).status, Status::crashed);
}

TEST(Judge, DistrustsAnOracleThatContradictsAFormula) {
  const Entry entry = {.id = "X1", .name = "x"};
  Case scene = {.name = "two", .spheres = {{0, 0, 0, 1}, {1, 0, 0, 1}}, .pair_count = 1};
  EXPECT_EQ(truth_of(entry, scene).pairs.size(), 1U);
  scene.pair_count = 2;
  EXPECT_THROW(truth_of(entry, scene), Error);
  scene.pair_count = 1;
  scene.pairs = std::vector<Pair>{{0, 2}};
  EXPECT_THROW(truth_of(entry, scene), Error);
}

TEST(Catalogue, HasEachOfItsEntriesOnce) {
  std::set<std::string> numbers;
  for (const Entry& entry : catalogue()) {
    EXPECT_TRUE(numbers.insert(std::string(entry.id)).second) << entry.id;
    EXPECT_EQ(entry.cases == nullptr, !entry.not_run.empty()) << entry.id;
  }
  int found = 0;
  for (int k = 1; k <= 44; ++k) {
    for (const char family : std::string("ABCDEFGH")) {
      found += static_cast<int>(numbers.count(family + std::to_string(k)));
    }
  }
  EXPECT_EQ(found, 44);
}

TEST(Catalogue, GivesValidScenesTheSameEachTime) {
  for (const Entry& entry : catalogue()) {
    if (entry.cases == nullptr || entry.ask == Ask::refusal || entry.sizes.slice == 0) continue;
    const std::vector<Case> cases = entry.cases(entry.sizes.slice);
    const std::vector<Case> again = entry.cases(entry.sizes.slice);
    ASSERT_FALSE(cases.empty()) << entry.id;
    for (std::size_t k = 0; k < cases.size(); ++k) {
      EXPECT_NO_THROW(validate(cases[k].spheres, entry.id));
      EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(cases[k].spheres)),
                                     std::as_bytes(std::span(again[k].spheres))))
          << entry.id;
    }
  }
}

}  // namespace
}  // namespace octocell::stress
