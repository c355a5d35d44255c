// SPDX-License-Identifier: MIT
// Vectors of numbers for SIMD, from the standard library.
#pragma once

#include <cstdint>

// GCC 12 warns about vectors that its own header leaves undefined (GCC bug 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <experimental/simd>
#pragma GCC diagnostic pop

namespace octocell {

namespace stdx = std::experimental;

template <typename Number, std::uint32_t count>
using Vector = stdx::simd<Number, stdx::simd_abi::deduce_t<Number, count>>;

}  // namespace octocell
