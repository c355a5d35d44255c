// SPDX-License-Identifier: MIT
// The two backends that are made for speed, one for each kind of processor: those of the library.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "harness/engine/backend_info.hpp"
#include "harness/engine/costs.hpp"
#include "impl_cpu/backend.hpp"
#include "impl_cuda_custom/backend.hpp"

namespace octocell {

inline constexpr std::array kAllPredicates = {
    Predicate::exact,    Predicate::f32,       Predicate::f32_sqrt,
    Predicate::f64,      Predicate::aabb_only, Predicate::f16_cell,
    Predicate::q16_cell, Predicate::q16_exact, Predicate::gram_f32};
inline constexpr std::array kCudaMethods = {Method::home_phantom, Method::half_shell,
                                            Method::brute_force, Method::tiles};
/// Those of the other backends.
inline constexpr std::span<const Method> kMethodsOfAll = std::span(kCudaMethods).first<3>();

inline std::optional<std::string> always_available() { return std::nullopt; }

inline const BackendInfo kImplCpu = {.name = "impl_cpu",
                                     .kind = Kind::backend,
                                     .summary = "uniform grid and radix sort on CPU threads",
                                     .methods = kMethodsOfAll,
                                     .predicates = kAllPredicates,
                                     .threaded = true,
                                     .why_unavailable = always_available,
                                     .create = cpu::make_backend};

/// GPUs read a radius together with its coordinates anyway. Their sort is queued with all passes
/// before any digit is known.
inline constexpr Skips kCudaSkips =
    Skips::all().without(Skip::equal_radii).without(Skip::few_movers);

inline const BackendInfo kImplCudaCustom = {
    .name = "impl_cuda_custom",
    .kind = Kind::backend,
    .summary = "uniform grid and radix sort, kernels of our own (CUDA)",
    .methods = kCudaMethods,
    .predicates = kAllPredicates,
    .skips = kCudaSkips,
    .threaded = false,
    .why_unavailable = cuda_custom::why_unavailable,
    .create = cuda_custom::make_backend,
    .device = true,
    .has_device_runs = true,
    .costs = kDeviceCosts};

}  // namespace octocell
