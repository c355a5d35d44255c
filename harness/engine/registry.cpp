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
#include "harness/engine/plugin_finder.hpp"
#include "impl_cpu/backend.hpp"
#include "impl_cuda_custom/backend.hpp"
#include "impl_thrust/backend.hpp"

namespace octocell {
namespace {

/// Fitted to the times of impl_cuda_custom's kernels on an H100 (gas, dense and poly, a million
/// spheres; home_phantom with cells of 1.5 to 6 radii, half_shell with cells of 1 to 2 diameters).
constexpr Costs kDeviceCosts = {.per_id = 0.042,
                                .per_id_and_pass = 0.018,
                                .per_candidate = 0.0037,
                                .per_run = 15e3,  // for more kernels
                                .per_row = 0.0,
                                .digit_bits = 10,
                                .shell = {.per_sphere = 0.09,
                                          .per_row = 0.0,
                                          .per_window = 0.004,
                                          .per_candidate = 0.00075,
                                          .per_probe = 0.01,
                                          .per_id = 0.0045,
                                          .per_pass = 0.006,
                                          .per_wrapped = 0.05,
                                          .in_cache = 1.0,
                                          .near_borders = false,
                                          .finer_probe = true,
                                          .sides_per_doubling = 4,
                                          .most_columns = 1}};

/// impl_thrust is written to be read: a sphere finds the rows of its neighbours by binary search.
/// Its sort always takes four passes, which are included in per_id and per_sphere.
constexpr Costs kThrustCosts = {.per_id = 53.0,
                                .per_id_and_pass = 0.0,
                                .per_candidate = 0.9,
                                .per_pair = 1.2,
                                .per_row = 0.0,
                                .digit_bits = 8,
                                .shell = {.per_sphere = 213.0,
                                          .per_row = 700.0,
                                          .per_window = 60.0,
                                          .per_candidate = 2.3,
                                          .per_probe = 470.0,
                                          .per_pass = 0.0,
                                          .in_cache = 1.0,
                                          .near_borders = false,
                                          .most_columns = 8}};

/// How many times longer the work of each method takes.
struct Factors {
  double home_phantom;
  double half_shell;
  double brute_force;
};
constexpr Costs times(Costs costs, const Factors& factors) {
  costs.per_id *= factors.home_phantom;
  costs.per_id_and_pass *= factors.home_phantom;
  costs.per_candidate *= factors.home_phantom;
  costs.per_id_of_one *= factors.home_phantom;
  costs.per_run *= factors.home_phantom;
  costs.per_pair *= factors.brute_force;
  costs.per_row *= factors.brute_force;
  ShellCosts& shell = costs.shell;
  for (double* cost : {&shell.per_sphere, &shell.per_row, &shell.per_window, &shell.per_candidate,
                       &shell.per_probe, &shell.per_id, &shell.per_pass, &shell.per_wrapped}) {
    *cost *= factors.half_shell;
  }
  return costs;
}

/// Thrust's kernels take longer than ours, most of all those that search for rows. This was
/// measured on the same machine with a hundred to a million spheres. The sort takes four passes
/// there, too. It also allocates and waits, which brute_force does not. One thread handles all
/// cells that a sphere meets.
constexpr Costs with_kernels_of_thrust(Costs costs) {
  constexpr int kPasses = 4;
  costs.digit_bits = 8;
  costs.per_id += kPasses * costs.per_id_and_pass;
  costs.shell.per_sphere += kPasses * costs.shell.per_pass;
  costs.per_id_and_pass = costs.shell.per_pass = 0.0;
  costs = times(costs, {.home_phantom = 1.56, .half_shell = 3.6, .brute_force = 0.35});
  costs.per_id_of_one = 100.0;
  costs.per_grid = 150e3;
  costs.per_run = -20e3;  // home_phantom does not search for rows
  return costs;
}
constexpr Costs kThrustDeviceCosts = with_kernels_of_thrust(kDeviceCosts);

constexpr std::array kAllPredicates = {
    Predicate::exact,    Predicate::f32,       Predicate::f32_sqrt,
    Predicate::f64,      Predicate::aabb_only, Predicate::f16_cell,
    Predicate::q16_cell, Predicate::q16_exact, Predicate::gram_f32};
constexpr std::span<const Predicate> kPlainPredicates = std::span(kAllPredicates).first<4>();

/// GPUs and Thrust read a radius together with its coordinates anyway. Their sorts are queued with
/// all passes before any digit is known; Thrust's passes cover all bits of a word.
constexpr Skips kThrustSkips = Skips::all()
                                   .without(Skip::key_bits)
                                   .without(Skip::equal_radii)
                                   .without(Skip::unchanged)
                                   .without(Skip::few_movers)
                                   .without(Skip::skin);
/// To learn whether ids are already in order, the host would have to wait: a fifteenth of every
/// search.
constexpr Skips kThrustDeviceSkips = kThrustSkips.without(Skip::sort);
constexpr Skips kCudaSkips = Skips::all().without(Skip::equal_radii).without(Skip::few_movers);

constexpr std::array kAllMethods = {Method::home_phantom, Method::half_shell, Method::brute_force};

std::optional<std::string> always_available() { return std::nullopt; }

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
    BackendInfo{.name = "impl_cpu",
                .kind = Kind::backend,
                .summary = "uniform grid and radix sort on CPU threads",
                .methods = kAllMethods,
                .predicates = kAllPredicates,
                .threaded = true,
                .why_unavailable = always_available,
                .create = cpu::make_backend},
    BackendInfo{.name = "impl_thrust",
                .kind = Kind::backend,
                .summary = on_thrust::kHostSummary,
                .methods = kAllMethods,
                .predicates = kPlainPredicates,
                .skips = kThrustSkips,
                .threaded = on_thrust::kHostThreaded,
                .why_unavailable = always_available,
                .create = on_thrust::make_host_backend,
                .costs = kThrustCosts},
    BackendInfo{.name = "impl_thrust_cuda",
                .kind = Kind::backend,
                .summary = on_thrust::kCudaSummary,
                .methods = kAllMethods,
                .predicates = kPlainPredicates,
                .skips = kThrustDeviceSkips,
                .threaded = false,
                .why_unavailable = on_thrust::why_no_cuda,
                .create = on_thrust::make_cuda_backend,
                .device = true,
                .costs = kThrustDeviceCosts},
    BackendInfo{.name = "impl_cuda_custom",
                .kind = Kind::backend,
                .summary = "uniform grid and radix sort, kernels of our own (CUDA)",
                .methods = kAllMethods,
                .predicates = kAllPredicates,
                .skips = kCudaSkips,
                .threaded = false,
                .why_unavailable = cuda_custom::why_unavailable,
                .create = cuda_custom::make_backend,
                .device = true,
                .has_device_runs = true,
                .costs = kDeviceCosts},
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
