// SPDX-License-Identifier: MIT
#include "harness/files/validate.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace octocell {
namespace {

template <class AnySphere>
std::string flaw_of_any(const AnySphere& s) {
  const struct {
    char name;
    decltype(s.x) value;
  } numbers[] = {{'x', s.x}, {'y', s.y}, {'z', s.z}, {'r', s.r}};
  for (const auto& [name, value] : numbers) {
    if (!std::isfinite(value)) return fmt::format("{} is {} (must be finite)", name, value);
    if (!std::isfinite(static_cast<float>(value))) {
      return fmt::format("{} is {} (float32 ends at 3.4e38)", name, value);
    }
  }
  return s.r >= 0 ? "" : fmt::format("r is {} (must be >= 0)", s.r);
}

template <class AnySphere>
void validate_any(std::span<const AnySphere> spheres, std::string_view source) {
  if (spheres.size() > kMaxSpheres) {
    throw InputError(
        fmt::format("{}: {} spheres (at most {})", source, spheres.size(), kMaxSpheres));
  }
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const std::string flaw = flaw_of(spheres[i]);
    if (!flaw.empty()) throw InputError(fmt::format("{}: sphere {}: {}", source, i, flaw));
  }
}

}  // namespace

std::string flaw_of(const Sphere& sphere) { return flaw_of_any(sphere); }
std::string flaw_of(const DoubleSphere& sphere) { return flaw_of_any(sphere); }

void validate(std::span<const Sphere> spheres, std::string_view source) {
  validate_any(spheres, source);
}
void validate(std::span<const DoubleSphere> spheres, std::string_view source) {
  validate_any(spheres, source);
}

}  // namespace octocell
