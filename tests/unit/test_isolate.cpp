// SPDX-License-Identifier: MIT
// A finder that crashes, hangs or fails does not affect its caller.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/engine/isolate.hpp"
#include "harness/engine/registry.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {
namespace {

using namespace std::chrono_literals;

const PlanOptions kBuffersOnly = {.buffers_only = true};

/// Does what it is told to in find_pairs().
class Fake final : public PairFinder {
 public:
  explicit Fake(void (*act)()) : act_(act) {}
  void upload(const Plan&, SceneView) override {}
  void update(SceneView) override {}
  void find_pairs(StageClock& clock) override {
    clock.start();
    act_();
  }
  Counts counts() override {
    Counts found;
    found.pairs = 1;
    return found;
  }
  std::vector<Pair> download() override { return {{1, 2}}; }
  PairDigest digest() override { return digest_of(download()); }

 private:
  void (*act_)();
};

std::string refusal_of(void (*act)(), std::chrono::duration<double> limit = 30s) {
  const Scene scene = generate("gas:n=10");
  try {
    find_isolated([act] { return std::make_unique<Fake>(act); }, scene.view(), kBuffersOnly, limit);
  } catch (const LimitError& refusal) {
    return refusal.what();
  }
  return "answered";
}

TEST(Isolate, GivesTheSameAnswerAsWithoutIt) {
  const Scene scene = generate("dense:n=5000");
  for (const Implementation& how : implementations()) {
    if (!how.is_baseline()) continue;  // ours may leave threads behind, which no child inherits
    const auto finder = how.backend->create();
    const Outcome outcome = find_completely(*finder, scene.view(), how.plan_options(2));
    const std::vector<Pair> pairs = finder->download();
    const PairDigest digest = finder->digest();
    const FinderAnswer answer =
        find_isolated(how.backend->create, scene.view(), how.plan_options(1), 120s);
    EXPECT_EQ(answer.pairs, pairs) << how.label();
    EXPECT_EQ(answer.digest, digest) << how.label();
    EXPECT_EQ(answer.counts.pairs, outcome.counts.pairs) << how.label();
    EXPECT_EQ(answer.counts.candidates, outcome.counts.candidates) << how.label();
  }
}

TEST(Isolate, NamesTheSignal) {
  EXPECT_EQ(refusal_of([] { raise(SIGSEGV); }), "crashed with SIGSEGV");
  EXPECT_EQ(refusal_of([] { std::abort(); }), "crashed with SIGABRT");
  EXPECT_EQ(refusal_of([] { raise(SIGKILL); }), "crashed with SIGKILL");
  EXPECT_EQ(refusal_of([] { raise(SIGFPE); }), "crashed with SIGFPE");
}

TEST(Isolate, NamesTheCodeOfAnExit) {
  EXPECT_EQ(refusal_of([] { _exit(3); }), "ended with code 3");
}

TEST(Isolate, EndsWhatHangs) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(refusal_of([] { std::this_thread::sleep_for(1h); }, 0.2s), "no answer within 0.2 s");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s);
}

TEST(Isolate, PassesErrorsOn) {
  EXPECT_EQ(refusal_of([] { throw LimitError("too large"); }), "too large");
  EXPECT_EQ(refusal_of([] { throw std::bad_alloc(); }), "not enough memory for this scene");
  EXPECT_EQ(refusal_of([] { throw std::out_of_range("what"); }), "what");
  EXPECT_THROW(refusal_of([] { throw InputError("sphere 3"); }), InputError);
}

TEST(Isolate, LeavesNoProcessAndNoDescriptorBehind) {
  const int before = dup(0);  // the lowest descriptor that is free
  close(before);
  for (int round = 0; round < 20; ++round) {
    ASSERT_EQ(refusal_of([] { _exit(1); }), "ended with code 1") << round;
  }
  const int after = dup(0);
  close(after);
  EXPECT_EQ(after, before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(Isolate, SaysWhatIsOverTheCandidateLimit) {
  const Scene scene = generate("identical:n=1000");
  const Implementation how = implementations("fcl_naive").front();
  PlanOptions options = how.plan_options();
  options.candidate_limit = 1000;
  const FinderAnswer answer = find_isolated(how.backend->create, scene.view(), options, 30s);
  EXPECT_TRUE(answer.counts.over_candidate_limit);
  EXPECT_EQ(answer.counts.candidates, 499500U);
  EXPECT_TRUE(answer.pairs.empty());
}

}  // namespace
}  // namespace octocell
