// SPDX-License-Identifier: MIT
// Marks functions that are compiled for both host and device, as the predicate and the cell formula
// are.
#pragma once

#include "core/ieee754.hpp"

#ifdef __CUDACC__
#define OCTOCELL_HD __host__ __device__ inline
#else
#define OCTOCELL_HD inline
#endif
