// SPDX-License-Identifier: MIT
#include "harness/files/load_options.hpp"

#include <utility>

#include <fmt/format.h>

namespace octocell {

std::vector<std::string> words_about_file(const LoadOptions& options) {
  std::vector<std::string> words;
  const auto add = [&words](const char* option, std::string value) {
    words.emplace_back(option);
    words.push_back(std::move(value));
  };
  if (options.format) add("--format", std::string(name_of(*options.format)));
  if (options.radius) add("--radius", fmt::format("{}", *options.radius));
  if (options.columns) add("--columns", *options.columns);
  if (options.decimal_comma) words.emplace_back("--decimal-comma");
  if (options.frame != 0) add("--frame", std::to_string(options.frame));
  if (options.drop_invalid) words.emplace_back("--drop-invalid");
  return words;
}

std::vector<std::string> words_of(const LoadOptions& options) {
  std::vector<std::string> words = words_about_file(options);
  if (options.round_input) words.emplace_back("--round-input");
  if (options.flags) words.insert(words.end(), {"--flags", *options.flags});
  return words;
}

}  // namespace octocell
