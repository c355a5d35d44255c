// SPDX-License-Identifier: MIT
#include "harness/scenes/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"

namespace octocell {
namespace {

std::string known_parameters(const SceneInfo& scene) {
  std::string list;
  for (const ParameterInfo& info : scene.parameters) {
    list += fmt::format("{}{} ({} to {}, default {})", list.empty() ? "" : ", ", info.name,
                        info.lowest, info.highest, info.preset);
  }
  return list;
}

[[noreturn]] void refuse(const SceneInfo& scene, std::string_view why) {
  throw InputError(
      fmt::format("scene {}: {}; it takes {}", scene.name, why, known_parameters(scene)));
}

double parse_value(const SceneInfo& scene, const ParameterInfo& info, std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) {
    refuse(scene, fmt::format("{}={} is not a number", info.name, quote(text)));
  }
  if (!(value >= info.lowest && value <= info.highest)) {
    refuse(scene, fmt::format("{}={} is out of range", info.name, text));
  }
  if (info.kind == ParameterInfo::Kind::whole && value != std::floor(value)) {
    refuse(scene, fmt::format("{}={} is not a whole number", info.name, text));
  }
  return value + 0.0;  // -0 becomes 0
}

std::size_t index_of(std::span<const ParameterInfo> infos, std::string_view name) {
  const auto found = std::find_if(infos.begin(), infos.end(),
                                  [&](const ParameterInfo& info) { return info.name == name; });
  return static_cast<std::size_t>(found - infos.begin());
}

}  // namespace

Parameters::Parameters(const SceneInfo& scene) : infos_(scene.parameters) {
  for (const ParameterInfo& info : infos_) values_.push_back(info.preset);
}

Parameters::Parameters(const SceneInfo& scene, std::string_view text) : Parameters(scene) {
  std::vector<bool> given(infos_.size());
  while (true) {
    const std::size_t comma = text.find(',');
    assign(scene, text.substr(0, comma), given);
    if (comma == std::string_view::npos) return;
    text.remove_prefix(comma + 1);
  }
}

void Parameters::assign(const SceneInfo& scene, std::string_view assignment,
                        std::vector<bool>& given) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    refuse(scene, fmt::format("{} is not of the form parameter=value", quote(assignment)));
  }
  const std::string_view name = assignment.substr(0, equals);
  const std::size_t index = index_of(infos_, name);
  if (index == infos_.size()) refuse(scene, fmt::format("no parameter {}", quote(name)));
  if (given[index]) refuse(scene, fmt::format("{} is given twice", name));
  given[index] = true;
  values_[index] = parse_value(scene, infos_[index], assignment.substr(equals + 1));
}

double Parameters::real(std::string_view name) const { return values_.at(index_of(infos_, name)); }

bool Parameters::has(std::string_view name) const { return index_of(infos_, name) < infos_.size(); }

std::uint64_t Parameters::whole(std::string_view name) const {
  return static_cast<std::uint64_t>(real(name));
}

std::string Parameters::spelt_out() const {
  std::string text;
  for (std::size_t k = 0; k < infos_.size(); ++k) {
    if (!infos_[k].spelt_if_preset && values_[k] == infos_[k].preset) continue;
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", infos_[k].name, values_[k]);
  }
  return text;
}

}  // namespace octocell
