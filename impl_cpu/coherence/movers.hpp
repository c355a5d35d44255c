// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "impl_cpu/stages.hpp"

namespace octocell::cpu::coherence {

/// The spheres that have moved since all of them were last put in order, and the order of the
/// others, which stands.
///
/// Two spheres that are not among the movers are where they were then, so their pairs stand. Pairs
/// with a mover are dropped and found again: the movers pass through stages 2 to 4 by themselves,
/// and stage 5 tests them against each other and against those that stand.
class Movers {
 public:
  void allocate(const Workspace& whole);

  /// All spheres have just been put in order, or will be in this frame: none has moved since.
  void start_anew();
  void forget() { others_stand_ = false; }
  [[nodiscard]] bool others_stand() const { return others_stand_; }

  /// More than these, and putting all in order again is cheaper.
  [[nodiscard]] std::uint64_t most() const { return most_; }

  /// These differ from the frame before. False: the movers have become too many.
  bool add(std::span<const std::uint32_t> changed);
  /// What stages 2 to 4 work on: all movers, where they are now.
  void gather(const Workspace& whole);
  Workspace& workspace() { return moved_; }

  /// Stage 5.
  void find_pairs(Workspace& whole);

 private:
  [[nodiscard]] bool has(std::uint32_t sphere) const {
    return (is_mover_[sphere / 64] >> sphere % 64 & 1U) != 0;
  }
  void drop_pairs(Workspace& whole);
  void take_out_of_order(Workspace& whole);
  void name_by_id();

  bool others_stand_ = false;
  std::uint64_t most_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t taken_out_ = 0;          // of the movers: their old places are void
  Buffer<std::uint32_t> movers_;         // [most]: their ids
  std::vector<std::uint64_t> is_mover_;  // a bit a sphere
  std::vector<std::uint64_t> standing_;  // pairs of each block that stand
  Buffer<Sphere> now_;                   // [most]
  Workspace moved_;
};

}  // namespace octocell::cpu::coherence
