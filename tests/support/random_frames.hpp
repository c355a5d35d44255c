// SPDX-License-Identifier: MIT
// Random sequences of frames, made of everything that ever misled a finder that reuses data of the
// last frame. The same seed gives the same sequence.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/flags.hpp"
#include "core/plan.hpp"
#include "tests/support/frame_sequences.hpp"

namespace octocell {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  std::uint64_t seed() { return random_(); }
  /// Returns a number below `count`, or 0.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  /// Returns a number in [-1, 1).
  float around_zero() { return static_cast<float>(random_() >> 40) * 0x1p-23F - 1.0F; }

 private:
  std::mt19937_64 random_;
};

/// Makes a scene of `count` spheres: radii equal or not; in a box, a layer, a row or on a lattice;
/// in one place or in two that are far apart; at any scale.
inline Spheres random_scene(std::size_t count, Dice& dice) {
  const bool on_lattice = dice.one_in(4);
  const bool equal = on_lattice || dice.one_in(2);
  const bool apart = dice.one_in(6);
  const std::size_t axes = dice.one_in(4) ? 1 + dice.below(2) : 3;
  const int octaves = static_cast<int>(1 + dice.below(10));
  const auto scale = static_cast<int>(dice.one_in(4) ? dice.below(240) : 140) - 140;
  const float half_width = std::pow(static_cast<float>(count), 1.0F / static_cast<float>(axes)) *
                           (0.4F + 0.3F * static_cast<float>(dice.below(4)));
  Spheres spheres(count);
  for (Sphere& s : spheres) {
    float centre[3] = {0.0F, 0.0F, 0.0F};
    for (std::size_t a = 0; a < axes; ++a) {
      centre[a] = half_width * dice.around_zero();
      if (on_lattice) centre[a] = std::rint(centre[a]);
    }
    const float far = apart && dice.one_in(2) ? 0x1p24F : 0.0F;
    const int octave =
        equal ? -1 : -1 - static_cast<int>(dice.below(static_cast<std::size_t>(octaves)));
    s = {std::ldexp(centre[0] + far, scale), std::ldexp(centre[1] + far, scale),
         std::ldexp(centre[2] - far, scale), std::ldexp(1.0F, octave + scale)};
    if (!equal) s.r *= 1.0F + 0.4F * dice.around_zero();
  }
  return spheres;
}

/// One scene that changes from frame to frame.
class RandomFrames {
 public:
  RandomFrames(std::size_t count, std::uint64_t seed) : dice_(seed) {
    spheres_ = anchor_ = random_scene(count, dice_);
    static constexpr double kShares[] = {-1.0, -1.0, 0.0, 0.3, 0.9, 1.0};
    static_share_ = kShares[dice_.below(std::size(kShares))];
    draw_flags();
  }

  [[nodiscard]] SceneView scene() const { return {spheres_, flags_}; }
  /// Returns the name of the last change.
  [[nodiscard]] const char* event() const { return kEvents[event_].name; }
  /// Returns false if some sphere is invalid.
  [[nodiscard]] bool is_valid() const { return is_valid_; }
  /// Returns true if the next frame should come with an upload of the present plan.
  [[nodiscard]] bool is_another_scene() const {
    return kEvents[event_].happen == &RandomFrames::another_scene;
  }

  /// Notes that everything was searched in this frame, with these facts and this skin.
  void was_searched(const Plan& plan) {
    anchor_ = spheres_;
    facts_ = plan.facts;
    growth_ = plan.skin.growth;
  }

  /// Makes the next frame. A change that can continue usually continues for several frames.
  void next() {
    if (!is_valid_) {
      is_valid_ = dice_.below(3) != 0;
      if (is_valid_) spheres_ = history_.back();
      return;
    }
    history_.push_back(spheres_);
    repeats_ = dice_.one_in(3) ? 0 : repeats_ + 1;
    if (repeats_ == 0) {
      event_ = dice_.below(std::size(kEvents));
      size_of_step_ = std::ldexp(1.0F, -static_cast<int>(dice_.below(14)));
    }
    if (!spheres_.empty()) (this->*kEvents[event_].happen)();
    if (is_valid_) keep_finite();
  }

 private:
  struct Event {
    const char* name;
    void (RandomFrames::*happen)();
  };

  Sphere& any() { return spheres_[dice_.below(spheres_.size())]; }
  float& any_coordinate(Sphere& s) {
    const std::size_t axis = dice_.below(3);
    return axis == 0 ? s.x : axis == 1 ? s.y : s.z;
  }
  float ulp_from(float value) {
    return std::nextafter(value, dice_.one_in(2) ? kFloatMax : -kFloatMax);
  }
  /// Returns how many spheres change: one, a few, many, all.
  std::size_t some() {
    const std::size_t count = spheres_.size();
    const std::size_t choices[] = {1, 1 + count / 20, 1 + count / 5, count};
    return choices[dice_.below(std::size(choices))];
  }
  Sphere moved(Sphere s, float step) {
    return {s.x + step * dice_.around_zero(), s.y + step * dice_.around_zero(),
            s.z + step * dice_.around_zero(), s.r};
  }

  void stand_still() {}
  void by_ulps() {
    for (std::size_t k = some(); k > 0; --k) {
      float& value = any_coordinate(any());
      value = ulp_from(value);
    }
  }
  void creep() {
    const bool statics_too = dice_.one_in(10);
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      const bool stands = !flags_.empty() && is_static(flags_[i]) && !statics_too;
      if (!stands) spheres_[i] = moved(spheres_[i], size_of_step_ * spheres_[0].r);
    }
  }
  void drift() {
    const float step = size_of_step_ * spheres_[0].r * dice_.around_zero();
    for (Sphere& s : spheres_) s.x += step;
  }
  /// A few spheres move, and after some frames many.
  void some_move() {
    std::size_t movers = repeats_ < 4 ? 1 + spheres_.size() / 30 : spheres_.size() / 3;
    for (; movers > 0; --movers) {
      Sphere& s = any();
      s = moved(s, 2.0F * s.r);
    }
  }
  void teleport() {
    for (std::size_t k = some(); k > 0; --k) std::swap(any(), any());
  }
  void radii_by_ulps() {
    for (std::size_t k = some(); k > 0; --k) {
      Sphere& s = any();
      s.r = ulp_from(s.r);
    }
  }
  void radii_change() {
    for (std::size_t k = some(); k > 0; --k) any().r = dice_.one_in(2) ? 0.0F : any().r;
  }
  /// Spheres touch, as far as float32 allows, or nearly.
  void touch() {
    for (std::size_t k = some(); k > 0; --k) {
      const Sphere other = any();
      Sphere& s = any();
      s = {other.x + (other.r + s.r), other.y, other.z, s.r};
      if (dice_.one_in(2)) s.x = ulp_from(s.x);
    }
  }
  void collapse() {
    constexpr std::size_t kMost = 200;  // all of them become pairs
    const Sphere middle = any();
    for (std::size_t k = std::min(some(), kMost); k > 0; --k) {
      Sphere& s = any();
      const float r = s.r;
      s = moved(middle, middle.r);
      s.r = r;
    }
  }
  void go_back() {
    const Spheres& then = history_[dice_.below(history_.size())];
    if (then.size() == spheres_.size()) spheres_ = then;
  }
  void flags_in_place() {
    if (flags_.empty()) return;
    for (std::size_t k = some(); k > 0; --k) {
      const auto group = static_cast<std::uint32_t>(1 + dice_.below(3));
      flags_[dice_.below(flags_.size())] = make_flags(dice_.one_in(3), group, kMaxMask & ~group);
    }
  }
  /// Moves spheres from where they were searched by half a skin, and a float32 step more or less.
  void to_the_skin() {
    if (anchor_.size() != spheres_.size()) return;
    const float half_skin = growth_ * static_cast<float>(1 + dice_.below(8)) / 8.0F;
    const bool all = dice_.one_in(2);
    const std::size_t chosen = dice_.below(spheres_.size());
    const std::size_t axis = dice_.below(3);
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      if (!all && i != chosen) continue;
      spheres_[i] = anchor_[i];
      Sphere& s = spheres_[i];
      float& value = axis == 0 ? s.x : axis == 1 ? s.y : s.z;
      value += half_skin;
      if (!dice_.one_in(3)) value = ulp_from(value);
    }
  }
  void onto_the_box() {
    for (std::size_t k = 1 + dice_.below(3); k > 0; --k) {
      Sphere& s = any();
      float* const centre[] = {&s.x, &s.y, &s.z};
      const std::size_t axis = dice_.below(3);
      const float border = dice_.one_in(2) ? facts_.lowest[axis] : facts_.highest[axis];
      *centre[axis] = dice_.one_in(2) ? border : ulp_from(border);
    }
  }
  void no_sphere() {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Sphere& s = any();
    const std::size_t how = dice_.below(4);
    if (how == 3) {
      s.r = dice_.one_in(2) ? -std::fabs(s.r) - 1e-30F : kNan;
    } else {
      any_coordinate(s) = how == 0 ? kNan : how == 1 ? kInfinity : -kInfinity;
    }
    is_valid_ = false;
  }
  void another_size() {
    const std::size_t count = spheres_.size();
    if (dice_.one_in(2)) {
      spheres_.resize(count - dice_.below(1 + count / 4));
    } else {
      for (std::size_t k = 1 + dice_.below(1 + count / 4); k > 0; --k) spheres_.push_back(any());
    }
    draw_flags();
  }
  void another_scene() { spheres_ = random_scene(spheres_.size(), dice_); }

  static constexpr Event kEvents[] = {
      {"stand still", &RandomFrames::stand_still},
      {"by ulps", &RandomFrames::by_ulps},
      {"creep", &RandomFrames::creep},
      {"creep", &RandomFrames::creep},
      {"creep", &RandomFrames::creep},
      {"drift", &RandomFrames::drift},
      {"some move", &RandomFrames::some_move},
      {"teleport", &RandomFrames::teleport},
      {"radii by ulps", &RandomFrames::radii_by_ulps},
      {"radii change", &RandomFrames::radii_change},
      {"touch", &RandomFrames::touch},
      {"collapse", &RandomFrames::collapse},
      {"go back", &RandomFrames::go_back},
      {"flags in place", &RandomFrames::flags_in_place},
      {"to the skin", &RandomFrames::to_the_skin},
      {"onto the box", &RandomFrames::onto_the_box},
      {"no sphere", &RandomFrames::no_sphere},
      {"another size", &RandomFrames::another_size},
      {"another scene", &RandomFrames::another_scene},
  };

  void draw_flags() {
    flags_ = flags_of(spheres_.size(), static_share_, static_cast<unsigned>(dice_.below(1000)));
  }
  void keep_finite() {
    for (Sphere& s : spheres_) {
      for (float* const value : {&s.x, &s.y, &s.z, &s.r}) {
        *value = std::min(std::max(*value, -kFloatMax), kFloatMax);
      }
      s.r = std::max(s.r, 0.0F);
    }
  }

  Dice dice_;
  Spheres spheres_;
  AllFlags flags_;
  double static_share_ = -1.0;
  bool is_valid_ = true;
  std::size_t event_ = 0;
  int repeats_ = 0;
  float size_of_step_ = 0.1F;
  std::vector<Spheres> history_;  // earlier frames that are valid
  Spheres anchor_;                // when everything was searched last
  PlanFacts facts_;
  float growth_ = 0.0F;
};

}  // namespace octocell
