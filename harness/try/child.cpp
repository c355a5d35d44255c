// SPDX-License-Identifier: MIT
#include "harness/try/child.hpp"

#include <fcntl.h>
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
#include <cstring>
#include <tuple>
#include <utility>

#include "core/text.hpp"
#include "harness/try/process_tree.hpp"

namespace octocell::hand_in {
namespace {

constexpr std::size_t kShownOutput = 2000;
constexpr int kCannotStart = 127;
constexpr int kWatchMilliseconds = 20;

struct Pipe {
  int to_read = -1;
  int to_write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> ends = {};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw LimitError(fmt::format("no child process: pipe: {}", std::strerror(errno)));
  return {ends[0], ends[1]};
}

/// Moves the descriptors to where the protocol expects them and closes all others; then becomes the
/// program. Only calls what is allowed between fork and exec.
[[noreturn]] void become(char* const* command, pid_t parent, int questions, int answers,
                         int output) {
  setpgid(0, 0);
  for (const int number :
       {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGPIPE, SIGINT, SIGXFSZ}) {
    std::signal(number, SIG_DFL);
  }
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (getppid() != parent) _exit(1);
  // First out of the way of 0 to 4, then to their places.
  constexpr int kFree = 20;
  const int q = fcntl(questions, F_DUPFD, kFree);
  const int a = fcntl(answers, F_DUPFD, kFree);
  const int o = fcntl(output, F_DUPFD, kFree);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(o, STDOUT_FILENO);
  dup2(o, STDERR_FILENO);
  dup2(q, kQuestions);
  dup2(a, kAnswers);
  close_range(kAnswers + 1, ~0U, 0);
  execvp(command[0], command);
  const char* const reason = std::strerror(errno);
  std::ignore = write(STDERR_FILENO, reason, std::strlen(reason));
  _exit(kCannotStart);
}

}  // namespace

Child::Child(const std::vector<std::string>& command, const Limits& limits) : limits_(limits) {
  start(command);
  try {
    with_printed([&] { return receive(0, limits_.start); });
  } catch (...) {
    end_all();
    throw;
  }
}

Child::~Child() { end_all(); }

void Child::start(const std::vector<std::string>& command) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const Pipe questions = make_pipe();
  const Pipe answers = make_pipe();
  const Pipe output = make_pipe();
  adopt_orphans();
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) become(words.data(), parent, questions.to_read, answers.to_write, output.to_write);
  for (const int theirs : {questions.to_read, answers.to_write, output.to_write}) close(theirs);
  questions_ = questions.to_write;
  answers_ = answers.to_read;
  output_ = output.to_read;
  if (id_ < 0) {
    id_ = 0;
    throw LimitError(fmt::format("no child process: fork: {}", std::strerror(errno)));
  }
  for (const int ours : {questions_, output_}) fcntl(ours, F_SETFL, O_NONBLOCK);
}

Outputs Child::ask(Question question, const Inputs& arrays, std::uint64_t most_bytes,
                   std::chrono::duration<double> limit) {
  limit_ = limit;
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  for (std::size_t k = 0; k < arrays.size(); ++k) question.bytes[k] = arrays[k].size();
  return with_printed([&] {
    write_whole(std::as_bytes(std::span(&question, 1)));
    for (const std::span<const std::byte> array : arrays) write_whole(array);
    return receive(most_bytes, deadline_ - Clock::now());
  });
}

Outputs Child::with_printed(const std::function<Outputs()>& talk) {
  try {
    return talk();
  } catch (CannotJudge& failure) {
    for (int k = 0; k < 16 && output_ >= 0; ++k) take_printed();
    failure.printed = printed_;
    throw;
  }
}

Outputs Child::receive(std::uint64_t most_bytes, std::chrono::duration<double> limit) {
  if (limit_ < limit) limit_ = limit;
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  Answer answer = {};
  read_whole(std::as_writable_bytes(std::span(&answer, 1)));
  if (answer.text_bytes > kLongestText || answer.ending > Ending::failed)
    throw CannotJudge("fails", "it wrote into the pipe of its answers");
  std::string text(answer.text_bytes, ' ');
  read_whole(std::as_writable_bytes(std::span(text)));
  if (answer.ending == Ending::failed) throw CannotJudge("fails", printable(text));
  Outputs outputs;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    if (answer.bytes[k] > most_bytes) {
      throw CannotJudge("prints too much", fmt::format("it gives {} bytes; at most {} are read",
                                                       answer.bytes[k], most_bytes));
    }
    outputs[k].resize(answer.bytes[k]);
    read_whole(outputs[k]);
  }
  return outputs;
}

void Child::read_whole(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    wait_for(answers_, POLLIN);
    const ssize_t got = ::read(answers_, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) say_how_it_ended();
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void Child::write_whole(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    wait_for(questions_, POLLOUT);
    const ssize_t written = ::write(questions_, bytes.data(), bytes.size());
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written <= 0) say_how_it_ended();
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void Child::wait_for(int fd, short events) {
  for (;;) {
    std::array<pollfd, 2> polled = {pollfd{fd, events, 0}, pollfd{output_, POLLIN, 0}};
    poll(polled.data(), polled.size(), kWatchMilliseconds);
    if (polled[1].revents != 0) take_printed();
    if (printed_bytes_ > limits_.printed_bytes) {
      throw CannotJudge("prints too much",
                        fmt::format("it printed more than {} MiB", limits_.printed_bytes >> 20));
    }
    watch_memory();
    if (polled[0].revents != 0) return;
    // The pipe stays open if a process that it started holds it.
    if (has_ended()) say_how_it_ended();
    if (Clock::now() > deadline_)
      throw CannotJudge("hangs", fmt::format("no answer within {:.3g} s", limit_.count()));
  }
}

void Child::watch_memory() {
  const auto now = Clock::now();
  if (now < next_look_) return;
  next_look_ = now + std::chrono::milliseconds(kWatchMilliseconds);
  const double resident = resident_bytes(id_);
  if (resident <= limits_.memory_bytes) return;
  throw CannotJudge("out of memory",
                    fmt::format("it holds {:.1f} GiB, more than {:.1f} (--memory)",
                                resident / (1 << 30), limits_.memory_bytes / (1 << 30)));
}

bool Child::has_ended() const {
  siginfo_t info = {};
  const bool is_known =
      waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0;
  return is_known && info.si_pid != 0;
}

void Child::take_printed() {
  std::array<char, 65536> buffer;
  const ssize_t got = ::read(output_, buffer.data(), buffer.size());
  if (got == 0) close(std::exchange(output_, -1));
  if (got <= 0) return;
  printed_.append(buffer.data(), static_cast<std::size_t>(got));
  printed_bytes_ += static_cast<std::uint64_t>(got);
  if (printed_.size() > 2 * kShownOutput) printed_.erase(0, printed_.size() - kShownOutput);
}

void Child::say_how_it_ended() {
  int status = 0;
  const auto give_up = Clock::now() + std::chrono::seconds(1);
  pid_t ended = 0;
  while ((ended = waitpid(id_, &status, WNOHANG)) == 0 && Clock::now() < give_up) usleep(1000);
  if (ended != id_) throw CannotJudge("fails", "it closed the pipe of its answers");
  id_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCannotStart)
    throw CannotJudge("does not start", "its process could not be started");
  if (!WIFSIGNALED(status))
    throw CannotJudge("crashed", fmt::format("it ended with code {}", WEXITSTATUS(status)));
  const char* name = sigabbrev_np(WTERMSIG(status));
  throw CannotJudge("crashed", fmt::format("it crashed with SIG{}", name != nullptr ? name : "?"));
}

void Child::end_all() {
  if (id_ > 0) {
    kill(-id_, SIGKILL);
    kill(id_, SIGKILL);
    while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
  }
  end_orphans();
  for (int* fd : {&questions_, &answers_, &output_}) {
    if (*fd >= 0) close(std::exchange(*fd, -1));
  }
}

}  // namespace octocell::hand_in
