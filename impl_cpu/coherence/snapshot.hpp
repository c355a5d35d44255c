// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/sphere.hpp"
#include "impl_cpu/shared_list.hpp"
#include "impl_cpu/threads.hpp"

namespace octocell::cpu::coherence {

/// A copy of the spheres whose pairs are stored. If all bytes are equal, so are the pairs. (A hash
/// would take less memory, but prove nothing.)
class Snapshot {
 public:
  void allocate(std::uint64_t sphere_count) {
    copy_.allocate(sphere_count);
    is_kept_ = false;
  }
  [[nodiscard]] bool is_kept() const { return is_kept_; }
  void forget() { is_kept_ = false; }

  void keep(SceneView scene, Threads& threads);
  /// Updates the copy for some spheres; the others have not changed.
  void keep(SceneView scene, std::span<const std::uint32_t> changed);

  /// Lists the spheres that differ; stops when there are more than `most`.
  void list_changed(SceneView scene, Threads& threads, std::uint64_t most,
                    SharedList<std::uint32_t>& changed) const;

 private:
  Buffer<Sphere> copy_;
  bool is_kept_ = false;
};

}  // namespace octocell::cpu::coherence
