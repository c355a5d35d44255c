// SPDX-License-Identifier: MIT
// One source for host and device: the predicate and the cell formula are compiled by both.
#pragma once

#include "core/ieee754.hpp"

#ifdef __CUDACC__
#define OCTOCELL_HD __host__ __device__ inline
#else
#define OCTOCELL_HD inline
#endif
