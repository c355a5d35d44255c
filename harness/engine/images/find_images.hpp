// SPDX-License-Identifier: MIT
// Answers a question about images: with any finder, or, for few spheres or small boxes, by
// comparing each two of them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/finder.hpp"
#include "harness/engine/images/image_scene.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::images {

/// Pairs with their shifts: |p_i - p_j + S H| <= r_i + r_j + gap. Of (i, j, S) and (j, i, -S) there
/// is the one with i < j; of (i, i, S), the one whose first component that is not zero is positive.
struct ImagePairs {
  OwnedPairs pairs;
  Buffer<Shift> shifts;
  /// What was found: pairs.count, unless pairs were only counted.
  std::uint64_t count = 0;
  std::uint64_t images = 0;  // that were searched besides the spheres
  bool compared_directly = false;
};

/// How pairs are found; `cheaper` estimates which of both that is.
enum class Way : std::uint8_t { cheaper, search, compare };

struct How {
  bool sorted = true;  // by (i, j, S); otherwise in any order
  bool count_only = false;
  Way way = Way::cheaper;
};

/// Searches a scene in open space and returns its pairs, in any order.
using Search = std::function<OwnedPairs(SceneView)>;

/// Keeps its memory and its threads from question to question.
class ImageFinder {
 public:
  explicit ImageFinder(int threads) : threads_(threads) {}

  /// Throws InputError for a question that cannot be answered, LimitError if the answer is too
  /// large.
  ImagePairs find(const Question& question, const How& how, const Search& search);

  /// Returns the scene that find() would give to `search`; none if it would compare directly.
  std::optional<SceneView> searched_scene(const Question& question, Way way = Way::cheaper);

 private:
  cpu::Threads threads_;
  Images images_;
};

}  // namespace octocell::images
