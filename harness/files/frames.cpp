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
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.path().extension() == ".npy") files.push_back(entry.path().string());
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
  for (const std::string& file : frame_files(folder)) {
    frames.push_back(load_scene(file).spheres);
    if (frames.back().size() == frames.front().size()) continue;
    throw InputError(fmt::format("{}: {} spheres, but the first frame has {}", file,
                                 frames.back().size(), frames.front().size()));
  }
  return frames;
}

}  // namespace octocell
