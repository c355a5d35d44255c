// SPDX-License-Identifier: MIT
#include "harness/files/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "harness/files/load.hpp"

namespace octocell {

std::vector<std::string> frame_files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool is_array = name.ends_with(".npy") || name.ends_with(".npy.gz");
    if (is_array && !name.starts_with('.')) files.push_back(entry.path().string());
  }
  if (error) throw InputError(fmt::format("{}: {}", folder, error.message()));
  if (files.empty()) throw InputError(fmt::format("{}: holds no frames (*.npy)", folder));
  std::ranges::sort(files, [](const std::string& a, const std::string& b) {
    return ::strverscmp(a.c_str(), b.c_str()) < 0;
  });
  return files;
}

Frames load_frames(const std::string& folder) {
  Frames frames;
  for (const std::string& file : frame_files(folder)) frames.push_back(load_scene(file).spheres);
  return frames;
}

Frames load_trajectory(const std::string& folder) {
  Frames frames = load_frames(folder);
  const std::size_t count = frames.front().size();
  const auto other = std::ranges::find_if(
      frames, [count](const std::vector<Sphere>& frame) { return frame.size() != count; });
  if (other == frames.end()) return frames;
  const std::vector<std::string> files = frame_files(folder);
  throw InputError(fmt::format(
      "{}: {} spheres, but the first frame has {}; spheres that move must keep their number",
      files[static_cast<std::size_t>(other - frames.begin())], other->size(), count));
}

}  // namespace octocell
