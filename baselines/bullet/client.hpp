// SPDX-License-Identifier: MIT
// Stores a proxy's sphere id where Bullet has room for a pointer.
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <cstddef>
#include <cstdint>

namespace octocell::baselines {

/// Ids start at 1, because Bullet takes a null client for a free slot in some places.
inline void* client_of(std::size_t id) { return reinterpret_cast<void*>(id + 1); }
inline std::uint32_t id_of(const btBroadphaseProxy* proxy) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::size_t>(proxy->m_clientObject) - 1);
}

}  // namespace octocell::baselines
