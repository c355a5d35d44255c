// SPDX-License-Identifier: MIT
// Decides which pairs that meet in a cell count there. It is called only for pairs that may
// overlap. So a branch on the rule, which is the same for all threads, costs less than a kernel for
// each rule.
#pragma once

#include <cstdint>

#include "core/as_written.hpp"
#include "impl_cuda_custom/device.cuh"

namespace octocell::cuda_custom {

/// An entry of a cell as stage 5 sees it, with the radius that the test uses.
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
  float text_side;  // cell side of rule as_written

  [[nodiscard]] __device__ bool may_be_row(const Member& a) const {
    return every_pair || rule == Rule::lowest_cell || !a.is_phantom();
  }

  [[nodiscard]] __device__ bool counts_here(const Member& a, const Member& b) const {
    if (every_pair) return true;
    // The cell must be the lowest that both spheres meet; on each axis, it is the lowest cell of
    // one of them (Dittrich and Seeger, ICDE 2000, reference point method).
    if (rule == Rule::lowest_cell) return ((a.object | b.object) & kLowestMask) == kLowestMask;
    if (rule == Rule::chapter32) {  // a row is a home, so the type of its home is the type of the
                                    // cell
      const chapter32::ControlBits row = control_bits[a.id()];
      return chapter32::tests_pair_here(row & 7U, row, control_bits[b.id()]);
    }
    // As written in the text: two homes, or a home and a phantom if the phantom's home id is
    // larger.
    return !b.is_phantom() || text_home(b) > text_home(a);
  }

 private:
  [[nodiscard]] __device__ std::uint32_t text_home(const Member& m) const {
    return as_written::hash(as_written::home(m.sphere, text_side));
  }
};

}  // namespace octocell::cuda_custom
