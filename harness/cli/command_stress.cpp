// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "harness/bench/interrupts.hpp"
#include "harness/bench/machine.hpp"
#include "harness/bench/result_file.hpp"
#include "harness/cli/commands.hpp"
#include "harness/cli/names.hpp"
#include "harness/verify/stress/run.hpp"

namespace octocell::cli {
namespace {

using namespace stress;
using Json = nlohmann::ordered_json;

struct Options {
  std::string size = "quick";
  std::string backend = "all";
  std::vector<std::string> plugins;
  std::string filter;
  int threads = 0;
  double timeout = 10.0;  // seconds
  std::string output = "reports/out/stress.json";
  bool list = false;
};

constexpr std::string_view kSizeNames[] = {"slice", "quick", "full"};

Limits limits_for(Size size, const Options& options) {
  const auto pick = [size](auto slice, auto quick, auto full) {
    return size == Size::slice ? slice : size == Size::quick ? quick : full;
  };
  return {.threads = thread_count(options.threads),
          .candidates = pick(std::uint64_t{200'000'000}, std::uint64_t{5'000'000'000},
                             std::uint64_t{1'000'000'000'000}),
          .library_candidates = pick(std::uint64_t{20'000'000}, std::uint64_t{100'000'000},
                                     std::uint64_t{5'000'000'000}),
          .library_time = time_limit(options.timeout),
          .repetitions = pick(3, 20, 100)};
}

/// Returns everything that can run here and is not wrong by intent; "ours" leaves the libraries
/// out.
std::vector<Implementation> judged(const std::string& backend) {
  const std::string of = backend == "ours" ? "all" : backend;
  std::vector<Implementation> list = implementations(of);
  std::ranges::copy(other_predicates(of), std::back_inserter(list));
  std::erase_if(list, [&](const Implementation& how) {
    return how.negative_control() || how.backend->why_unavailable() ||
           (backend == "ours" && how.is_baseline());
  });
  if (list.empty()) throw InputError(fmt::format("--backend {}: none of it can run here", backend));
  return list;
}

std::vector<Entry> chosen(const std::string& filter) {
  std::vector<Entry> entries = catalogue();
  if (filter.empty()) return entries;
  try {
    const std::regex pattern(filter);
    std::erase_if(entries, [&](const Entry& entry) {
      return !std::regex_match(entry.id.begin(), entry.id.end(), pattern);
    });
  } catch (const std::regex_error& error) {
    throw InputError(fmt::format("--entry {}: {}", filter, error.what()));
  }
  if (entries.empty()) throw InputError(fmt::format("--entry {}: no entry of that name", filter));
  return entries;
}

int list_entries(const std::vector<Entry>& entries) {
  fmt::print("{:<4} {:<52} {:>8} {:>8} {:>9}\n", "", "spheres, about", "slice", "quick", "full");
  for (const Entry& entry : entries) {
    fmt::print("{:<4} {:<52} ", entry.id, entry.name);
    if (entry.cases == nullptr) {
      fmt::print("not run: {}\n", entry.not_run);
      continue;
    }
    const auto& [slice, quick, full] = entry.sizes;
    fmt::print("{:>8} {:>8} {:>9}\n", slice, quick, full);
  }
  return 0;
}

void print_rows(const Entry& entry, const std::vector<EntryResult>& rows) {
  std::size_t exact = 0;
  std::uint64_t spheres = 0;
  std::uint64_t cases = 0;
  double seconds = 0.0;
  for (const EntryResult& row : rows) {
    exact += row.status() == Status::exact ? 1 : 0;
    spheres = row.spheres;
    seconds += row.seconds;
    cases = 0;
    for (const std::uint64_t count : row.cases) cases += count;
  }
  fmt::print("{:<4} {:<52} {:>3} cases to {:>8} spheres, {:>2} of {} exact ({:.1f} s)\n", entry.id,
             entry.name, cases, spheres, exact, rows.size(), seconds);
  for (const EntryResult& row : rows) {
    if (row.status() == Status::exact || row.status() == Status::skipped) continue;
    fmt::print("     {:<40} {}{}: {}: {}\n", row.how.label(), row.failed() ? "FAILED, " : "",
               name_of(row.status()), row.worst_case, row.reason);
  }
  std::fflush(stdout);
}

void print_totals(const std::vector<Implementation>& all, const std::vector<EntryResult>& rows) {
  fmt::print("\n{:<42}", "cases");
  for (const std::string_view status : kStatusNames) fmt::print("{:>9}", status);
  fmt::print("{:>10}{:>8}{:>11}\n", "missed", "false", "duplicates");
  for (const Implementation& how : all) {
    std::array<std::uint64_t, kStatusNames.size()> cases = {};
    reference::Comparison sum;
    for (const EntryResult& row : rows) {
      if (row.how.label() != how.label()) continue;
      for (std::size_t k = 0; k < cases.size(); ++k) cases[k] += row.cases[k];
      sum.missed += row.difference.missed;
      sum.false_pairs += row.difference.false_pairs;
      sum.duplicates += row.difference.duplicates;
    }
    fmt::print("{:<42}", how.label());
    for (const std::uint64_t count : cases) fmt::print("{:>9}", count);
    fmt::print("{:>10}{:>8}{:>11}\n", sum.missed, sum.false_pairs, sum.duplicates);
  }
}

Json document_of(const Options& options, const std::vector<Entry>& entries) {
  Json context = bench::describe_build_and_machine();
  context["size"] = options.size;
  context["finished"] = false;
  Json document = {{"schema", 2},
                   {"kind", "stress"},
                   {"context", std::move(context)},
                   {"entries", Json::array()},
                   {"rows", Json::array()}};
  for (const Entry& entry : entries) document["entries"].push_back(to_json(entry));
  return document;
}

int run_stress(const Options& options) {
  const std::vector<Entry> entries = chosen(options.filter);
  if (options.list) return list_entries(entries);
  const Size size = enumerator_named<Size>("size", options.size, kSizeNames);
  const Limits limits = limits_for(size, options);
  load_plugins(options.plugins);
  const std::vector<Implementation> all = judged(options.backend);
  const bench::ResultFile file(options.output);
  file.make_folder();
  file.require_writable();
  Json document = document_of(options, entries);
  bench::listen_for_interrupts();

  std::vector<EntryResult> rows;
  for (const Entry& entry : entries) {
    if (bench::interrupted()) break;
    if (entry.cases == nullptr) {
      fmt::print("{:<4} {:<52} not run: {}\n", entry.id, entry.name, entry.not_run);
      continue;
    }
    if (entry.at(size) == 0) {
      fmt::print("{:<4} {:<52} left out at size {}\n", entry.id, entry.name, options.size);
      continue;
    }
    const std::vector<EntryResult> found = run_entry(entry, size, all, limits, bench::interrupted);
    print_rows(entry, found);
    rows.insert(rows.end(), found.begin(), found.end());
    for (const EntryResult& row : found) document["rows"].push_back(to_json(row));
    file.write(document);
  }
  print_totals(all, rows);
  document["context"]["finished"] = !bench::interrupted();
  file.write(document);

  const auto failures = std::ranges::count_if(rows, &EntryResult::failed);
  fmt::print("{} entries, {} rows, {} failures; {}\n", entries.size(), rows.size(), failures,
             printable(options.output));
  if (bench::interrupted()) return kExitInterrupted;
  return failures == 0 ? 0 : kExitWrongAnswer;
}

}  // namespace

void add_stress(CLI::App& sub, Command& command) {
  auto o = std::make_shared<Options>();
  sub.description("Check every implementation on scenes made to break broad phases");
  sub.add_option("--size", o->size, "slice (seconds), quick (minutes, default) or full (hours)");
  sub.add_option("--backend", o->backend, "A backend, a baseline, ours (no baselines), or all");
  add_plugin_option(sub, o->plugins);
  sub.add_option("--entry", o->filter, "Only entries whose ids match, such as A.* or C18");
  sub.add_option("--threads", o->threads, "Threads; 0 (default): all");
  sub.add_option("--timeout", o->timeout,
                 "Time limit of a baseline per case in seconds (default 10)");
  sub.add_option("-o,--output", o->output, "JSON to write (default reports/out/stress.json)");
  sub.add_flag("--list", o->list, "Print the entries and run none");
  sub.callback([&command, o] { command = [o] { return run_stress(*o); }; });
}

}  // namespace octocell::cli
