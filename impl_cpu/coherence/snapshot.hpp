// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/sphere.hpp"
#include "impl_cpu/shared_list.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::cpu::coherence {

/// The spheres whose pairs are stored, byte for byte: equal bytes have equal pairs. (A hash would
/// take less room and prove nothing.)
class Snapshot {
 public:
  void allocate(std::uint64_t sphere_count) {
    copy_.allocate(sphere_count);
    is_kept_ = false;
  }
  [[nodiscard]] bool is_kept() const { return is_kept_; }
  void forget() { is_kept_ = false; }

  void keep(SceneView scene, Threads& threads);
  /// The same for some of them, when the others have not changed.
  void keep(SceneView scene, std::span<const std::uint32_t> changed);

  /// Lists the spheres that differ, and stops once there are more than `most` of them.
  void list_changed(SceneView scene, Threads& threads, std::uint64_t most,
                    SharedList<std::uint32_t>& changed) const;

 private:
  Buffer<Sphere> copy_;
  bool is_kept_ = false;
};

}  // namespace octocell::cpu::coherence
