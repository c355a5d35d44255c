// SPDX-License-Identifier: MIT
#include "harness/try/library_runner.hpp"

#include <fmt/format.h>
#include <unistd.h>

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
#include "harness/plugin/plugin_library.hpp"
#include "harness/try/protocol.hpp"

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

std::vector<ListedPair> as_list(std::span<const octocell_pair> pairs) {
  std::vector<ListedPair> list;
  list.reserve(pairs.size());
  for (const octocell_pair p : pairs) list.push_back({p.i, p.j});
  return list;
}

std::vector<ListedPair> find(const PluginLibrary& plugin, std::span<const Sphere> spheres,
                             const Question& question) {
  const std::vector<Sphere> before(spheres.begin(), spheres.end());
  plugin.prepare(spheres.size());
  PairRoom room(question.capacity);
  std::uint64_t count = plugin.find(spheres, room);
  if (count > room.capacity()) {
    if (count > question.most_pairs) {
      throw LimitError(
          fmt::format("it counts {} pairs; at most {} are read", count, question.most_pairs));
    }
    room = PairRoom(count);
    const std::uint64_t again = plugin.find(spheres, room);
    if (again > count) {
      throw LimitError(
          fmt::format("it asked for room for {} pairs, and then for {}", count, again));
    }
    count = again;
  }
  plugin.finish();
  if (!spheres.empty() && std::memcmp(before.data(), spheres.data(), spheres.size_bytes()) != 0)
    throw LimitError("it changed the spheres");
  return as_list(room.first(count));
}

void answer_all(const PluginLibrary& plugin) {
  answer({});
  Question question = {};
  while (read_whole(std::as_writable_bytes(std::span(&question, 1)))) {
    std::vector<Sphere> spheres(question.spheres);
    if (!read_whole(std::as_writable_bytes(std::span(spheres)))) return;
    answer(find(plugin, spheres, question));
  }
}

}  // namespace

int run_library(const std::string& path) {
  try {
    answer_all(PluginLibrary(path));
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
