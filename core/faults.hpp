// SPDX-License-Identifier: MIT
// Planted faults: would the tests notice if this line were wrong?  (docs/how_to/mutants.md)
//
//   OCTOCELL_FAULT(name, faulty, sound)  is  (sound)
//
// means (sound) in every build except the one with OCTOCELL_FAULTS=ON. There it means `faulty` if
// the environment variable OCTOCELL_FAULT holds that name (one of fault_table.hpp). Kernels are
// always sound: a GPU backend's fault is planted in host code that passes arguments to a kernel.
#pragma once

#ifndef OCTOCELL_FAULTS

#define OCTOCELL_FAULT(name, faulty, ...) (__VA_ARGS__)

#else

#include "tests/mutation/fault_table.hpp"

#ifdef __CUDA_ARCH__
#define OCTOCELL_FAULT(name, faulty, ...) (__VA_ARGS__)
#else
#define OCTOCELL_FAULT(name, faulty, ...) \
  (::octocell::faults::chosen == ::octocell::faults::Fault::name ? (faulty) : (__VA_ARGS__))
#endif

#endif
