// SPDX-License-Identifier: MIT
#include "tests/fuzz/scene_of_bytes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/overlap.hpp"

namespace octocell::fuzz {
namespace {

/// Takes bytes from the front; returns zeros when there are no more.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  [[nodiscard]] bool empty() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }
  int signed_byte() { return static_cast<std::int8_t>(byte()); }
  std::uint32_t word() {
    std::uint32_t word = 0;
    for (int k = 0; k < 4; ++k) word |= std::uint32_t{byte()} << (8 * k);
    return word;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Clears a bit of the exponent of infinities and NaNs, so that they become finite.
float finite(std::uint32_t bits) {
  const bool is_finite = ((bits >> 23) & 0xffU) != 0xffU;
  return std::bit_cast<float>(is_finite ? bits : bits & ~(1U << 23));
}

float clamped(double value) {
  return static_cast<float>(std::clamp<double>(value, -kFloatMax, kFloatMax));
}

float nudged(float value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, kFloatMax);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -kFloatMax);
  return value;
}

/// What all spheres of a scene share: a unit of length and an offset from the origin.
struct Frame {
  double unit;
  double offset;
};

Frame read_frame(Reader& in) {
  constexpr std::array kOffsets = {0.0, 0.0,  1e4,  1e6,  0x1p24,          0x1p24 + 2,
                                   1e8, 1e10, 1e20, -1e7, 0.5 * kFloatMax, -1e38};
  const double unit = std::ldexp(1.0 + (in.byte() & 15) / 16.0, std::min(in.signed_byte(), 120));
  return {unit, kOffsets[in.byte() % kOffsets.size()]};
}

Sphere raw_bits(Reader& in, const Frame&) {
  const float x = finite(in.word());
  const float y = finite(in.word());
  const float z = finite(in.word());
  return {x, y, z, std::fabs(finite(in.word()))};
}

/// Sets only the upper half of each float: any exponent, few digits.
Sphere half_words(Reader& in, const Frame&) {
  const auto number = [&in] {
    const std::uint32_t low = in.byte();
    return finite((std::uint32_t{in.byte()} << 8 | low) << 16);
  };
  const float x = number();
  const float y = number();
  const float z = number();
  return {x, y, z, std::fabs(number())};
}

/// Uses whole numbers of units: ties everywhere.
Sphere on_a_lattice(Reader& in, const Frame& frame) {
  const auto number = [&] { return clamped(in.signed_byte() * frame.unit); };
  const float x = number();
  const float y = number();
  const float z = number();
  return {x, y, z, clamped((in.byte() & 31) * 0.5 * frame.unit)};
}

/// Puts coordinates a few ulps off a multiple of the diameter, near the offset.
Sphere at_a_border(Reader& in, const Frame& frame) {
  const auto number = [&] {
    const int place = in.signed_byte();
    return nudged(clamped(frame.offset + (place >> 3) * frame.unit), (place & 7) - 3);
  };
  const float x = number();
  const float y = number();
  const float z = number();
  return {x, y, z, nudged(clamped(0.5 * frame.unit), in.byte() % 3)};
}

/// Uses two places, and radii over many scales.
Sphere in_two_places(Reader& in, const Frame& frame) {
  const int kind = in.byte();
  const double centre = kind % 2 == 0 ? 0.0 : frame.offset;
  const auto number = [&] { return clamped(centre + in.signed_byte() / 16.0 * frame.unit); };
  const float x = number();
  const float y = number();
  const float z = number();
  return {x, y, z, clamped(std::ldexp(frame.unit, (kind >> 1) % 64 - 48))};
}

using ReadSphere = Sphere (*)(Reader&, const Frame&);
constexpr ReadSphere kKinds[] = {raw_bits, half_words, on_a_lattice, at_a_border, in_two_places};

/// Returns a side so large that no sphere meets more than a few thousand cells.
std::optional<double> cell_side(std::span<const Sphere> spheres, std::uint8_t choice) {
  if (choice < 128) return std::nullopt;
  double widest = 0.0;
  for (const Sphere& s : spheres) {
    widest = std::max({widest, std::fabs(double{s.x}), std::fabs(double{s.y}),
                       std::fabs(double{s.z}), double{s.r}});
  }
  const double side = 2.0 * widest / (1 + choice % 16);
  if (!(side > 0.0)) return std::nullopt;
  return side;
}

}  // namespace

FuzzScene scene_of(std::span<const std::uint8_t> bytes) {
  Reader in(bytes);
  const ReadSphere read = kKinds[in.byte() % std::size(kKinds)];
  const std::uint8_t choice = in.byte();
  const std::uint8_t ways = in.byte();
  const Frame frame = read_frame(in);
  FuzzScene scene;
  while (!in.empty() && scene.spheres.size() < kMostSpheres) {
    scene.spheres.push_back(read(in, frame));
  }
  scene.cell_side = cell_side(scene.spheres, choice);
  scene.threads = 1 + ways % 2;
  scene.no_room = (ways & 2) != 0;
  return scene;
}

}  // namespace octocell::fuzz
