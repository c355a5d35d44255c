// SPDX-License-Identifier: MIT
// Reads made-up trees of /proc and /sys files, with both versions of control groups.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "tests/support/scene_folder.hpp"

namespace octocell {
namespace {

class AvailableMemory : public SceneFiles {
 protected:
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    SceneFiles::write(name, text);
  }
  void write_meminfo(const std::string& kilobytes) {
    write("proc/meminfo", "MemTotal:  99999999 kB\nMemFree: 1 kB\nMemAvailable:  " + kilobytes +
                              " kB\nBuffers: 2 kB\n");
  }
  [[nodiscard]] double bytes() const { return available_bytes(folder_).value_or(-1.0); }
};

TEST_F(AvailableMemory, IsUnknownWhereNothingTells) {
  EXPECT_EQ(available_bytes(folder_), std::nullopt);
}

TEST_F(AvailableMemory, IsTheMachinesWithoutLimits) {
  write_meminfo("1000");
  EXPECT_EQ(bytes(), 1024000.0);
  write("proc/self/cgroup", "0::/\n");
  EXPECT_EQ(bytes(), 1024000.0);
}

TEST_F(AvailableMemory, IsWhatVersion2Leaves) {
  write_meminfo("1000");
  write("proc/self/cgroup", "0::/outer/inner\n");
  const std::string inner = "sys/fs/cgroup/outer/inner/";
  write(inner + "memory.max", "500000\n");
  write(inner + "memory.current", "200000\n");
  EXPECT_EQ(bytes(), 300000.0);
  write(inner + "memory.stat", "anon 100\ninactive_file 50000\nactive_file 7\n");
  EXPECT_EQ(bytes(), 350000.0) << "what was cached of files is given back";
  write("sys/fs/cgroup/outer/memory.max", "400000\n");
  write("sys/fs/cgroup/outer/memory.current", "390000\n");
  EXPECT_EQ(bytes(), 10000.0) << "the group around it counts, too";
  write("sys/fs/cgroup/outer/memory.current", "490000\n");
  EXPECT_EQ(bytes(), 0.0);
  write("sys/fs/cgroup/outer/memory.max", "max\n");
  write(inner + "memory.max", "max\n");
  EXPECT_EQ(bytes(), 1024000.0);
}

TEST_F(AvailableMemory, IsWhatVersion1Leaves) {
  write_meminfo("1000");
  write("proc/self/cgroup", "8:pids:/a\n4:memory:/a/b\n3:cpu,cpuacct:/\n0::/\n");
  const std::string group = "sys/fs/cgroup/memory/a/b/";
  write(group + "memory.limit_in_bytes", "9223372036854771712\n");
  write(group + "memory.usage_in_bytes", "100\n");
  EXPECT_EQ(bytes(), 1024000.0) << "as good as no limit";
  write(group + "memory.limit_in_bytes", "700000\n");
  EXPECT_EQ(bytes(), 699900.0);
  write(group + "memory.stat", "cache 50\ntotal_inactive_file 40\n");
  EXPECT_EQ(bytes(), 699940.0);
}

TEST_F(AvailableMemory, IsReadInAContainerThatSeesItsOwnGroupAsTheRoot) {
  write_meminfo("1000");
  write("proc/self/cgroup", "4:hugetlb,memory:/docker/0123456789abcdef\n");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "5000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1000\n");
  EXPECT_EQ(bytes(), 4000.0);
}

TEST_F(AvailableMemory, IsNotMisreadFromBrokenFiles) {
  write("proc/meminfo", "MemAvailable: many kB\n");
  write("proc/self/cgroup", "nonsense\n1:memory\n::\n4:memory:/a\n");
  write("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "");
  EXPECT_EQ(available_bytes(folder_), std::nullopt);
}

TEST(RequireMemory, RefusesInWords) {
  EXPECT_NO_THROW(require_memory(1.0, "a sphere"));
  try {
    require_memory(0x1p63, "the universe");
    FAIL() << "accepted";
  } catch (const LimitError& refusal) {
    const std::string words = refusal.what();
    EXPECT_EQ(words.find("the universe: 8589934592.0 GiB are needed, and "), 0U) << words;
  }
}

TEST(AppendWithinMemory, AppendsAsPushBackDoes) {
  std::vector<int> list;
  for (int k = 0; k < 100'000; ++k) append_within_memory(list, k, "numbers");
  ASSERT_EQ(list.size(), 100'000U);
  for (int k = 0; k < 100'000; ++k) ASSERT_EQ(list[static_cast<std::size_t>(k)], k);
}

}  // namespace
}  // namespace octocell
