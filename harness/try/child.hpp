// SPDX-License-Identifier: MIT
// The process of a hand-in, with limits. A crash, a hang or a lie there harms nothing here.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/try/board.hpp"
#include "harness/try/compile.hpp"
#include "harness/try/protocol.hpp"

namespace octocell::hand_in {

/// Why a hand-in cannot be judged: "crashed", "hangs", "out of memory", "fails", "prints too much",
/// "too many processes".
struct CannotJudge : Error {
  CannotJudge(std::string why, std::string text) : Error(std::move(text)), kind(std::move(why)) {}
  std::string kind;
  std::string printed = {};  // the end of what was printed before
};

struct Limits {
  double memory_bytes;                  // resident, of the process and of those that it started
  std::chrono::duration<double> start;  // to load the hand-in
  std::uint64_t printed_bytes = std::uint64_t{16} << 20;
  std::size_t processes = 64;  // it and those that it started, threads not counted
};

struct Options;
/// Returns the limits that the options ask for.
Limits limits_of(const Options& options);

using Bytes = std::vector<std::byte>;
using Inputs = std::vector<std::span<const std::byte>>;
using Outputs = std::array<Bytes, kMostOutputs>;

class Child {
 public:
  /// Starts the program and waits until it is ready. Throws CannotJudge; LimitError if no process
  /// can be started. `board` must outlive it; only with one can it be timed.
  Child(const Program& program, const Limits& limits, const Board* board = nullptr);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  /// Asks about the arrays, whose sizes go into the question. An answer of more than `most_bytes`
  /// is refused. Throws CannotJudge if there is no proper answer in time. Then nothing more can be
  /// asked.
  Outputs ask(Question question, const Inputs& arrays, std::uint64_t most_bytes,
              std::chrono::duration<double> limit);

  /// Asks a timed question and returns how long the answer took, by this process's clock. `show`
  /// puts the spheres where the hand-in can read them. Its processes run only until they are ready
  /// and while the clock runs: afterwards they are stopped, and what they wrote stays as it is
  /// until the next question. Throws CannotJudge.
  std::chrono::duration<double> time(const Question& question, const std::function<void()>& show,
                                     std::chrono::duration<double> limit);

 private:
  using Clock = std::chrono::steady_clock;

  void start(const Program& program, const Board* board);
  /// Stops or continues it and all that it started.
  void stop();
  void go_on();
  /// Calls `talk`; if that fails, adds what was printed.
  Outputs with_printed(const std::function<Outputs()>& talk);
  Outputs receive(std::uint64_t most_bytes, std::chrono::duration<double> limit);
  void read_whole(std::span<std::byte> bytes);
  void write_whole(std::span<const std::byte> bytes);
  /// Waits until `fd` is ready for `events`; meanwhile reads what is printed and watches the
  /// limits.
  void wait_for(int fd, short events);
  [[nodiscard]] bool has_ended() const;
  void watch();
  void take_printed();
  [[noreturn]] void say_how_it_ended();
  void end_all();

  Limits limits_;
  pid_t id_ = 0;
  int questions_ = -1;
  int answers_ = -1;
  int output_ = -1;
  std::string printed_ = {};
  std::uint64_t printed_bytes_ = 0;
  Clock::time_point deadline_ = {};
  Clock::time_point next_look_ = {};  // at its memory
  std::chrono::duration<double> limit_ = {};
};

}  // namespace octocell::hand_in
