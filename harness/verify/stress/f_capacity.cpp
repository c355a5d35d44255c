// SPDX-License-Identifier: MIT
// F. Capacity: buffers, sizes around powers of two, counts and keys that need more than 32 bits.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/verify/stress/make.hpp"

namespace octocell::stress {
namespace {

std::vector<Case> buffers(std::size_t n) {
  return {{.name = "dense", .spheres = scene("dense", n)},
          {.name = "lattice", .spheres = scene("lattice", n)},
          {.name = "identical", .spheres = scene("identical", std::min<std::size_t>(n, 500))}};
}

std::vector<Case> sizes(std::size_t n) {
  std::vector<Case> cases;
  for (const std::size_t size :
       {0,    1,    2,    3,    31,   32,   33,   63,   64,   65,    255,   256,   257,
        1023, 1024, 1025, 2047, 2048, 2049, 4095, 4096, 4097, 65535, 65536, 65537, (1 << 24) + 1}) {
    if (size > n) break;
    cases.push_back({.name = std::to_string(size), .spheres = scene("dense", size)});
  }
  for (const std::size_t size : {0, 1, 2, 1024, 1025, 2049}) {
    if (size > n) break;
    cases.push_back({.name = std::to_string(size) + " in one cell",
                     .spheres = Spheres(size, {0, 0, 0, 0.5F}),
                     .pair_count = std::uint64_t{size} * (size - (size > 0 ? 1 : 0)) / 2});
  }
  return cases;
}

/// Makes n (n - 1) / 2 just larger than 2^31 and 2^32, as far as n spheres allow.
std::vector<Case> pair_counts(std::size_t n) {
  std::vector<Case> cases;
  for (const std::size_t size : {std::size_t{1000}, std::size_t{65537}, std::size_t{92683}}) {
    if (size > n) break;
    cases.push_back({.name = std::to_string(size) + " identical",
                     .spheres = Spheres(size, {0, 0, 0, 0.5F}),
                     .pair_count = std::uint64_t{size} * (size - 1) / 2});
  }
  return cases;
}

/// Makes boxes of 2^31, 2^32, 2^33 and 2^45 cells, with spheres on both sides of each multiple of
/// 2^32.
std::vector<Case> key_bits(std::size_t n) {
  std::vector<Case> cases;
  for (const int bits : {30, 31, 32, 33, 45, 62}) {
    const int x_bits = bits / 3;
    const int y_bits = (bits - x_bits) / 2;
    const int z_bits = bits - x_bits - y_bits;
    Random random(34);
    Spheres spheres = repeated(n, [&](std::size_t) {
      const auto place = [&](int axis_bits) {
        const double end = std::ldexp(1.0, axis_bits);
        const double where = random.below(2) == 0 ? 0.0 : end;
        return static_cast<float>(where + step(random, 6) * 0.5);
      };
      const float x = place(x_bits);
      const float y = place(y_bits);
      return Sphere{x, y, place(z_bits), 0.5F};
    });
    cases.push_back({.name = std::to_string(bits) + " bits",
                     .spheres = std::move(spheres),
                     .cell_sides = {1.0}});
  }
  return cases;
}

/// The limits of other programs: 1024 and 10240 objects, 32766 handles of 16 bits.
std::vector<Case> limits_of_others(std::size_t n) {
  std::vector<Case> cases;
  for (const std::size_t size : {1024, 1025, 10240, 10241, 32766, 32767, 65537}) {
    if (size > n) break;
    cases.push_back({.name = std::to_string(size), .spheres = scene("gas", size)});
  }
  return cases;
}

constexpr Entry kCapacity[] = {
    {"F31",
     "room for all pairs, for one less, for none",
     {500, 5000, 100000},
     buffers,
     Ask::buffers},
    {"F32", "0, 1, 2 spheres, and around powers of two", {1025, 4097, (1 << 24) + 1}, sizes},
    {"F33",
     "more than 2^31 and 2^32 pairs, counted",
     {1000, 65537, 92683},
     pair_counts,
     Ask::count},
    {"F34", "boxes of 2^30 to 2^62 cells", {400, 2000, 50000}, key_bits},
    {"F35", "more objects than others' limits", {1025, 32767, 65537}, limits_of_others},
};

}  // namespace

std::span<const Entry> capacity() { return kCapacity; }

}  // namespace octocell::stress
