// SPDX-License-Identifier: MIT
#include "harness/engine/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <memory>
#include <vector>

#include "baselines/baselines.hpp"
#include "core/error.hpp"
#include "harness/engine/costs.hpp"
#include "harness/engine/fast_backends.hpp"
#include "harness/engine/plugin_finder.hpp"
#include "impl_thrust/backend.hpp"

namespace octocell {
namespace {

constexpr std::span<const Predicate> kPlainPredicates = std::span(kAllPredicates).first<4>();

/// Thrust reads a radius together with its coordinates anyway. Its sorts are queued with all passes
/// before any digit is known, and the passes cover all bits of a word.
constexpr Skips kThrustSkips = Skips::all()
                                   .without(Skip::key_bits)
                                   .without(Skip::equal_radii)
                                   .without(Skip::unchanged)
                                   .without(Skip::few_movers)
                                   .without(Skip::skin);
/// To learn whether ids are already in order, the host would have to wait: a fifteenth of every
/// search.
constexpr Skips kThrustDeviceSkips = kThrustSkips.without(Skip::sort);

BackendInfo info_of(const baselines::Baseline& baseline) {
  return {.name = baseline.name,
          .kind = Kind::baseline,
          .summary = baseline.summary,
          .methods = {},
          .predicates = {},
          .threaded = false,
          .why_unavailable = always_available,
          .create = baseline.create,
          .known_issues = baseline.known_issues};
}

const std::array kOurs = {
    kImplCpu,
    BackendInfo{.name = "impl_thrust",
                .kind = Kind::backend,
                .summary = on_thrust::kHostSummary,
                .methods = kMethodsOfAll,
                .predicates = kPlainPredicates,
                .skips = kThrustSkips,
                .threaded = on_thrust::kHostThreaded,
                .why_unavailable = always_available,
                .create = on_thrust::make_host_backend,
                .costs = kThrustCosts},
    BackendInfo{.name = "impl_thrust_cuda",
                .kind = Kind::backend,
                .summary = on_thrust::kCudaSummary,
                .methods = kMethodsOfAll,
                .predicates = kPlainPredicates,
                .skips = kThrustDeviceSkips,
                .threaded = false,
                .why_unavailable = on_thrust::why_no_cuda,
                .create = on_thrust::make_cuda_backend,
                .device = true,
                .costs = kThrustDeviceCosts},
    kImplCudaCustom,
};

constexpr std::size_t kMostPlugins = 32;

/// Has room for plug-ins, so that no entry moves when one is added.
std::vector<BackendInfo> ours_then_baselines() {
  std::vector<BackendInfo> all(kOurs.begin(), kOurs.end());
  all.reserve(all.size() + baselines::all().size() + kMostPlugins);
  for (const baselines::Baseline& baseline : baselines::all()) all.push_back(info_of(baseline));
  return all;
}

std::vector<BackendInfo>& all_backends() {
  static std::vector<BackendInfo> all = ours_then_baselines();
  return all;
}

std::string name_of_plugin(const std::string& path) {
  std::string stem = std::filesystem::path(path).stem().string();
  if (stem.starts_with("lib")) stem.erase(0, 3);
  return "plugin_" + stem;
}

}  // namespace

std::span<const BackendInfo> backends() { return all_backends(); }

const BackendInfo& add_plugin(const std::string& path) {
  static std::deque<std::string> names;  // which the entries refer to
  const std::string name = name_of_plugin(path);
  const auto refuse = [&](std::string_view why) {
    throw InputError(fmt::format("--plugin {}: {}", path, why));
  };
  if (std::ranges::find(backends(), name, &BackendInfo::name) != backends().end())
    refuse("there is a row of this name, " + name);
  if (names.size() == kMostPlugins) refuse("too many");
  std::shared_ptr<const PluginLibrary> library;
  try {
    library = std::make_shared<const PluginLibrary>(std::filesystem::absolute(path).string());
  } catch (const InputError& error) {
    refuse(error.what());
  }
  names.push_back(name);
  all_backends().push_back({.name = names.back(),
                            .kind = Kind::baseline,
                            .summary = "a plug-in",
                            .methods = {},
                            .predicates = {},
                            .threaded = false,
                            .why_unavailable = always_available,
                            .create = [library] { return make_plugin_finder(library); }});
  return all_backends().back();
}

const BackendInfo& backend_named(std::string_view name) {
  const auto found = std::ranges::find(backends(), name, &BackendInfo::name);
  if (found != backends().end()) return *found;
  std::vector<std::string_view> names;
  for (const BackendInfo& b : backends()) names.push_back(b.name);
  throw InputError(fmt::format("unknown backend '{}'; known: {}", name, fmt::join(names, ", ")));
}

PlanOptions Implementation::plan_options(int threads) const {
  return {.method = method,
          .rule = rule,
          .predicate = predicate,
          .threads = threads,
          .known = backend->skips,
          .allowed = backend->skips,
          .buffers_only = is_baseline(),
          .costs = backend->costs};
}

std::string Implementation::label() const {
  if (is_baseline()) return std::string(backend->name);
  std::string words = fmt::format("{} {}", backend->name, method_name());
  if (has_rule()) words += fmt::format(" {}", name_of(rule));
  if (predicate != Predicate::exact) words += fmt::format(" {}", name_of(predicate));
  return words;
}

std::vector<Implementation> implementations(std::string_view backend) {
  std::vector<Implementation> list;
  if (backend != "all") backend_named(backend);  // throws for an unknown name
  for (const BackendInfo& b : backends()) {
    if (backend != "all" && backend != b.name) continue;
    list.push_back({.backend = &b});
    for (const Method method : b.methods) {
      if (method != Method::home_phantom) {
        list.push_back({.backend = &b, .method = method});
        continue;
      }
      for (const Rule rule : {Rule::lowest_cell, Rule::chapter32, Rule::as_written}) {
        list.push_back({.backend = &b, .method = method, .rule = rule});
      }
    }
  }
  return list;
}

std::vector<Implementation> other_predicates(std::string_view backend) {
  std::vector<Implementation> list;
  if (backend != "all") backend_named(backend);
  for (const BackendInfo& b : backends()) {
    if (backend != "all" && backend != b.name) continue;
    for (const Predicate predicate : b.predicates) {
      if (predicate != Predicate::exact) list.push_back({.backend = &b, .predicate = predicate});
    }
  }
  return list;
}

}  // namespace octocell
