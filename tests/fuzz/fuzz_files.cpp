// SPDX-License-Identifier: MIT
// Runs every reader of scene files on the same bytes. It must return valid spheres, or throw an
// InputError of one line that begins with the path.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/files/leave_out.hpp"
#include "harness/files/load_formats.hpp"
#include "tests/support/memory_file.hpp"

namespace octocell::fuzz {
namespace {

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

using Load = void (*)(InputFile&, const LoadOptions&, Scene&);

struct Reader {
  const char* name;
  Load load;
  LoadOptions options = {};
};

const Reader kReaders[] = {
    {"table", load_table},
    {"table, points", load_table, {.radius = 1.0F}},
    {"table, named columns", load_table, {.columns = "id,x,y,z,r"}},
    {"table, decimal comma", load_table, {.decimal_comma = true}},
    {"table, valid rows", load_table, {.drop_invalid = true}},
    {"pqr", load_pqr},
    {"pqr, second frame", load_pqr, {.frame = 1}},
    {"npy", load_npy},
    {"npy, rounding", load_npy, {.round_input = true}},
    {"npy, points", load_npy, {.round_input = true, .radius = 1.0F}},
    {"npy, valid rows", load_npy, {.round_input = true, .drop_invalid = true}},
};

std::vector<Sphere> spheres_of(const Reader& reader, InputFile& file) {
  Scene scene;
  reader.load(file, reader.options, scene);
  if (!scene.flags.empty() && scene.flags.size() != scene.spheres.size()) {
    fail(reader.name, "flags of some spheres only");
  }
  if (reader.options.drop_invalid) leave_out_invalid(scene);
  return scene.spheres;
}

}  // namespace
}  // namespace octocell::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace octocell;
  const MemoryFile file(data, size);
  const std::string path = file.path();
  for (const fuzz::Reader& reader : fuzz::kReaders) {
    fuzz::try_reader(reader.name, path,
                     [&reader](InputFile& in) { return fuzz::spheres_of(reader, in); });
  }
  return 0;
}
