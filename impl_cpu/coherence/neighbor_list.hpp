// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "impl_cpu/stages.hpp"

namespace octocell::cpu::coherence {

/// A neighbor list (Verlet 1967, Computer "experiments" on classical fluids): the pairs that would
/// overlap if every radius were larger by h, half of the skin. As long as no sphere is further than
/// h from where it was then, and no radius has changed, all pairs that overlap are in the list: |p
/// - q| <= r + r' now implies |p - q| <= (r + h) + (r' + h) then. Static spheres are expected not
/// to move: they do not grow, and none of their bits may change.
class NeighborList {
 public:
  void allocate(const Workspace& whole);
  [[nodiscard]] bool is_valid() const { return is_valid_; }
  void forget() { is_valid_ = false; }
  /// Returns true if no sphere can break a fact of the plan as long as the list is valid.
  [[nodiscard]] bool implies_facts() const { return implies_facts_; }

  /// Prepares the input of stages 2 to 4: all spheres, enlarged by half the skin unless they are
  /// static.
  void grow(const Workspace& whole, float half_skin);
  Workspace& workspace() { return grown_; }

  /// Runs stage 5 as a search. Returns false if the list is too long to be of use.
  bool find(Workspace& whole);

  /// Stage 1 of later frames: fetches movable spheres, and proves that the list is still valid.
  bool is_valid_for(const Workspace& whole);

  /// Stage 5 of later frames: decides which neighbor pairs overlap now.
  void decide(Workspace& whole) const;

 private:
  [[nodiscard]] bool is_within_skin(const Sphere& then, const Sphere& now) const;
  void put_flags_in_order(std::span<const Flags> flags);
  void fetch_then(const Workspace& whole);
  [[nodiscard]] bool statics_stand(const Workspace& whole) const;
  template <typename Places>
  bool movable_are_near(const Workspace& whole, const Places& places);
  template <typename Places>
  bool fetch(const Workspace& whole, const Places& places, std::uint64_t begin, std::uint64_t end);
  template <PairTest test>
  void decide_block(Workspace& whole, std::span<const Pair> near) const;
  template <PairTest test>
  void decide_all(Workspace& whole) const;
  [[nodiscard]] const Object* order() const { return grown_.ids[grown_.current].objects.data(); }
  [[nodiscard]] bool some_are_static() const { return movable_.size() < flags_.size(); }
  [[nodiscard]] std::uint64_t size() const {
    return grown_.pairs.size() + grown_.uncertain_pairs.size();
  }

  bool is_valid_ = false;
  bool implies_facts_ = false;
  float half_skin_ = 0.0F;
  Buffer<Sphere> spheres_;  // enlarged, except for static ones
  Workspace grown_;  // stores pairs as numbers in column order, so neighbours in space are close in
                     // memory
  std::vector<std::uint32_t> places_;   // 0, 1, 2 ...: the ids that pairs are stored with
  std::vector<Flags> flags_;            // in column order, as they were when the list was made
  std::vector<std::uint32_t> movable_;  // if there are flags: the places of movable spheres in
                                        // column order
  std::vector<Object> movable_ids_;     // their ids in the scene
  Buffer<Sphere> then_;                 // movable spheres as they were when the list was made
  Buffer<Sphere> now_;
};

}  // namespace octocell::cpu::coherence
