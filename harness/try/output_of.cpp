// SPDX-License-Identifier: MIT
#include "harness/try/output_of.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <tuple>

#include "core/error.hpp"

namespace octocell::hand_in {
namespace {

constexpr std::size_t kMostText = 65536;

[[noreturn]] void become(char* const* command, int output) {
  setpgid(0, 0);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execvp(command[0], command);
  const char* const reason = std::strerror(errno);
  std::ignore = write(STDERR_FILENO, reason, std::strlen(reason));
  _exit(127);
}

}  // namespace

Output output_of(const std::vector<std::string>& command, std::chrono::duration<double> limit) {
  using Clock = std::chrono::steady_clock;
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  std::array<int, 2> ends = {};
  const bool has_pipe = pipe2(ends.data(), O_CLOEXEC) == 0;
  const pid_t id = has_pipe ? fork() : -1;
  if (id < 0) throw LimitError(fmt::format("no child process: {}", std::strerror(errno)));
  if (id == 0) become(words.data(), ends[1]);
  close(ends[1]);

  Output output = {0, false, {}};
  const auto deadline = Clock::now() + limit;
  for (;;) {
    pollfd readable = {ends[0], POLLIN, 0};
    if (poll(&readable, 1, 100) > 0) {
      std::array<char, 4096> buffer = {};
      const ssize_t got = ::read(ends[0], buffer.data(), buffer.size());
      if (got <= 0) break;
      const std::size_t room = kMostText - std::min(kMostText, output.text.size());
      output.text.append(buffer.data(), std::min(room, static_cast<std::size_t>(got)));
    }
    output.timed_out = Clock::now() > deadline;
    if (output.timed_out) break;
  }
  close(ends[0]);
  if (output.timed_out) kill(-id, SIGKILL);
  int status = 0;
  while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  output.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  return output;
}

}  // namespace octocell::hand_in
