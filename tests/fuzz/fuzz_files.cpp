// SPDX-License-Identifier: MIT
// Runs every reader of scene files on the same bytes. It must return valid spheres, or throw an
// InputError of one line that begins with the path.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/files/load_formats.hpp"

namespace octocell::fuzz {
namespace {

/// A regular file without a name.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("scene", 0)) {
    const bool whole = ::write(descriptor_, data, size) == static_cast<ssize_t>(size);
    if (!whole) std::abort();
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }
  [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

[[noreturn]] void fail(const char* reader, const std::string& what) {
  std::fprintf(stderr, "%s: %s\n", reader, what.c_str());
  std::abort();
}

void require_valid(const char* reader, const std::vector<Sphere>& spheres) {
  for (const Sphere& s : spheres) {
    const bool valid = std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) &&
                       std::isfinite(s.r) && s.r >= 0.0F;
    if (!valid) fail(reader, "accepted a sphere that is not valid");
  }
}

template <typename Load>
void try_reader(const char* reader, const std::string& path, Load load) {
  try {
    InputFile file(path);
    require_valid(reader, load(file));
  } catch (const InputError& refusal) {
    const std::string what = refusal.what();
    if (!what.starts_with(path) || what.find('\n') != std::string::npos) fail(reader, what);
  }
}

std::vector<Sphere> csv(InputFile& file) {
  Scene scene;
  load_csv(file, scene);
  if (!scene.flags.empty() && scene.flags.size() != scene.spheres.size()) {
    fail("csv", "flags of some spheres only");
  }
  return scene.spheres;
}

std::vector<Sphere> npy(InputFile& file, bool round_input) {
  Scene scene;
  load_npy(file, {.round_input = round_input}, scene);
  return scene.spheres;
}

}  // namespace
}  // namespace octocell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace octocell;
  const fuzz::MemoryFile file(data, size);
  const std::string path = file.path();
  fuzz::try_reader("csv", path, fuzz::csv);
  fuzz::try_reader("pqr", path, load_pqr);
  fuzz::try_reader("npy", path, [](InputFile& in) { return fuzz::npy(in, false); });
  fuzz::try_reader("npy, rounding", path, [](InputFile& in) { return fuzz::npy(in, true); });
  return 0;
}
