// SPDX-License-Identifier: MIT
// octocell._native: the library's functions on arrays. octocell/*.py makes the arrays, checks the
// arguments and documents what users see.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/available_memory.hpp"
#include "python/native/arrays.hpp"
#include "python/native/exact64.hpp"
#include "python/native/layouts.hpp"
#include "python/native/objects.hpp"
#include "python/native/options.hpp"

namespace octocell::python {
namespace {

using Rows64 = Rows<double, 4>;
using Points64 = Rows<double, 3>;

nb::object find(const SphereArray& spheres, const SearchOptions& options) {
  return array_of(
      without_gil([&] { return find_pairs(spheres_of(spheres), options.for_library()); }));
}

std::uint64_t count_pairs(const SphereArray& spheres, const SearchOptions& options) {
  return without_gil([&] { return count(spheres_of(spheres), options.for_library()); });
}

std::string explain(const SphereArray& spheres, const SearchOptions& options) {
  return without_gil([&] { return plan(spheres_of(spheres), options.for_library()).explain(); });
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> in_python(const std::optional<Pair>& pair) {
  if (!pair) return {};
  return std::pair(pair->i, pair->j);
}

nb::tuple verified(const SphereArray& spheres, const PairArray& pairs,
                   const SearchOptions& options) {
  const Verification found = without_gil(
      [&] { return verify(spheres_of(spheres), pairs_of(pairs), options.for_library()); });
  return nb::make_tuple(found.missed, found.false_pairs, found.duplicates,
                        in_python(found.first_missed), in_python(found.first_false),
                        in_python(found.first_duplicate));
}

std::optional<std::string> reason_against(bool on_gpu) {
  return why_unavailable(on_gpu ? Device::cuda : Device::cpu);
}

nb::object array_of_spheres(std::vector<Sphere> spheres) {
  auto owner = std::make_unique<std::vector<Sphere>>(std::move(spheres));
  const auto* const data = reinterpret_cast<const float*>(owner->data());
  const std::size_t size = owner->size();
  return array_of(data, {size, 4}, std::move(owner));
}

nb::object joined(const Rows<float, 3>& centers, const Column<float>& radii) {
  std::vector<Sphere> spheres = without_gil([&] {
    std::vector<Sphere> all(centers.shape(0));
    join(centers.data(), radii.data(), radii.shape(0) == 1 ? 0 : 1, all);
    return all;
  });
  return array_of_spheres(std::move(spheres));
}

nb::tuple rounded_arrays(const Rows64& spheres) {
  Rounded to = without_gil([&] { return rounded(span_of<Sphere64>(spheres)); });
  return nb::make_tuple(array_of_spheres(std::move(to.nearest)),
                        array_of_spheres(std::move(to.wide)));
}

std::pair<std::uint64_t, std::uint64_t> changed_pairs(const Rows64& spheres, const PairArray& found,
                                                      const PairArray& wide) {
  const Changed result = without_gil(
      [&] { return changed(span_of<Sphere64>(spheres), pairs_of(found), pairs_of(wide)); });
  return {result.lost, result.gained};
}

nb::object near_pairs(const Points64& points, const PairArray& pairs, const Column<double>& limits,
                      bool strict) {
  const std::size_t size = pairs.shape(0);
  auto result = std::make_unique<bool[]>(size);
  without_gil([&] {
    near(span_of<Point64>(points), pairs_of(pairs), span_of<double>(limits), strict,
         {result.get(), size});
  });
  const bool* const data = result.get();
  nb::capsule owner(result.release(),
                    [](void* held) noexcept { delete[] static_cast<bool*>(held); });
  return nb::cast(nb::ndarray<nb::numpy, bool>(const_cast<bool*>(data), {size}, owner));
}

nb::tuple csr_arrays(const PairArray& pairs, std::size_t sphere_count, bool both) {
  Csr csr = without_gil([&] { return to_csr(pairs_of(pairs), sphere_count, both); });
  return nb::make_tuple(array_of(std::move(csr.begin)), array_of(std::move(csr.indices)));
}

}  // namespace

NB_MODULE(_native, m) {
  translate_errors();
  m.attr("version") = std::string(version());
  m.attr("max_spheres") = kMaxSpheres;

  nb::class_<SearchOptions>(m, "Options")
      .def(
          "__init__",
          [](SearchOptions* self, int threads, bool sorted, bool on_gpu,
             std::optional<FlagArray> flags) {
            new (self) SearchOptions{threads, sorted, on_gpu, std::move(flags)};
          },
          nb::arg("threads"), nb::arg("sorted"), nb::arg("on_gpu"), nb::arg("flags").none());

  m.def("reason_against", &reason_against);
  m.def("require_memory",
        [](double bytes, const std::string& what) { require_memory(bytes, what); });
  m.def("join", &joined);
  m.def("find", &find);
  m.def("count", &count_pairs);
  m.def("explain", &explain);
  m.def("verify", &verified);
  m.def("rounded", &rounded_arrays);
  m.def("changed", &changed_pairs);
  m.def("near", &near_pairs);
  m.def("csr", &csr_arrays);

  nb::class_<HeldChunks>(m, "Chunks")
      .def(nb::init<SphereArray, std::uint64_t, SearchOptions>())
      .def("next",
           [](HeldChunks& self) { return array_of(without_gil([&] { return self.next(); })); });

  nb::class_<LendingFinder>(m, "Finder")
      .def(nb::init<const SearchOptions&>())
      .def("find", &LendingFinder::find);
}

}  // namespace octocell::python
