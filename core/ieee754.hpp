// SPDX-License-Identifier: MIT
// What the proofs assume of the compiler: each operation follows IEEE 754, as written, in its own
// precision, with subnormal numbers. Every file includes this header, so no file can be compiled
// otherwise.
#pragma once

#include <cfloat>

// Refuses -ffast-math, its parts as g++ names them (clang++ names only the first two), and the
// macro that older nvcc versions define for -use_fast_math. Newer nvcc versions define none, so
// CMakeLists.txt checks their flags.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||                     \
    defined(__NO_SIGNED_ZEROS__) || defined(__USE_FAST_MATH__)
#error "Octocell's answers are exact; -ffast-math would void the proofs in docs/exactness.md."
#endif

static_assert(FLT_EVAL_METHOD == 0, "float and double must be evaluated in their own precision");
