// SPDX-License-Identifier: MIT
#include "python/native/objects.hpp"

#include <span>
#include <vector>

namespace octocell::python {
namespace {

/// Returns an array of a copy of the pairs.
nb::object copy_of(std::span<const Pair> pairs) {
  auto owner =
      without_gil([&] { return std::make_unique<std::vector<Pair>>(pairs.begin(), pairs.end()); });
  const auto* const data = reinterpret_cast<const std::uint32_t*>(owner->data());
  return array_of(data, {pairs.size(), 2}, std::move(owner));
}

}  // namespace

nb::object LendingFinder::find(const SphereArray& spheres, bool lend) {
  if (!lent_.expired()) {
    throw nb::buffer_error(
        "the pairs of an earlier frame are in use: delete them, or find them with copy=True");
  }
  const std::span<const Pair> pairs =
      without_gil([&] { return finder_->find(spheres_of(spheres)); });
  if (!lend) return copy_of(pairs);
  // The array owns a share of the finder, by a pointer of its own, which tells when it is gone.
  auto lease = std::make_unique<std::shared_ptr<Finder>>(
      std::shared_ptr<Finder>(finder_.get(), [kept = finder_](Finder*) {}));
  lent_ = *lease;
  const auto* const data = reinterpret_cast<const std::uint32_t*>(pairs.data());
  return array_of(data, {pairs.size(), 2}, std::move(lease));
}

}  // namespace octocell::python
