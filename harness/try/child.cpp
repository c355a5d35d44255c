// SPDX-License-Identifier: MIT
#include "harness/try/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <grp.h>
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
constexpr int kFirstUser = 1'500'000'000;  // of users that no system has
constexpr rlim_t kMostTasks = 1024;        // threads count, too: libraries start one for each core

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

/// If this is root, becomes a user that no one else is: no files, no other processes, and a limit
/// on processes that binds. Stays root if that user could not read the hand-in.
void drop_privileges(char* const* reads) {
  if (geteuid() != 0) return;
  const auto nobody = static_cast<uid_t>(kFirstUser + getpid());
  if (setegid(nobody) != 0 || seteuid(nobody) != 0) return;
  bool can_read = true;
  for (; *reads != nullptr; ++reads)
    can_read = can_read && faccessat(AT_FDCWD, *reads, R_OK, AT_EACCESS) == 0;
  if (seteuid(0) != 0 || setegid(0) != 0) _exit(1);
  if (!can_read || setgroups(0, nullptr) != 0) return;
  if (setresgid(nobody, nobody, nobody) != 0 || setresuid(nobody, nobody, nobody) != 0) _exit(1);
  const rlimit most = {kMostTasks, kMostTasks};
  setrlimit(RLIMIT_NPROC, &most);
}

/// What the process gets at the descriptors from 3 up, in this order; -1: nothing.
using Descriptors = std::array<int, 4>;

/// Moves the descriptors to where the protocol expects them and closes all others; then becomes the
/// program. `reads`: see drop_privileges(); null: it keeps its user. Only calls what is allowed
/// between fork and exec.
[[noreturn]] void become(char* const* command, char* const* reads, pid_t parent,
                         const Descriptors& given, int output) {
  setpgid(0, 0);
  for (const int number :
       {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGPIPE, SIGINT, SIGXFSZ}) {
    std::signal(number, SIG_DFL);
  }
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  if (reads != nullptr) drop_privileges(reads);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (getppid() != parent) _exit(1);
  // First out of the way of 0 to 6, then to their places.
  constexpr int kFree = 20;
  Descriptors free = given;
  for (int& fd : free) fd = fd < 0 ? -1 : fcntl(fd, F_DUPFD, kFree);
  const int o = fcntl(output, F_DUPFD, kFree);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(o, STDOUT_FILENO);
  dup2(o, STDERR_FILENO);
  int place = kQuestions;
  for (const int fd : free) {
    if (fd >= 0) dup2(fd, place++);
  }
  close_range(static_cast<unsigned>(place), ~0U, 0);
  execvp(command[0], command);
  const char* const reason = std::strerror(errno);
  std::ignore = write(STDERR_FILENO, reason, std::strlen(reason));
  _exit(kCannotStart);
}

std::vector<char*> as_arguments(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

}  // namespace

Child::Child(const Program& program, const Limits& limits, const Board* board) : limits_(limits) {
  start(program, board);
  try {
    with_printed([&] { return receive(0, limits_.start); });
  } catch (...) {
    end_all();
    throw;
  }
}

Child::~Child() { end_all(); }

void Child::start(const Program& program, const Board* board) {
  const std::vector<char*> words = as_arguments(program.command);
  const std::vector<char*> reads = as_arguments(program.reads);
  const Pipe questions = make_pipe();
  const Pipe answers = make_pipe();
  const Pipe output = make_pipe();
  adopt_orphans();
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) {
    const Descriptors given = {questions.to_read, answers.to_write,
                               board != nullptr ? board->spheres_fd() : -1,
                               board != nullptr ? board->pairs_fd() : -1};
    become(words.data(), program.may_change_user ? reads.data() : nullptr, parent, given,
           output.to_write);
  }
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

std::chrono::duration<double> Child::time(const Question& question,
                                          const std::function<void()>& show,
                                          std::chrono::duration<double> limit) {
  std::chrono::duration<double> taken = {};
  with_printed([&] {
    go_on();
    ask(question, {}, 0, limit);  // until it is ready
    stop();
    show();
    limit_ = limit;
    deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
    write_whole(std::as_bytes(std::span(&kGo, 1)));
    const auto begin = Clock::now();
    go_on();
    Outputs none = receive(0, limit);
    taken = Clock::now() - begin;
    stop();
    return none;
  });
  return taken;
}

void Child::stop() {
  kill(-id_, SIGSTOP);
  siginfo_t info = {};
  waitid(P_PID, static_cast<id_t>(id_), &info, WSTOPPED | WEXITED | WNOWAIT);
  signal_descendants(id_, SIGSTOP);
}

void Child::go_on() {
  signal_descendants(id_, SIGCONT);
  kill(-id_, SIGCONT);
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
    watch();
    if (polled[0].revents != 0) return;
    // The pipe stays open if a process that it started holds it.
    if (has_ended()) say_how_it_ended();
    if (Clock::now() > deadline_)
      throw CannotJudge("hangs", fmt::format("no answer within {:.3g} s", limit_.count()));
  }
}

void Child::watch() {
  const auto now = Clock::now();
  if (now < next_look_) return;
  next_look_ = now + std::chrono::milliseconds(kWatchMilliseconds);
  const TreeUse use = use_of(id_);
  if (use.processes > limits_.processes) {
    throw CannotJudge("too many processes", fmt::format("it has {} processes, more than {}",
                                                        use.processes, limits_.processes));
  }
  if (use.resident_bytes <= limits_.memory_bytes) return;
  throw CannotJudge("out of memory",
                    fmt::format("it holds {:.1f} GiB, more than {:.1f} (--memory)",
                                use.resident_bytes / (1 << 30), limits_.memory_bytes / (1 << 30)));
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
  end_descendants();
  for (int* fd : {&questions_, &answers_, &output_}) {
    if (*fd >= 0) close(std::exchange(*fd, -1));
  }
}

}  // namespace octocell::hand_in
