// SPDX-License-Identifier: MIT
// Planted faults: would the tests notice if this line were wrong?  (docs/how_to/mutants.md)
//
//   OCTOCELL_FAULT(name, faulty, sound)  is  (sound)
//
// and nothing else, but in the build made for that question (OCTOCELL_FAULTS=ON). There it is
// `faulty` when the environment variable OCTOCELL_FAULT has that name of fault_table.hpp. Kernels
// are sound in either: a fault of a device's backend sits where the host hands over arguments.
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
