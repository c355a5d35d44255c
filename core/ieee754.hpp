// SPDX-License-Identifier: MIT
// What the proofs assume of the compiler: each operation of IEEE 754, as written, in its own
// precision, with subnormal numbers. Included by everything, so that nothing can be compiled else.
#pragma once

#include <cfloat>

// -ffast-math, its parts as g++ names them (clang++ names the first two only), and what older
// nvcc's say of -use_fast_math; of newer ones' CMakeLists.txt looks at the flags.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) ||                     \
    defined(__NO_SIGNED_ZEROS__) || defined(__USE_FAST_MATH__)
#error "Octocell's answers are exact; -ffast-math would void the proofs in docs/exactness.md."
#endif

static_assert(FLT_EVAL_METHOD == 0, "float and double must be evaluated in their own precision");
