// SPDX-License-Identifier: MIT
// What the judge and the process of a hand-in say to each other, through two pipes. The process
// says hello when it is ready (an Answer without arrays). Then it reads a Question with its arrays,
// and writes an Answer, and so on until there are no more questions. An answer is only arrays, or
// the text of an error: the verdict is the judge's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace octocell::hand_in {

/// The descriptors in the process of a hand-in.
inline constexpr int kQuestions = 3;
inline constexpr int kAnswers = 4;

/// What a hand-in defines: the whole broad phase, or one stage. The names are those of the
/// functions, which a process gets as its last argument.
enum class Function : std::uint8_t { find_pairs, cell_ids, sort, cell_index, pair_tests };
inline constexpr std::array<std::string_view, 5> kFunctionNames = {"find_pairs", "cell_ids", "sort",
                                                                   "cell_index", "pair_tests"};
constexpr std::string_view name_of(Function function) {
  return kFunctionNames[static_cast<std::size_t>(function)];
}
constexpr std::optional<Function> function_named(std::string_view name) {
  for (std::size_t k = 0; k < kFunctionNames.size(); ++k) {
    if (kFunctionNames[k] == name) return static_cast<Function>(k);
  }
  return std::nullopt;
}

/// The arrays follow, as octocell_plugin.h and octocell_stage.h have them:
///   find_pairs  spheres                            answer: pairs, two int64 each
///   cell_ids    spheres, grid                      answer: ids, objects
///   sort        ids, objects                       answer: ids, objects
///   cell_index  ids, objects                       answer: cells
///   pair_tests  spheres, ids, objects, cells       answer: pairs, two int64 each
inline constexpr std::size_t kMostInputs = 4;
inline constexpr std::size_t kMostOutputs = 2;
struct Question {
  std::uint64_t capacity = 0;  // of a list, to begin with
  std::uint64_t most = 0;      // entries of a list; more are refused
  std::uint64_t key_bits = 0;  // for sort
  std::uint64_t is_timed = 0;  // 1: by the shared memories of board.hpp; nothing follows but a byte
  std::uint64_t timed_spheres = 0;
  std::uint64_t bytes[kMostInputs] = {};
};

/// A timed question: the process prepares and says that it is ready. Then it reads this byte, finds
/// the pairs, and says that it is done.
inline constexpr char kGo = 'g';

enum class Ending : std::uint32_t { arrays, failed };

/// The text follows, then the arrays.
struct Answer {
  Ending ending;
  std::uint32_t text_bytes;
  std::uint64_t bytes[kMostOutputs];
};

inline constexpr std::uint32_t kLongestText = 4096;

}  // namespace octocell::hand_in
