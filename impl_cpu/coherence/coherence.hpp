// SPDX-License-Identifier: MIT
// What a frame may reuse from the last one (docs/decisions/0016-frame-coherence.md).
#pragma once

#include <cstdint>
#include <optional>

#include "core/frame_mode.hpp"
#include "core/planner/skin_width.hpp"
#include "core/stage.hpp"
#include "impl_cpu/coherence/motion_sample.hpp"
#include "impl_cpu/coherence/movers.hpp"
#include "impl_cpu/coherence/neighbor_list.hpp"
#include "impl_cpu/coherence/snapshot.hpp"
#include "impl_cpu/stages.hpp"

namespace octocell::cpu::coherence {

/// Works for moving plans with method half_shell that store their pairs; does nothing for others.
class Coherence {
 public:
  /// Forgets everything; for a new plan.
  void reset(const Workspace& w);
  /// Forgets all pairs; call if something other than the spheres has changed.
  void forget();

  /// Runs stage 1, as far as the frame needs it, and chooses the frame mode.
  void bounds(Workspace& w);
  /// Returns the workspace that stages 2 to 4 work on.
  Workspace& ordered_now(Workspace& w);
  /// Runs stage 5. Returns false if the frame must be searched again: its neighbor list overflowed.
  bool pair_tests(Workspace& w);
  /// Runs stage 6, and forgets what an incomplete frame found.
  void resolve(Workspace& w);

  [[nodiscard]] FrameMode mode() const { return mode_; }

 private:
  [[nodiscard]] static bool has_skin(const Workspace& w);
  [[nodiscard]] bool none_moves() const;
  [[nodiscard]] bool snapshot_pays(const Workspace& w) const;
  [[nodiscard]] bool few_movers_pay(const Workspace& w) const;
  void list_changes(const Workspace& w);
  bool is_unchanged(Workspace& w);
  bool search_movers(Workspace& w);
  bool reuse_list(Workspace& w);
  bool make_list(Workspace& w);
  void start_again(const Workspace& w);

  bool is_used_ = false;
  FrameMode mode_ = FrameMode::search;
  bool makes_list_ = false;  // this search enlarges the spheres, to list neighbor pairs
  MotionSample sample_;
  std::optional<FrameMotion> motion_;
  Snapshot snapshot_;
  bool changes_are_listed_ = false;
  SharedList<std::uint32_t> changed_;  // since the last frame
  Movers movers_;
  NeighborList list_;
  SkinWidth skin_;
};

}  // namespace octocell::cpu::coherence
