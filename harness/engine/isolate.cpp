// SPDX-License-Identifier: MIT
#include "harness/engine/isolate.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "core/error.hpp"
#include "harness/engine/find_completely.hpp"

namespace octocell {
namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::span<const std::byte>;

enum class Ending : std::uint32_t { answer, input_error, limit_error };

/// The first data that the child sends; the text of its error, or its pairs, follow.
struct Head {
  Ending ending;
  bool over_candidate_limit;
  std::uint64_t ids, cells, candidates, uncertain_pairs, pairs;  // Counts
  PairDigest digest;
  std::uint64_t text_bytes;
  std::uint64_t pair_count;
};

/// One end of a pipe.
class End {
 public:
  explicit End(int fd) : fd_(fd) {}
  End(const End&) = delete;
  End& operator=(const End&) = delete;
  ~End() { close(); }
  void close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_;
};

/// Writes all bytes or exits: errors cannot be reported. For the child.
void write_whole(const End& pipe, Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe.fd(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

Head head_of(const Counts& counts) {
  return {.ending = Ending::answer,
          .over_candidate_limit = counts.over_candidate_limit,
          .ids = counts.ids,
          .cells = counts.cells,
          .candidates = counts.candidates,
          .uncertain_pairs = counts.uncertain_pairs,
          .pairs = counts.pairs,
          .digest = {},
          .text_bytes = 0,
          .pair_count = 0};
}

void send_error(const End& pipe, Ending ending, std::string_view text) {
  Head head = head_of({});
  head.ending = ending;
  head.text_bytes = text.size();
  write_whole(pipe, std::as_bytes(std::span(&head, 1)));
  write_whole(pipe, std::as_bytes(std::span(text)));
}

/// Makes sure that a crash ends only the child: removes the parent's signal handlers (sanitizers
/// and the command line have some) and core files, and ends the child if its parent ends.
void become_a_child(pid_t parent) {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGPIPE, SIGINT}) {
    std::signal(number, SIG_DFL);
  }
  std::set_terminate(std::abort);
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
}

void answer(const End& pipe, const std::function<std::unique_ptr<PairFinder>()>& create,
            SceneView scene, const PlanOptions& options) {
  const std::unique_ptr<PairFinder> finder = create();
  const Counts counts = find_completely(*finder, scene, options).counts;
  Head head = head_of(counts);
  std::span<const Pair> pairs;
  if (!counts.over_candidate_limit) {
    head.digest = finder->digest();
    pairs = finder->sorted_pairs();
  }
  head.pair_count = pairs.size();
  write_whole(pipe, std::as_bytes(std::span(&head, 1)));
  write_whole(pipe, std::as_bytes(pairs));
}

/// Does all work of the child. It ends by _exit(), because buffered output belongs to the parent.
[[noreturn]] void be_the_child(const End& pipe,
                               const std::function<std::unique_ptr<PairFinder>()>& create,
                               SceneView scene, const PlanOptions& options) {
  try {
    answer(pipe, create, scene, options);
  } catch (const InputError& error) {
    send_error(pipe, Ending::input_error, error.what());
  } catch (const std::bad_alloc&) {
    send_error(pipe, Ending::limit_error, "not enough memory for this scene");
  } catch (const std::exception& error) {
    send_error(pipe, Ending::limit_error, error.what());
  }
  _exit(0);
}

/// The parent's view of the child: reads its data, ends it at the deadline, and waits for it.
class Child {
 public:
  Child(pid_t id, End& pipe, std::chrono::duration<double> limit)
      : id_(id),
        pipe_(pipe),
        limit_(limit),
        deadline_(Clock::now() + std::chrono::duration_cast<Clock::duration>(limit)) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ > 0) kill(id_, SIGKILL);
    wait();
  }

  void read_whole(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
      wait_for_data();
      const ssize_t got = ::read(pipe_.fd(), bytes.data(), bytes.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw LimitError(how_it_ended());
      bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
  }

 private:
  void wait_for_data() {
    for (;;) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
      if (left.count() <= 0)
        throw LimitError(fmt::format("no answer within {:g} s", limit_.count()));
      pollfd readable = {.fd = pipe_.fd(), .events = POLLIN, .revents = 0};
      const int milliseconds = static_cast<int>(std::min<long long>(left.count(), 1'000'000));
      if (poll(&readable, 1, milliseconds) > 0) return;
    }
  }

  std::string how_it_ended() {
    const int status = wait();
    if (!WIFSIGNALED(status)) return fmt::format("ended with code {}", WEXITSTATUS(status));
    const char* name = sigabbrev_np(WTERMSIG(status));
    return fmt::format("crashed with SIG{}", name != nullptr ? name : "?");
  }

  int wait() {
    int status = 0;
    if (id_ <= 0) return status;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return status;
  }

  pid_t id_;
  End& pipe_;
  std::chrono::duration<double> limit_;
  Clock::time_point deadline_;
};

FinderAnswer receive(Child& child) {
  Head head = {};
  child.read_whole(std::as_writable_bytes(std::span(&head, 1)));
  std::string text(head.text_bytes, ' ');
  child.read_whole(std::as_writable_bytes(std::span(text)));
  if (head.ending == Ending::input_error) throw InputError(text);
  if (head.ending == Ending::limit_error) throw LimitError(text);
  require_memory(sizeof(Pair) * static_cast<double>(head.pair_count), "a copy of the pairs");
  FinderAnswer answer = {.counts = {.ids = head.ids,
                                    .cells = head.cells,
                                    .candidates = head.candidates,
                                    .uncertain_pairs = head.uncertain_pairs,
                                    .pairs = head.pairs,
                                    .over_candidate_limit = head.over_candidate_limit,
                                    .used = {}},
                         .digest = head.digest,
                         .pairs = std::vector<Pair>(head.pair_count)};
  child.read_whole(std::as_writable_bytes(std::span(answer.pairs)));
  return answer;
}

}  // namespace

FinderAnswer find_isolated(const std::function<std::unique_ptr<PairFinder>()>& create,
                           SceneView scene, const PlanOptions& options,
                           std::chrono::duration<double> limit) {
  const auto refuse = [](const char* what) {
    throw LimitError(fmt::format("no child process: {}: {}", what, std::strerror(errno)));
  };
  std::array<int, 2> ends = {};
  if (pipe(ends.data()) != 0) refuse("pipe");
  End from_child(ends[0]);
  End to_parent(ends[1]);
  const pid_t parent = getpid();
  const pid_t id = fork();
  if (id < 0) refuse("fork");
  if (id == 0) {
    become_a_child(parent);
    from_child.close();
    be_the_child(to_parent, create, scene, options);
  }
  Child child(id, from_child, limit);
  to_parent.close();
  return receive(child);
}

}  // namespace octocell
