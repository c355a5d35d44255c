// SPDX-License-Identifier: MIT
#include "harness/try/library_runner.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "harness/files/load_pairs.hpp"
#include "harness/try/protocol.hpp"
#include "include/octocell/octocell_plugin.h"

namespace octocell::hand_in {
namespace {

/// Returns false at the end of the questions.
bool read_whole(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = ::read(kQuestions, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

/// Writes all bytes or exits: then the judge has ended.
void write_whole(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(kAnswers, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void answer(std::span<const ListedPair> pairs) {
  const Answer head = {Ending::pairs, 0, pairs.size()};
  write_whole(std::as_bytes(std::span(&head, 1)));
  write_whole(std::as_bytes(pairs));
}

void answer_failure(std::string_view text) {
  text = text.substr(0, kLongestText);
  const Answer head = {Ending::failed, static_cast<std::uint32_t>(text.size()), 0};
  write_whole(std::as_bytes(std::span(&head, 1)));
  write_whole(std::as_bytes(std::span(text)));
}

/// Room for pairs, and a red zone behind it that must not change.
class Room {
 public:
  explicit Room(std::uint64_t capacity)
      : capacity_(capacity), pairs_(capacity + kRedZone, kUnwritten) {}
  [[nodiscard]] octocell_pair* data() { return pairs_.data(); }
  [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
  [[nodiscard]] bool is_overrun() const {
    return std::any_of(pairs_.begin() + static_cast<std::ptrdiff_t>(capacity_), pairs_.end(),
                       [](octocell_pair p) { return p.i != kUnwritten.i || p.j != kUnwritten.j; });
  }
  [[nodiscard]] std::vector<ListedPair> first(std::uint64_t count) const {
    std::vector<ListedPair> list;
    list.reserve(count);
    for (std::uint64_t k = 0; k < count; ++k) list.push_back({pairs_[k].i, pairs_[k].j});
    return list;
  }

 private:
  static constexpr std::size_t kRedZone = 1024;
  static constexpr octocell_pair kUnwritten = {0xfffffff1U, 0xfffffff2U};
  std::uint64_t capacity_;
  std::vector<octocell_pair> pairs_;
};

/// The functions of a shared library.
class Plugin {
 public:
  explicit Plugin(const std::string& path) {
    void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw InputError(dlerror());
    find_ = function<decltype(find_pairs)>(library, "find_pairs");
    prepare_ = function<decltype(prepare)>(library, "prepare");
    finish_ = function<decltype(finish)>(library, "finish");
    if (find_ == nullptr) {
      throw InputError(
          "it has no function find_pairs; in C++, extern \"C\" keeps its name, and "
          "octocell_plugin.h declares it so");
    }
  }

  std::vector<ListedPair> find(std::span<const Sphere> spheres, const Question& question) {
    const std::vector<Sphere> before(spheres.begin(), spheres.end());
    const auto n = static_cast<std::uint32_t>(spheres.size());
    if (prepare_ != nullptr) require_success("prepare", prepare_(n));
    Room room(question.capacity);
    std::uint64_t count = call(spheres, room);
    if (count > room.capacity()) {
      if (count > question.most_pairs)
        throw LimitError(
            fmt::format("it counts {} pairs; at most {} are read", count, question.most_pairs));
      room = Room(count);
      const std::uint64_t again = call(spheres, room);
      if (again > count)
        throw LimitError(
            fmt::format("it asked for room for {} pairs, and then for {}", count, again));
      count = again;
    }
    if (finish_ != nullptr) finish_();
    if (!spheres.empty() && std::memcmp(before.data(), spheres.data(), spheres.size_bytes()) != 0) {
      throw LimitError("it changed the spheres");
    }
    return room.first(count);
  }

 private:
  template <typename Function>
  static Function* function(void* library, const char* name) {
    return reinterpret_cast<Function*>(dlsym(library, name));
  }

  static void require_success(std::string_view name, int code) {
    if (code != 0) throw LimitError(fmt::format("{} returned {}", name, code));
  }

  std::uint64_t call(std::span<const Sphere> spheres, Room& room) {
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

  decltype(find_pairs)* find_ = nullptr;
  decltype(prepare)* prepare_ = nullptr;
  decltype(finish)* finish_ = nullptr;
};

void answer_all(Plugin& plugin) {
  answer({});
  Question question = {};
  while (read_whole(std::as_writable_bytes(std::span(&question, 1)))) {
    std::vector<Sphere> spheres(question.spheres);
    if (!read_whole(std::as_writable_bytes(std::span(spheres)))) return;
    answer(plugin.find(spheres, question));
  }
}

}  // namespace

int run_library(const std::string& path) {
  try {
    Plugin plugin(path);
    answer_all(plugin);
  } catch (const Error& error) {
    answer_failure(error.what());
  } catch (const std::bad_alloc&) {
    answer_failure("not enough memory");
  } catch (const std::exception& error) {
    answer_failure(fmt::format("it threw an exception: {}", error.what()));
  } catch (...) {
    answer_failure("it threw an exception");
  }
  _exit(0);
}

}  // namespace octocell::hand_in
