// SPDX-License-Identifier: MIT
// What the tests of scene files share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/error.hpp"
#include "harness/files/load.hpp"
#include "harness/scenes/scenes.hpp"

namespace octocell {

namespace fs = std::filesystem;

/// Gives each test a folder of its own, and removes it at the end.
class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "octocell-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  static std::string content(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

  /// Expects that loading fails with a message that begins with the path and contains `reason`.
  static void expect_refusal(const std::string& file, const std::string& reason,
                             const LoadOptions& options = {}) {
    try {
      load_scene(file, options);
      ADD_FAILURE() << file << " was accepted, expected: " << reason;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(file, 0), 0U) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message << "\nexpected: " << reason;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  void expect_csv_refusal(const std::string& text, const std::string& reason) const {
    expect_refusal(write("bad.csv", text), reason);
  }

  fs::path folder_;
};

template <class... Numbers>
std::string bytes_of(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

}  // namespace octocell
