// SPDX-License-Identifier: MIT
// One source for host and device: the predicate and the cell formula are compiled by both.
#pragma once

#ifdef __FAST_MATH__
#error "Octocell's answers are exact; -ffast-math would void the proofs in docs/exactness.md."
#endif

#ifdef __CUDACC__
#define OCTOCELL_HD __host__ __device__ inline
#else
#define OCTOCELL_HD inline
#endif
