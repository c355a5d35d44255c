// SPDX-License-Identifier: MIT
// Which pairs that meet in a cell count there. Asked only for pairs that may overlap, so that a
// branch on the rule, the same for all threads, costs less than a kernel for each rule.
#pragma once

#include <cstdint>

#include "core/as_written.hpp"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// An entry of a cell as stage 5 sees it; the radius is the test's.
struct Member {
  Sphere sphere;
  Object object;

  [[nodiscard]] __device__ std::uint32_t id() const { return object & kIdMask; }
  [[nodiscard]] __device__ bool is_phantom() const { return (object & kPhantom) != 0; }
};

struct RuleTest {
  bool every_pair;  // brute_force
  Rule rule;
  const chapter32::ControlBits* control_bits;
  float text_side;  // of as_written's cells

  [[nodiscard]] __device__ bool may_be_row(const Member& a) const {
    return every_pair || rule == Rule::lowest_cell || !a.is_phantom();
  }

  [[nodiscard]] __device__ bool counts_here(const Member& a, const Member& b) const {
    if (every_pair) return true;
    // The cell must be the lowest that both meet: on each axis, the lowest of one of them.
    // (Dittrich and Seeger, ICDE 2000, reference point method.)
    if (rule == Rule::lowest_cell) return ((a.object | b.object) & kLowestMask) == kLowestMask;
    if (rule == Rule::chapter32) {  // a row is a home, so its home's type is the cell's
      const chapter32::ControlBits row = control_bits[a.id()];
      return chapter32::tests_pair_here(row & 7U, row, control_bits[b.id()]);
    }
    // The course text: home with home; home with phantom if the phantom's home id is the larger.
    return !b.is_phantom() || text_home(b) > text_home(a);
  }

 private:
  [[nodiscard]] __device__ std::uint32_t text_home(const Member& m) const {
    return as_written::hash(as_written::home(m.sphere, text_side));
  }
};

}  // namespace octocell::cuda_custom
