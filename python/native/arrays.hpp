// SPDX-License-Identifier: MIT
// Arrays between Python and the library. Those that come in are read where they lie; those that go
// out own their memory.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "include/octocell/octocell.hpp"

namespace octocell::python {

namespace nb = nanobind;

// octocell/_input.py makes arrays of these forms, so no conversion happens here.
template <typename T, int columns>
using Rows = nb::ndarray<const T, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;
template <typename T>
using Column = nb::ndarray<const T, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

using SphereArray = Rows<float, 4>;
using FlagArray = Column<std::uint32_t>;
using PairArray = Rows<std::uint32_t, 2>;

template <typename T, typename Array>
std::span<const T> span_of(const Array& array) {
  return {reinterpret_cast<const T*>(array.data()), array.shape(0)};
}
inline std::span<const Sphere> spheres_of(const SphereArray& array) {
  return span_of<Sphere>(array);
}
inline std::span<const Pair> pairs_of(const PairArray& array) { return span_of<Pair>(array); }

/// Returns a NumPy array of some memory, which lives until the last view of it is gone.
template <typename T, typename Owner>
nb::object array_of(const T* data, std::initializer_list<std::size_t> shape,
                    std::unique_ptr<Owner> owner) {
  nb::capsule capsule(owner.get(), [](void* held) noexcept { delete static_cast<Owner*>(held); });
  owner.release();
  return nb::cast(nb::ndarray<nb::numpy, T>(const_cast<T*>(data), shape, capsule));
}

template <typename T>
nb::object array_of(std::vector<T> values) {
  auto owner = std::make_unique<std::vector<T>>(std::move(values));
  const T* const data = owner->data();
  const std::size_t size = owner->size();
  return array_of(data, {size}, std::move(owner));
}

/// Returns a list of pairs as an array (P, 2) of uint32, without a copy.
inline nb::object array_of(Pairs pairs) {
  auto owner = std::make_unique<Pairs>(std::move(pairs));
  const auto* const data = reinterpret_cast<const std::uint32_t*>(owner->data());
  const std::size_t size = owner->size();
  return array_of(data, {size, 2}, std::move(owner));
}

/// Calls `work` while other threads of Python run, and returns its result.
template <typename Work>
auto without_gil(const Work& work) {
  nb::gil_scoped_release released;
  return work();
}

}  // namespace octocell::python
