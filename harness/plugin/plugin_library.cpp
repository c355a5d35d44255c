// SPDX-License-Identifier: MIT
#include "harness/plugin/plugin_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "core/error.hpp"

namespace octocell {
namespace {

constexpr std::size_t kRedZone = 1024;
constexpr octocell_pair kUnwritten = {0xfffffff1U, 0xfffffff2U};

template <typename Function>
Function* function(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

void require_success(std::string_view name, int code) {
  if (code != 0) throw LimitError(fmt::format("{} returned {}", name, code));
}

}  // namespace

PairRoom::PairRoom(std::uint64_t capacity)
    : capacity_(capacity), pairs_(capacity + kRedZone, kUnwritten) {}

bool PairRoom::is_overrun() const {
  return std::any_of(pairs_.begin() + static_cast<std::ptrdiff_t>(capacity_), pairs_.end(),
                     [](octocell_pair p) { return p.i != kUnwritten.i || p.j != kUnwritten.j; });
}

PluginLibrary::PluginLibrary(const std::string& path) {
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw InputError(dlerror());
  find_ = function<decltype(find_pairs)>(library, "find_pairs");
  prepare_ = function<decltype(::prepare)>(library, "prepare");
  finish_ = function<decltype(::finish)>(library, "finish");
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
  std::uint64_t count = 0;
  const auto* const first = reinterpret_cast<const octocell_sphere*>(spheres.data());
  const int code = find_(first, static_cast<std::uint32_t>(spheres.size()), room.data(),
                         room.capacity(), &count, nullptr);
  require_success("find_pairs", code);
  if (room.is_overrun()) {
    throw LimitError(
        fmt::format("it wrote behind the end of pairs, which has room for {}", room.capacity()));
  }
  return count;
}

void PluginLibrary::finish() const {
  if (finish_ != nullptr) finish_();
}

}  // namespace octocell
