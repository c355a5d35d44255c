// SPDX-License-Identifier: MIT
// The text after a generator's name: `n=1e5,seed=7`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scenes/scenes.hpp"

namespace octocell {

/// The values of all parameters of one generator.
class Parameters {
 public:
  /// Sets all parameters to their presets.
  explicit Parameters(const SceneInfo& scene);
  /// Throws InputError if a parameter is unknown, given twice, not a number or out of range.
  Parameters(const SceneInfo& scene, std::string_view text);

  /// Return a parameter; `name` must be in the generator's table.
  [[nodiscard]] double real(std::string_view name) const;
  [[nodiscard]] std::uint64_t whole(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const;

  /// Returns `name=value,...`; parsing that gives the same values.
  [[nodiscard]] std::string spelt_out() const;

 private:
  void assign(const SceneInfo& scene, std::string_view assignment, std::vector<bool>& given);

  std::span<const ParameterInfo> infos_;
  std::vector<double> values_;  // [infos_.size()]
};

}  // namespace octocell
