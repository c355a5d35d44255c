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
    is_valid_ = false;
  }
  [[nodiscard]] bool is_valid() const { return is_valid_; }
  void forget() { is_valid_ = false; }

  void take(SceneView scene, Threads& threads);
  /// Copies some spheres again; the others have not changed.
  void update(SceneView scene, std::span<const std::uint32_t> changed);

  /// Lists the spheres that differ; stops when there are more than `most`.
  void list_changed(SceneView scene, Threads& threads, std::uint64_t most,
                    SharedList<std::uint32_t>& changed) const;

 private:
  Buffer<Sphere> copy_;
  bool is_valid_ = false;
};

}  // namespace octocell::cpu::coherence
