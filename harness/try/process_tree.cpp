// SPDX-License-Identifier: MIT
#include "harness/try/process_tree.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>
#include <vector>

namespace octocell::hand_in {
namespace {

constexpr std::size_t kMostListed = 100'000;

/// Returns the children that any thread of the process started.
std::vector<pid_t> children_of(pid_t id) {
  std::vector<pid_t> children;
  std::error_code gone;
  const std::filesystem::directory_iterator threads(fmt::format("/proc/{}/task", id), gone);
  for (auto thread = threads; !gone && thread != std::filesystem::directory_iterator();
       thread.increment(gone)) {
    std::ifstream list(thread->path() / "children");
    for (pid_t child = 0; list >> child;) children.push_back(child);
  }
  return children;
}

std::vector<pid_t> descendants_of(pid_t id) {
  std::vector<pid_t> found = children_of(id);
  for (std::size_t k = 0; k < found.size() && found.size() < kMostListed; ++k) {
    for (const pid_t child : children_of(found[k])) found.push_back(child);
  }
  return found;
}

double resident_bytes(pid_t id) {
  std::ifstream statm(fmt::format("/proc/{}/statm", id));
  double pages = 0.0;
  double resident = 0.0;
  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

TreeUse use_of(pid_t id) {
  std::vector<pid_t> processes = descendants_of(id);
  processes.push_back(id);
  TreeUse use = {0.0, processes.size()};
  for (const pid_t process : processes) use.resident_bytes += resident_bytes(process);
  return use;
}

void signal_descendants(pid_t id, int number) {
  for (const pid_t process : descendants_of(id)) kill(process, number);
}

void adopt_orphans() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

void end_descendants() {
  constexpr int kMostRounds = 2000;
  std::set<pid_t> stopped;
  for (int round = 0; round < kMostRounds; ++round) {
    // A process that is stopped starts no other one: after some rounds all are known.
    bool is_new = false;
    const std::vector<pid_t> processes = descendants_of(getpid());
    for (const pid_t process : processes) {
      if (!stopped.insert(process).second) continue;
      kill(process, SIGSTOP);
      is_new = true;
    }
    if (is_new) continue;
    if (processes.empty()) return;
    for (const pid_t process : processes) kill(process, SIGKILL);
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    stopped.clear();  // ids may be used again
    usleep(1000);
  }
}

}  // namespace octocell::hand_in
