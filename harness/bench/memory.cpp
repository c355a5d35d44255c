// SPDX-License-Identifier: MIT
#include "harness/bench/memory.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"
#include "harness/bench/bench.hpp"
#include "harness/engine/find_completely.hpp"
#include "harness/files/load.hpp"
#include "harness/scenes/scenes.hpp"

extern char** environ;

namespace octocell::bench {
namespace {

/// Returns a line of /proc/self/status in bytes; 0 if it is not there.
std::uint64_t status_bytes(const std::string& field) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    std::uint64_t kilobytes = 0;
    if (word == field + ":" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

/// Resets VmHWM to the memory that is resident now (proc(5), clear_refs).
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Runs this program again with `arguments` and returns its output; empty on failure.
std::string output_of_self(std::vector<std::string> arguments) {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
  posix_spawn_file_actions_addclose(&actions, pipe_ends[1]);

  std::string self = "/proc/self/exe";
  std::vector<char*> argv = {self.data()};
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawn(&child, self.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);

  std::string output;
  std::array<char, 4096> buffer;
  for (ssize_t got = 0; !failed && (got = read(pipe_ends[0], buffer.data(), buffer.size())) > 0;) {
    output.append(buffer.data(), static_cast<std::size_t>(got));
  }
  close(pipe_ends[0]);
  int status = 1;
  if (!failed) waitpid(child, &status, 0);
  return status == 0 ? output : std::string();
}

}  // namespace

std::optional<std::uint64_t> peak_bytes(const RowSpec& row, const Group& group) {
  std::vector<std::string> arguments = {"measure-memory", group.argument,
                                        "--row",          row.how.label(),
                                        "--threads",      std::to_string(row.threads)};
  std::ranges::copy(words_of(group.load), std::back_inserter(arguments));
  const std::string output = output_of_self(arguments);
  const nlohmann::json json = nlohmann::json::parse(output, nullptr, false);
  if (!json.is_object() || !json.contains("peak_bytes")) return std::nullopt;
  return json["peak_bytes"].get<std::uint64_t>();
}

int run_memory_child(const MemoryOptions& options) {
  std::vector<Implementation> all = implementations();
  std::ranges::copy(other_predicates(), std::back_inserter(all));
  const auto row = std::ranges::find(all, options.row, &Implementation::label);
  if (row == all.end()) throw InputError(fmt::format("unknown row '{}'", options.row));
  const Scene scene = load_or_generate(options.scene, options.load);
  malloc_trim(0);
  const std::uint64_t before = status_bytes("VmRSS");
  forget_peak();
  const std::unique_ptr<PairFinder> finder = row->backend->create();
  const Outcome outcome =
      find_completely(*finder, scene.view(), row->plan_options(options.threads));
  const std::uint64_t peak = status_bytes("VmHWM");
  if (before == 0 || peak == 0) throw LimitError("/proc/self/status does not report memory here");
  fmt::print("{}\n", nlohmann::json{{"peak_bytes", peak - std::min(before, peak)},
                                    {"output_bytes", outcome.counts.pairs * sizeof(Pair)}}
                         .dump());
  return 0;
}

}  // namespace octocell::bench
