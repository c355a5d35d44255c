// SPDX-License-Identifier: MIT
// Google Benchmark's flags. We interpret those that choose what is measured, because rounds are
// interleaved here. We check the others first, because the library ends the program on a value that
// it cannot read.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "harness/bench/bench.hpp"

namespace octocell::bench {
namespace {

struct Flag {
  std::string_view name;
  std::string value;
};

[[noreturn]] void refuse(const Flag& flag, std::string_view wanted) {
  throw InputError(fmt::format("{}={}: must be {}", flag.name, flag.value, wanted));
}

double positive_number(const Flag& flag) {
  std::string_view digits = flag.value;
  if (!digits.empty() && digits.back() == 's')
    digits.remove_suffix(1);  // the suffix for seconds,
                              // if there is one
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !(value > 0.0) ||
      value > 1e6) {
    refuse(flag, "a positive number, at most 1e6");
  }
  return value;
}

int positive_whole_number(const Flag& flag) {
  int value = 0;
  const char* last = flag.value.data() + flag.value.size();
  const auto [end, error] = std::from_chars(flag.value.data(), last, value);
  if (error != std::errc() || end != last || value < 1) refuse(flag, "a whole number, at least 1");
  return value;
}

bool is_one_of(std::string_view value, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), value) != words.end();
}

bool truth_value(const Flag& flag) {
  if (is_one_of(flag.value, {"", "true", "1", "yes", "on"})) return true;
  if (is_one_of(flag.value, {"false", "0", "no", "off"})) return false;
  refuse(flag, "true or false");
}

/// Returns true if we interpret the flag.
bool interpret(BenchOptions& options, const Flag& flag) {
  if (flag.name == "--benchmark_filter") {
    options.filter = flag.value;
  } else if (flag.name == "--benchmark_repetitions") {
    options.rounds = positive_whole_number(flag);
  } else if (flag.name == "--benchmark_min_time") {
    options.min_time_ms = positive_number(flag) * 1e3;
  } else if (flag.name == "--benchmark_out") {
    if (flag.value.empty()) refuse(flag, "a file");
    options.output = flag.value;
  } else if (flag.name == "--benchmark_list_tests") {
    options.list_only = truth_value(flag);
  } else {
    return false;
  }
  return true;
}

/// Checks the library's other flags by the form of their values.
void check_foreign(const Flag& flag) {
  if (is_one_of(flag.name, {"--benchmark_format", "--benchmark_out_format"})) {
    if (!is_one_of(flag.value, {"console", "json", "csv"})) refuse(flag, "console, json or csv");
    return;
  }
  if (flag.name == "--benchmark_time_unit") {
    if (!is_one_of(flag.value, {"ns", "us", "ms", "s"})) refuse(flag, "ns, us, ms or s");
    return;
  }
  if (is_one_of(flag.name,
                {"--benchmark_enable_random_interleaving", "--benchmark_report_aggregates_only",
                 "--benchmark_display_aggregates_only", "--benchmark_counters_tabular"})) {
    truth_value(flag);
    return;
  }
  if (flag.name == "--benchmark_color") {
    if (flag.value != "auto") truth_value(flag);
    return;
  }
  if (flag.name == "--benchmark_min_warmup_time") {
    positive_number(flag);
    return;
  }
  throw InputError(fmt::format("unknown argument '{}'", flag.name));
}

}  // namespace

void take_benchmark_flags(BenchOptions& options, std::vector<std::string> arguments) {
  std::string program = "octocell";
  std::vector<char*> foreign = {program.data()};
  for (std::string& argument : arguments) {
    const std::size_t equals = argument.find('=');
    const Flag flag = {std::string_view(argument).substr(0, equals),
                       equals == std::string::npos ? "" : argument.substr(equals + 1)};
    if (interpret(options, flag)) continue;
    check_foreign(flag);
    foreign.push_back(argument.data());
  }
  int count = static_cast<int>(foreign.size());
  foreign.push_back(nullptr);
  benchmark::Initialize(&count, foreign.data());
  if (count > 1) throw InputError(fmt::format("unknown argument '{}'", foreign[1]));
}

}  // namespace octocell::bench
