// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "impl_cpu/stages.hpp"

namespace octocell::cpu::coherence {

/// A neighbor list (Verlet 1967, Computer "experiments" on classical fluids): those that would
/// overlap if every radius were larger by h, half of the skin. As long as no sphere is further than
/// h from where it was then, and no radius has changed, pairs that overlap are among them:
/// |p - q| <= r + r' now implies |p - q| <= (r + h) + (r' + h) then.
/// Static spheres are expected to stand: theirs do not grow, and not a bit of them may change.
class NeighborList {
 public:
  void allocate(const Workspace& whole);
  [[nodiscard]] bool are_known() const { return are_known_; }
  void forget() { are_known_ = false; }
  /// Whether no sphere can break a fact of the plan as long as the list holds.
  [[nodiscard]] bool imply_facts() const { return imply_facts_; }

  /// What stages 2 to 4 work on: all spheres, grown by half the skin if they are not static.
  void grow(const Workspace& whole, float half_skin);
  Workspace& workspace() { return grown_; }

  /// Stage 5, the search. False: the list is too long to be of use.
  bool find(Workspace& whole);

  /// Stage 1, of later frames: fetches what has moved, and proves that the list still holds.
  bool still_hold(const Workspace& whole);

  /// Stage 5: which neighbor pairs overlap now?
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

  bool are_known_ = false;
  bool imply_facts_ = false;
  float half_skin_ = 0.0F;
  Buffer<Sphere> spheres_;  // grown, except for the static ones
  Workspace grown_;         // its pairs are numbers in the order of the columns: neighbours in
                            // space are neighbours in memory
  std::vector<std::uint32_t> places_;   // 0, 1, 2 ...: what pairs are told by
  std::vector<Flags> flags_;            // in that order, as they were when the list was made
  std::vector<std::uint32_t> movable_;  // where there are flags: the places in that order of those
                                        // that are not static
  std::vector<Object> movable_ids_;     // and their numbers in the scene
  Buffer<Sphere> then_;                 // of those that may move, when the list was made
  Buffer<Sphere> now_;
};

}  // namespace octocell::cpu::coherence
