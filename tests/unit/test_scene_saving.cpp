// SPDX-License-Identifier: MIT
// Files: how they are written, and that a failed write leaves nothing behind.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "harness/files/deferred_signals.hpp"
#include "harness/files/load.hpp"
#include "harness/files/save.hpp"
#include "harness/scenes/scenes.hpp"
#include "tests/support/scene_folder.hpp"

namespace octocell {
namespace {

class SceneSaving : public SceneFiles {
 protected:
  /// Saving fails with a message that names the path and holds `reason`.
  void expect_failure(const std::string& file, const std::string& reason) const {
    try {
      save_scene(file, scene_.spheres);
      ADD_FAILURE() << file << " was written, expected: " << reason;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("cannot write " + file), std::string::npos) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message;
    }
  }

  Scene scene_ = generate("gas:n=10000");
};

TEST_F(SceneSaving, SceneIsLoadedBitForBit) {
  for (const char* spec : {"poly:n=1000", "poly:n=0", "poly:n=1", "shifted:n=77"}) {
    const Scene scene = generate(spec);
    save_scene(path("scene.npy"), scene.spheres);
    const Scene loaded = load_scene(path("scene.npy"));
    ASSERT_EQ(loaded.spheres.size(), scene.spheres.size());
    EXPECT_TRUE(std::equal(
        scene.spheres.begin(), scene.spheres.end(), loaded.spheres.begin(),
        [](const Sphere& a, const Sphere& b) { return std::memcmp(&a, &b, sizeof a) == 0; }));
  }
  EXPECT_EQ(files_in_folder(), 1U);
}

TEST_F(SceneSaving, PairsAreUnsignedRows) {
  const Pair pairs[] = {{0, 1}, {7, 0xfffffffU}};
  save_pairs(path("pairs.npy"), pairs);
  const std::string bytes = content(path("pairs.npy"));
  ASSERT_EQ(bytes.size(), 128U + sizeof pairs);
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\0", 8));
  const std::string dictionary = "{'descr': '<u4', 'fortran_order': False, 'shape': (2, 2), }";
  EXPECT_EQ(bytes.substr(10, dictionary.size()), dictionary);
  EXPECT_EQ(bytes[127], '\n');
  EXPECT_EQ(bytes.substr(128), bytes_of(0U, 1U, 7U, 0xfffffffU));
}

/// Four in a row, at distances 0.5, 1 and 0.
const Sphere kRow[] = {{0, 0, 0, 0.5F}, {0.5F, 0, 0, 0.5F}, {1.5F, 0, 0, 0.5F}, {1.5F, 0, 0, 0.5F}};

TEST_F(SceneSaving, DepthsAreAListOfFloatsBesideThePairs) {
  const Pair pairs[] = {{0, 1}, {1, 2}, {2, 3}};
  save_depths(path("depths.npy"), kRow, pairs, path("pairs.npy"));
  const std::string bytes = content(path("depths.npy"));
  ASSERT_EQ(bytes.size(), 128U + 3 * sizeof(float));
  const std::string dictionary = "{'descr': '<f4', 'fortran_order': False, 'shape': (3,), }";
  EXPECT_EQ(bytes.substr(10, dictionary.size()), dictionary);
  EXPECT_EQ(bytes.substr(128), std::string("\0\0\0\x3f\0\0\0\0\0\0\x80\x3f", 12));
  const std::string both = content(path("pairs.npy"));
  save_pairs(path("pairs.npy"), pairs);
  EXPECT_EQ(both, content(path("pairs.npy")));
  save_depths(path("alone.npy"), kRow, pairs);
  EXPECT_EQ(content(path("alone.npy")), bytes);
  EXPECT_EQ(files_in_folder(), 3U);
}

TEST_F(SceneSaving, DepthsOfManyPairsAreWrittenInTheirOrder) {
  constexpr std::size_t kPairs = 100'000;  // more than are computed at a time
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < kPairs; ++k) pairs.push_back({0, k % 3 == 0 ? 1U : 2U});
  save_depths(path("depths.npy"), kRow, pairs);
  const std::string bytes = content(path("depths.npy"));
  ASSERT_EQ(bytes.size(), 128U + kPairs * sizeof(float));
  for (std::size_t k = 0; k < kPairs; ++k) {
    float depth = 0.0F;
    std::memcpy(&depth, &bytes[128 + k * sizeof depth], sizeof depth);
    ASSERT_EQ(depth, k % 3 == 0 ? 0.5F : -0.5F) << k;
  }
}

TEST_F(SceneSaving, DepthsAndPairsAppearBothOrNot) {
  const Pair pairs[] = {{0, 1}};
  for (const std::string& bad : {path("absent/pairs.npy"), path("pairs.txt"), path("same.npy")}) {
    EXPECT_THROW(save_depths(path("same.npy"), kRow, pairs, bad), InputError) << bad;
    EXPECT_THROW(
        save_depths(bad == path("same.npy") ? path("x.txt") : bad, kRow, pairs, path("same.npy")),
        InputError)
        << bad;
    EXPECT_EQ(files_in_folder(), 0U) << bad;
  }
}

TEST_F(SceneSaving, FullDeviceIsAnErrorAndStaysADevice) {
  expect_failure("/dev/full", "No space left on device");
  struct stat status = {};
  ASSERT_EQ(stat("/dev/full", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
  EXPECT_NO_THROW(save_scene("/dev/null", scene_.spheres));
}

TEST_F(SceneSaving, PlaceThatCannotBeWrittenIsAnError) {
  expect_failure(path("absent/scene.npy"), "No such file or directory");
  expect_failure(folder_.string(), "Is a directory");
  expect_failure(write("file", "x") + "/scene.npy", "Not a directory");
  expect_failure(path("scene.txt"), "the name must end in .npy or .csv");
  expect_failure(path(std::string(300, 'x') + ".npy"), "File name too long");
  EXPECT_EQ(files_in_folder(), 1U);
  if (geteuid() == 0) return;  // root may write everywhere
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  expect_failure(path("scene.npy"), "Permission denied");
  fs::permissions(folder_, fs::perms::owner_all);
  fs::permissions(write("kept.npy", "precious"), fs::perms::owner_read);
  expect_failure(path("kept.npy"), "Permission denied");
}

/// Lets files grow to so many bytes only, as a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_ = {};
  void (*handler_)(int);
};

TEST_F(SceneSaving, FailureInTheMiddleLeavesNothingAndKeepsTheOldFile) {
  const std::string old_file = write("old.npy", "precious");
  {
    const FileSizeLimit limit(100000);  // the scene needs 160128 bytes
    expect_failure(path("new.npy"), "File too large");
    expect_failure(old_file, "File too large");
  }
  EXPECT_EQ(content(old_file), "precious");
  EXPECT_EQ(files_in_folder(), 1U);
}

volatile std::sig_atomic_t signals_seen = 0;

TEST(DeferredSignals, TakeEffectAtTheEndAndOnce) {
  const auto before = std::signal(SIGTERM, [](int) { signals_seen = signals_seen + 1; });
  signals_seen = 0;
  {
    const DeferredSignals deferred;
    std::raise(SIGTERM);
    EXPECT_EQ(signals_seen, 0);
  }
  EXPECT_EQ(signals_seen, 1);
  { const DeferredSignals nothing_happens; }
  EXPECT_EQ(signals_seen, 1);
  std::signal(SIGTERM, before);
}

TEST_F(SceneSaving, OldFileIsReplacedAndKeepsItsPermissionsAndLinks) {
  const std::string target = write("target.npy", "old");
  fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink("target.npy", path("link.npy"));
  save_scene(path("link.npy"), scene_.spheres);
  EXPECT_TRUE(fs::is_symlink(path("link.npy")));
  EXPECT_EQ(load_scene(target).spheres.size(), scene_.spheres.size());
  EXPECT_EQ(fs::status(target).permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  EXPECT_EQ(files_in_folder(), 2U);
}

}  // namespace
}  // namespace octocell
