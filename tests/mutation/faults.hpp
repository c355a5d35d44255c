// SPDX-License-Identifier: MIT
// Planted faults: would the tests notice if this were wrong? Only copies of the sources, into which
// plant.py has put faults, include this file (docs/how_to/mutants.md).
//
//   OCTOCELL_FAULT(name, faulty, sound)
//
// means `faulty` if the environment variable OCTOCELL_FAULT holds that name (one of faults.toml), and
// (sound) otherwise. Kernels are always sound: a GPU backend's fault is planted in host code that
// passes arguments to a kernel.
#pragma once

#include <cstdint>

#include "tests/mutation/fault_table.hpp"  // made by plant.py

namespace octocell::faults {

enum class Fault : std::uint8_t {
  none,
#define OCTOCELL_FAULT_NAME(name, what) name,
  OCTOCELL_FAULT_TABLE(OCTOCELL_FAULT_NAME)
#undef OCTOCELL_FAULT_NAME
};

/// By the environment, before main().
extern const Fault chosen;

}  // namespace octocell::faults

#ifdef __CUDA_ARCH__
#define OCTOCELL_FAULT(name, faulty, ...) (__VA_ARGS__)
#else
#define OCTOCELL_FAULT(name, faulty, ...) \
  (::octocell::faults::chosen == ::octocell::faults::Fault::name ? (faulty) : (__VA_ARGS__))
#endif
