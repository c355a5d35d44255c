// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "impl_cpu/stages.hpp"

namespace octocell::cpu::coherence {

/// The spheres that have moved since all spheres were last put in order. The order of the others is
/// still right.
///
/// Two spheres that are not movers are where they were then, so their pairs are kept. Pairs with a
/// mover are dropped and found again: the movers pass through stages 2 to 4 by themselves, and
/// stage 5 tests them against one another and against the spheres that have not moved.
class Movers {
 public:
  void allocate(const Workspace& whole);

  /// Starts without movers; call if all spheres have just been put in order, or will be in this
  /// frame.
  void start();
  void forget() { others_stand_ = false; }
  [[nodiscard]] bool others_stand() const { return others_stand_; }

  /// Returns the most movers; with more, putting all spheres in order again is cheaper.
  [[nodiscard]] std::uint64_t most() const { return most_; }

  /// Adds spheres that differ from the last frame. Returns false if there are too many movers.
  bool add(std::span<const std::uint32_t> changed);
  /// Prepares the input of stages 2 to 4: all movers, where they are now.
  void gather(const Workspace& whole);
  Workspace& workspace() { return moved_; }

  /// Runs stage 5.
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
  std::uint64_t taken_out_ = 0;          // so many movers are already taken out of the old order
  Buffer<std::uint32_t> movers_;         // [most]: their ids
  std::vector<std::uint64_t> is_mover_;  // one bit per sphere
  std::vector<std::uint64_t> standing_;  // for each block of pairs: how many are kept
  Buffer<Sphere> now_;                   // [most]
  Workspace moved_;
};

}  // namespace octocell::cpu::coherence
