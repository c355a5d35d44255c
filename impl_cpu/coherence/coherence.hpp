// SPDX-License-Identifier: MIT
// What one frame may take over from the last (docs/decisions/0016-frame-coherence.md).
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
  everything,  // as if there had been no frame before
  nothing,     // no sphere has changed: the pairs stand
  movers,      // pairs of spheres that have not moved stand
  new_list,    // everything, with a skin: neighbor pairs are found, and of them those that overlap
  neighbor_list,  // no sphere has left the skin: pairs are among the near ones
};

/// For plans that move, with method half_shell, that store their pairs; for others it does nothing.
class Coherence {
 public:
  /// Another plan: nothing is known any more.
  void reset(const Workspace& w);
  /// Something else than spheres has changed.
  void forget();

  /// Before stage 1. Returns true if no sphere changed since the pairs in w were found.
  bool nothing_changed(Workspace& w);
  /// Before stage 1, too. True: its facts hold, as no sphere has moved far, and neighbor pairs
  /// serve.
  bool list_is_valid(Workspace& w);
  /// After stage 1.
  void choose_mode(Workspace& w);
  /// What stages 2 to 4 work on.
  Workspace& ordered_now(Workspace& w);
  /// Stage 5.
  void pair_tests(Workspace& w);
  /// After stage 6.
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
  SharedList<std::uint32_t> changed_;  // since the frame before
  Movers movers_;
  NeighborList near_;
  SkinWidth skin_;
};

}  // namespace octocell::cpu::coherence
