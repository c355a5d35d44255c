// SPDX-License-Identifier: MIT
// A question about images as a scene in open space, which any finder can search. Each image of a
// sphere is enclosed by a sphere of that scene: so images that overlap are enclosed by spheres that
// overlap. The finder returns these; which of them are pairs is decided afterwards, exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/flags.hpp"
#include "core/images/periodic_box.hpp"
#include "core/sphere.hpp"
#include "impl_cpu/threads.hpp"
#include "include/octocell/box.hpp"

namespace octocell::images {

/// What is asked. Everything is borrowed.
struct Question {
  SceneView scene;
  Box box = {.vector = {}, .periodic = {false, false, false}};
  double gap = 0.0;  // added to the sum of two radii
  /// Two sets: spheres from this position on are the second, and only pairs of both count.
  std::optional<std::uint64_t> second_from = {};
  /// One number a sphere: only spheres with the same number can be a pair; or empty: all can.
  std::span<const std::uint32_t> batch = {};
};

/// Returns true if flags, sets and batches let the two be a pair.
inline bool may_pair(const Question& question, std::uint32_t i, std::uint32_t j) {
  if (!question.batch.empty() && question.batch[i] != question.batch[j]) return false;
  if (const auto from = question.second_from) return (i < *from) != (j < *from);
  const auto flags = question.scene.flags;
  return flags.empty() || may_collide(flags[i], flags[j]);
}

/// Throws InputError for a gap, a box, spheres or flags that cannot be used.
void require_valid(const Question& question);

/// A sphere moved by a number of boxes.
struct Image {
  std::uint32_t sphere;
  Shift shift;
};

/// How far places lie from the origin along an axis, in boxes.
struct Range {
  double lowest;
  double highest;
};

/// Where the images of a scene are, and which of them can be near the scene.
class Images {
 public:
  /// Chooses for each sphere the image that stands for it, its *home*; all homes lie together.
  void place(const Question& question, cpu::Threads& threads);

  /// Returns how many images besides homes the scene needs; a number beyond 2^53 is rounded.
  [[nodiscard]] double count() const { return count_; }
  /// Returns how many tests take the place of a search if each two spheres are compared directly.
  [[nodiscard]] double direct_tests() const;
  /// Returns about how many tests a search would make.
  [[nodiscard]] double search_tests() const;

  /// Writes the scene that encloses homes and images. Throws LimitError if there are too many.
  void enclose();
  [[nodiscard]] SceneView scene() const { return {spheres_, flags_}; }

  /// Returns the image at that position of the scene.
  [[nodiscard]] Image at(std::uint32_t position) const {
    const std::uint64_t homes = question_.scene.spheres.size();
    return position < homes ? Image{position, home_of(position)} : others_[position - homes];
  }
  [[nodiscard]] Shift home_of(std::uint32_t sphere) const {
    return homes_.empty() ? Shift{0, 0, 0} : homes_[sphere];
  }
  /// Returns true if the scene has this sphere as it was given.
  [[nodiscard]] bool as_given(std::uint32_t position) const {
    return exact_homes_ && position < question_.scene.spheres.size() &&
           (homes_.empty() || homes_[position] == Shift{0, 0, 0});
  }
  [[nodiscard]] const Question& question() const { return question_; }

  /// The shifts T for which sphere i, moved from its home by T boxes, may be near a place that
  /// lies `from` to `to` along each axis: T[a] is in [first[a], last[a]].
  struct Steps {
    std::int32_t first[3];
    std::int32_t last[3];
  };
  [[nodiscard]] Steps steps(std::uint32_t i, const Range (&places)[3], double other_radius) const;
  /// Calls visit(T) for all of these.
  template <typename Visit>
  void for_steps(std::uint32_t i, const Range (&places)[3], double other_radius,
                 const Visit& visit) const {
    const Steps s = steps(i, places, other_radius);
    for (std::int32_t a = s.first[0]; a <= s.last[0]; ++a) {
      for (std::int32_t b = s.first[1]; b <= s.last[1]; ++b) {
        for (std::int32_t c = s.first[2]; c <= s.last[2]; ++c) visit(Shift{a, b, c});
      }
    }
  }
  /// Returns where the home of a sphere lies along each axis.
  void place_of(std::uint32_t i, double (&along)[3]) const;

 private:
  struct Moved {
    double at[3];     // rounded
    double error[3];  // at least what rounding has changed
  };
  [[nodiscard]] Moved moved(std::uint32_t i, const Shift& shift) const;
  [[nodiscard]] Flags word_of(std::uint64_t i, bool is_static) const;
  [[nodiscard]] Sphere enclosing(std::uint32_t i, const Shift& shift) const;
  void measure();
  void choose_homes();
  void measure_homes();
  void bound_errors();
  void count_images();
  void place_batches();
  void choose_scale();

  Question question_;
  PeriodicBox box_ = {};
  cpu::Threads* threads_ = nullptr;
  double highest_[3] = {};  // of |p| on each axis of space, with its home's shift
  float r_max_ = 0.0F;
  double mean_radius_ = 0.0;
  Range range_[3] = {};   // of the homes
  double slack_[3] = {};  // what rounding may change in a comparison of places
  std::int32_t most_steps_ = 0;
  double scale_ = 1.0;  // a power of two: of the enclosing scene
  bool exact_homes_ = true;
  double count_ = 0.0;
  /// The spheres of a block that have images, and how many images these have.
  struct AtEnds {
    std::vector<std::uint32_t> spheres;
    double images = 0.0;
  };
  std::vector<AtEnds> at_ends_;
  std::vector<Shift> homes_;  // empty: all are (0, 0, 0)
  std::vector<Image> others_;
  /// By how much the scene moves each batch, so that they lie side by side.
  struct Offset {
    double along[3];
  };
  std::vector<Offset> offsets_;
  double batches_ = 1.0;
  double batches_end_ = 0.0;  // the farthest coordinate
  std::vector<Sphere> spheres_;
  std::vector<Flags> flags_;
};

/// Returns true if the first component that is not zero is positive.
constexpr bool is_positive(const Shift& s) {
  return s.a != 0 ? s.a > 0 : s.b != 0 ? s.b > 0 : s.c > 0;
}
constexpr Shift operator+(const Shift& s, const Shift& t) {
  return {s.a + t.a, s.b + t.b, s.c + t.c};
}
constexpr Shift operator-(const Shift& s, const Shift& t) {
  return {s.a - t.a, s.b - t.b, s.c - t.c};
}
constexpr Shift operator-(const Shift& s) { return {-s.a, -s.b, -s.c}; }

}  // namespace octocell::images
