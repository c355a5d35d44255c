// SPDX-License-Identifier: MIT
#include "impl_cpu/coherence/snapshot.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/same_bits.hpp"
#include "impl_cpu/block_size.hpp"

namespace octocell::cpu::coherence {
namespace {

constexpr std::uint64_t kSpheresPerBlock = block_size(4096, 16);

}  // namespace

void Snapshot::take(SceneView scene, Threads& threads) {
  const Sphere* const spheres = scene.spheres.data();
  threads.for_blocks(
      scene.spheres.size(), kSpheresPerBlock, [&](std::uint64_t begin, std::uint64_t end) {
        std::memcpy(copy_.data() + begin, spheres + begin, (end - begin) * sizeof(Sphere));
      });
  is_valid_ = true;
}

void Snapshot::update(SceneView scene, std::span<const std::uint32_t> changed) {
  for (const std::uint32_t i : changed) copy_[i] = scene.spheres[i];
}

void Snapshot::list_changed(SceneView scene, Threads& threads, std::uint64_t most,
                            SharedList<std::uint32_t>& changed) const {
  changed.clear();
  const Sphere* const spheres = scene.spheres.data();
  const auto per_block = [&](std::uint64_t begin, std::uint64_t end) {
    if (changed.size() > most) return;
    const std::size_t bytes = (end - begin) * sizeof(Sphere);
    if (std::memcmp(copy_.data() + begin, spheres + begin, bytes) == 0) return;
    std::array<std::uint32_t, kSpheresPerBlock> found;
    std::size_t count = 0;
    for (std::uint64_t i = begin; i < end; ++i) {
      found[count] = static_cast<std::uint32_t>(i);
      count += same_bits(copy_[i], spheres[i]) ? 0 : 1;
    }
    changed.append({found.data(), count});
  };
  threads.for_blocks(scene.spheres.size(), kSpheresPerBlock, per_block);
}

}  // namespace octocell::cpu::coherence
