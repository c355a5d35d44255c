// SPDX-License-Identifier: MIT
// What the judge and the process of a hand-in say to each other, through two pipes. The process
// says hello when it is ready (an Answer without pairs). Then it reads a Question with its spheres,
// and writes an Answer, and so on until there are no more questions. An answer is only a list of
// pairs, or the text of an error: the verdict is the judge's.
#pragma once

#include <cstdint>

namespace octocell::hand_in {

/// The descriptors in the process of a hand-in.
inline constexpr int kQuestions = 3;
inline constexpr int kAnswers = 4;

/// The spheres follow: four float32 each.
struct Question {
  std::uint64_t spheres;
  std::uint64_t capacity;    // the room to begin with
  std::uint64_t most_pairs;  // more are refused
};

enum class Ending : std::uint32_t { pairs, failed };

/// The text follows, then the pairs: two int64 each.
struct Answer {
  Ending ending;
  std::uint32_t text_bytes;
  std::uint64_t pairs;
};

inline constexpr std::uint32_t kLongestText = 4096;

}  // namespace octocell::hand_in
