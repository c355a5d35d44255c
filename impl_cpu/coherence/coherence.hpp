// SPDX-License-Identifier: MIT
// What a frame may reuse from the last one (docs/decisions/0016-frame-coherence.md).
#pragma once

#include <cstdint>
#include <optional>

#include "core/planner/skin_width.hpp"
#include "core/stage.hpp"
#include "impl_cpu/coherence/motion_sample.hpp"
#include "impl_cpu/coherence/movers.hpp"
#include "impl_cpu/coherence/neighbor_list.hpp"
#include "impl_cpu/coherence/snapshot.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu::coherence {

/// What a frame does.
enum class FrameMode : std::uint8_t {
  everything,     // searches as if there had been no frame before
  nothing,        // no sphere has changed: keeps the pairs
  movers,         // keeps the pairs of spheres that have not moved
  new_list,       // searches with a skin: finds neighbor pairs, and among them those that overlap
  neighbor_list,  // no sphere has left the skin: tests only the neighbor pairs
};

/// Works for moving plans with method half_shell that store their pairs; does nothing for others.
class Coherence {
 public:
  /// Forgets everything; for a new plan.
  void reset(const Workspace& w);
  /// Forgets all pairs; call if something other than the spheres has changed.
  void forget();

  /// Before stage 1. Returns true if no sphere changed since the pairs in w were found.
  bool nothing_changed(Workspace& w);
  /// Also before stage 1. Returns true if the neighbor list can be reused. Its facts then hold,
  /// because no sphere has moved far.
  bool list_is_valid(Workspace& w);
  /// After stage 1: decides what this frame does.
  void choose_mode(Workspace& w);
  /// Returns the workspace that stages 2 to 4 work on.
  Workspace& ordered_now(Workspace& w);
  /// Runs stage 5.
  void pair_tests(Workspace& w);
  /// After stage 6: forgets what an incomplete frame found.
  void remember(const Workspace& w);

  [[nodiscard]] bool runs(Stage stage) const;
  [[nodiscard]] std::optional<Skip> reused() const;

 private:
  [[nodiscard]] static bool has_skin(const Workspace& w);
  [[nodiscard]] bool none_moves() const;
  [[nodiscard]] bool copy_pays(const Workspace& w) const;
  [[nodiscard]] bool repairs_pay(const Workspace& w) const;
  void list_changed(const Workspace& w);
  bool repair(Workspace& w);
  bool reuse_list(Workspace& w);
  bool make_list(Workspace& w);
  void copy_anew(const Workspace& w);
  void search_with_skin(Workspace& w);

  bool is_used_ = false;
  FrameMode mode_ = FrameMode::everything;
  MotionSample sample_;
  std::optional<FrameMotion> motion_;
  Snapshot kept_;
  bool changes_are_listed_ = false;
  SharedList<std::uint32_t> changed_;  // since the last frame
  Movers movers_;
  NeighborList near_;
  SkinWidth skin_;
};

}  // namespace octocell::cpu::coherence
