// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "harness/bench/bench.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/cli/scene_options.hpp"
#include "harness/scenes/motion.hpp"

namespace octocell::cli {

namespace {

void add_memory_child(CLI::App& app, Command& command) {
  auto o = std::make_shared<bench::MemoryOptions>();
  CLI::App& sub = *app.add_subcommand("measure-memory", "One run for the bench's memory column");
  sub.group("");  // hidden from the help: only the bench calls it
  sub.add_option("SCENE", o->scene)->required();
  add_scene_options(sub, o->load);
  sub.add_option("--row", o->row)->required();
  sub.add_option("--threads", o->threads);
  sub.callback([&command, o] { command = [o] { return bench::run_memory_child(*o); }; });
}

}  // namespace

void add_bench(CLI::App& sub, Command& command) {
  auto o = std::make_shared<bench::BenchOptions>();
  auto timeout = std::make_shared<double>(o->baseline_limit.count());
  sub.description(
      "Time every implementation; Google Benchmark's flags (--benchmark_...) work, too");
  sub.add_option("SCENE", o->scenes, "Scenes to time instead of a preset's");
  add_scene_options(sub, o->load);
  sub.add_option("--preset", o->preset,
                 "quick (minutes, default), full (an hour), gpu, frames, ablation, error or real");
  sub.add_option("--backend", o->backend, "A backend, a baseline, or all");
  sub.add_option("--motion", o->motion,
                 fmt::format("Move those scenes: {}", fmt::join(kMotionNames, ", ")));
  sub.add_option("--frames", o->frames, "Frames of a motion")->check(CLI::Range(2, 100000));
  sub.add_option("--trajectory", o->trajectory, "A folder of frames (*.npy) to time");
  sub.add_option("-o,--output", o->output, "JSON to write (default reports/out/bench.json)");
  sub.add_option("--rounds", o->rounds, "Rounds of each group")->check(CLI::Range(1, 1000000));
  sub.add_option("--timeout", *timeout,
                 "Time limit of a baseline's first run in seconds (default 60)");
  sub.add_flag("!--no-memory", o->memory, "Do not measure memory");
  sub.allow_extras();
  sub.callback([&command, o, timeout, &sub] {
    o->baseline_limit = time_limit(*timeout);
    bench::take_benchmark_flags(*o, sub.remaining());
    command = [o] { return bench::run_bench(*o); };
  });
  add_memory_child(*sub.get_parent(), command);
}

}  // namespace octocell::cli
