// SPDX-License-Identifier: MIT
#include "harness/plugin/plugin_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace octocell {
SharedLibrary::SharedLibrary(const std::string& path)
    : library_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (library_ == nullptr) throw InputError(dlerror());
}

void* SharedLibrary::symbol(const char* name) const { return dlsym(library_, name); }

void require_success(std::string_view function, int code) {
  if (code != 0) throw LimitError(fmt::format("{} returned {}", function, code));
}

void refuse_overrun(std::string_view list, std::string_view where, std::uint64_t capacity) {
  throw LimitError(fmt::format("it wrote {} of {}, which has room for {}", where, list, capacity));
}

PluginLibrary::PluginLibrary(const std::string& path) {
  const SharedLibrary library(path);
  find_ = library.function<decltype(find_pairs)>("find_pairs");
  prepare_ = library.function<decltype(::prepare)>("prepare");
  finish_ = library.function<decltype(::finish)>("finish");
  if (find_ == nullptr) {
    throw InputError(
        "it has no function find_pairs; in C++, extern \"C\" keeps its name, and octocell_plugin.h "
        "declares it so");
  }
}

void PluginLibrary::prepare(std::size_t spheres) const {
  if (prepare_ != nullptr)
    require_success("prepare", prepare_(static_cast<std::uint32_t>(spheres)));
}

std::uint64_t PluginLibrary::find(std::span<const Sphere> spheres, PairRoom& room) const {
  const std::uint64_t count = find_into(spheres, room.data(), room.capacity());
  require_red_zones(room, "pairs");
  return count;
}

std::uint64_t PluginLibrary::find_into(std::span<const Sphere> spheres, octocell_pair* pairs,
                                       std::uint64_t capacity) const {
  std::uint64_t count = 0;
  const auto* const first = reinterpret_cast<const octocell_sphere*>(spheres.data());
  const int code =
      find_(first, static_cast<std::uint32_t>(spheres.size()), pairs, capacity, &count, nullptr);
  require_success("find_pairs", code);
  return count;
}

void PluginLibrary::finish() const {
  if (finish_ != nullptr) finish_();
}

}  // namespace octocell
