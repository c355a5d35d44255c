// SPDX-License-Identifier: MIT
#include "harness/try/library_runner.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/sphere.hpp"
#include "harness/files/load_pairs.hpp"
#include "harness/plugin/plugin_library.hpp"
#include "harness/plugin/stage_library.hpp"
#include "harness/try/board.hpp"
#include "harness/try/protocol.hpp"

namespace octocell::hand_in {
namespace {

using Bytes = std::vector<std::byte>;
using Outputs = std::array<Bytes, kMostOutputs>;

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

void answer(const Outputs& outputs) {
  Answer head = {Ending::arrays, 0, {}};
  for (std::size_t k = 0; k < outputs.size(); ++k) head.bytes[k] = outputs[k].size();
  write_whole(std::as_bytes(std::span(&head, 1)));
  for (const Bytes& output : outputs) write_whole(output);
}

void answer_failure(std::string_view text) {
  text = text.substr(0, kLongestText);
  const Answer head = {Ending::failed, static_cast<std::uint32_t>(text.size()), {}};
  write_whole(std::as_bytes(std::span(&head, 1)));
  write_whole(std::as_bytes(std::span(text)));
}

template <typename T>
Bytes bytes_of(std::span<const T> items) {
  const auto bytes = std::as_bytes(items);
  return {bytes.begin(), bytes.end()};
}

Bytes as_list(std::span<const octocell_pair> pairs) {
  std::vector<ListedPair> list;
  list.reserve(pairs.size());
  for (const octocell_pair p : pairs) list.push_back({p.i, p.j});
  return bytes_of(std::span<const ListedPair>(list));
}

/// Calls find(capacity), which returns a count; again with more room if there was too little.
template <typename Find>
std::uint64_t with_enough_room(const Question& question, std::string_view entries, Find find) {
  const std::uint64_t count = find(question.capacity);
  if (count <= question.capacity) return count;
  if (count > question.most) {
    throw LimitError(
        fmt::format("it counts {} {}; at most {} are read", count, entries, question.most));
  }
  const std::uint64_t again = find(count);
  if (again > count) {
    throw LimitError(
        fmt::format("it asked for room for {} {}, and then for {}", count, entries, again));
  }
  return again;
}

/// The arrays of a question, and copies by which it is seen whether they were changed.
class Arrays {
 public:
  /// Returns false at the end of the questions.
  bool receive(const Question& question) {
    for (std::size_t k = 0; k < kMostInputs; ++k) {
      arrays_[k].resize(question.bytes[k]);
      if (!read_whole(arrays_[k])) return false;
    }
    before_ = arrays_;
    return true;
  }
  template <typename T>
  [[nodiscard]] std::span<const T> as(std::size_t k) const {
    return {reinterpret_cast<const T*>(arrays_[k].data()), arrays_[k].size() / sizeof(T)};
  }
  [[nodiscard]] EntryView entries(std::size_t k) const {
    return {as<std::uint32_t>(k), as<std::uint32_t>(k + 1)};
  }
  [[nodiscard]] bool are_unchanged() const { return arrays_ == before_; }

 private:
  std::array<Bytes, kMostInputs> arrays_;
  std::array<Bytes, kMostInputs> before_;
};

Outputs find(const PluginLibrary& plugin, const Question& question, const Arrays& inputs) {
  const auto spheres = inputs.as<Sphere>(0);
  plugin.prepare(spheres.size());
  PairRoom room;
  const std::uint64_t count = with_enough_room(question, "pairs", [&](std::uint64_t capacity) {
    room = PairRoom(capacity);
    return plugin.find(spheres, room);
  });
  plugin.finish();
  if (!inputs.are_unchanged()) throw LimitError("it changed the spheres");
  return {as_list(room.first(count))};
}

/// Answers a timed question by the shared memories.
void find_timed(const PluginLibrary& plugin, const Question& question) {
  static const SeenBoard board;
  plugin.prepare(question.timed_spheres);
  answer({});
  char go = 0;
  if (!read_whole(std::as_writable_bytes(std::span(&go, 1)))) _exit(0);
  const auto* const first = reinterpret_cast<const Sphere*>(board.spheres);
  *board.count = plugin.find_into({first, question.timed_spheres}, board.pairs, question.capacity);
  answer({});
  plugin.finish();
}

Outputs run_stage(const StageLibrary& library, Function stage, const Question& question,
                  const Arrays& inputs) {
  if (stage == Function::sort) {
    const EntryView entries = inputs.entries(0);
    EntryRoom room(entries.ids.size());
    library.sort(entries, static_cast<std::uint32_t>(question.key_bits), room);
    const std::uint64_t n = entries.ids.size();
    return {bytes_of(room.ids.first(n)), bytes_of(room.objects.first(n))};
  }
  if (stage == Function::cell_ids) {
    EntryRoom room(0);
    const octocell_grid grid = inputs.as<octocell_grid>(1).front();
    const std::uint64_t count = with_enough_room(question, "ids", [&](std::uint64_t capacity) {
      room = EntryRoom(capacity);
      return library.cell_ids(inputs.as<Sphere>(0), grid, room);
    });
    return {bytes_of(room.ids.first(count)), bytes_of(room.objects.first(count))};
  }
  if (stage == Function::cell_index) {
    Room<octocell_cell> room;
    const std::uint64_t count = with_enough_room(question, "cells", [&](std::uint64_t capacity) {
      room = Room<octocell_cell>(capacity);
      return library.cell_index(inputs.entries(0), room);
    });
    return {bytes_of(room.first(count))};
  }
  PairRoom room;
  const std::uint64_t count = with_enough_room(question, "pairs", [&](std::uint64_t capacity) {
    room = PairRoom(capacity);
    return library.pair_tests(inputs.as<Sphere>(0), inputs.entries(1), inputs.as<octocell_cell>(3),
                              room);
  });
  return {as_list(room.first(count))};
}

/// Says hello, then answers each question by `reply`.
template <typename Reply>
void answer_all(Reply reply) {
  answer({});
  Question question = {};
  Arrays inputs;
  while (read_whole(std::as_writable_bytes(std::span(&question, 1)))) {
    if (!inputs.receive(question)) return;
    reply(question, inputs);
  }
}

void answer_with(const std::string& path, Function function) {
  if (function == Function::find_pairs) {
    const PluginLibrary plugin(path);
    return answer_all([&](const Question& question, const Arrays& inputs) {
      if (question.is_timed == 0) return answer(find(plugin, question, inputs));
      find_timed(plugin, question);
    });
  }
  const StageLibrary library(path, std::string(name_of(function)));
  answer_all([&](const Question& question, const Arrays& inputs) {
    const Outputs outputs = run_stage(library, function, question, inputs);
    if (!inputs.are_unchanged()) throw LimitError("it changed its input");
    answer(outputs);
  });
}

}  // namespace

int run_library(const std::string& path, const std::string& function) {
  try {
    answer_with(path, function_named(function).value());
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
