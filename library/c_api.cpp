// SPDX-License-Identifier: MIT
// The C functions: each calls its C++ twin and turns an Error into a status.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "include/octocell/octocell.h"
#include "include/octocell/octocell.hpp"

struct octocell_pairs {
  octocell::Pairs list;
};
struct octocell_finder {
  octocell::Finder finder;
};
struct octocell_chunks {
  octocell::Chunks chunks;
};
struct octocell_plan {
  std::string text;
};

namespace octocell {
namespace {

static_assert(sizeof(octocell_sphere) == sizeof(Sphere) &&
              alignof(octocell_sphere) == alignof(Sphere));
static_assert(sizeof(octocell_pair) == sizeof(Pair) && alignof(octocell_pair) == alignof(Pair));
static_assert(sizeof(octocell_shift) == sizeof(Shift) && alignof(octocell_shift) == alignof(Shift));
static_assert(static_cast<int>(Device::cuda) == OCTOCELL_CUDA);

octocell_status status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::invalid_sphere:
      return OCTOCELL_INVALID_SPHERE;
    case ErrorKind::invalid_argument:
      return OCTOCELL_INVALID_ARGUMENT;
    case ErrorKind::limit:
      return OCTOCELL_LIMIT;
    case ErrorKind::memory:
      return OCTOCELL_MEMORY;
    case ErrorKind::unavailable:
      return OCTOCELL_UNAVAILABLE;
    case ErrorKind::stopped:
      return OCTOCELL_STOPPED;
    default:
      return OCTOCELL_INTERNAL;
  }
}

octocell_status report(octocell_error* error, octocell_status status, std::string_view message,
                       std::uint64_t sphere = 0) {
  if (error == nullptr) return status;
  error->status = status;
  error->sphere = sphere;
  const std::size_t length = std::min(message.size(), sizeof(error->message) - 1);
  std::memcpy(error->message, message.data(), length);
  error->message[length] = '\0';
  return status;
}

/// Calls `work`; returns its failure as a status.
template <typename Work>
octocell_status with_status(octocell_error* error, const Work& work) {
  try {
    work();
    return report(error, OCTOCELL_OK, "");
  } catch (const Error& e) {
    return report(error, status_of(e.kind()), e.what(), e.sphere().value_or(0));
  } catch (const std::bad_alloc&) {
    return report(error, OCTOCELL_MEMORY, "not enough memory");
  } catch (const std::exception& e) {
    return report(error, OCTOCELL_INTERNAL, e.what());
  }
}

void require(bool holds, const char* line) {
  if (!holds) throw Error(line, ErrorKind::invalid_argument);
}

/// An array as C gives it. The elements of both languages have the same layout.
template <typename T, typename InC>
std::span<const T> span_of(const InC* first, std::size_t count) {
  require(first != nullptr || count == 0, "a null pointer to an array that is not empty");
  return {reinterpret_cast<const T*>(first), count};
}

std::span<const Sphere> spheres_of(const octocell_sphere* first, std::size_t count) {
  return span_of<Sphere>(first, count);
}

Box box_of(const octocell_box& given) {
  Box box = {};
  for (int a = 0; a < 3; ++a) {
    std::copy_n(given.vector[a], 3, box.vector[a]);
    box.periodic[a] = given.periodic[a] != 0;
  }
  return box;
}

Options options_of(const octocell_options* given, std::size_t flag_count) {
  if (given == nullptr) return {};
  require(given->size == sizeof(octocell_options),
          "options of another release: begin with OCTOCELL_OPTIONS");
  require(given->device == OCTOCELL_CPU || given->device == OCTOCELL_CUDA,
          "options: unknown device");
  Options options = {.threads = given->threads,
                     .sorted = given->sorted != 0,
                     .device = static_cast<Device>(given->device)};
  options.cutoff = given->cutoff;
  if (given->box != nullptr) options.box = box_of(*given->box);
  if (given->flags != nullptr) options.flags = span_of<Flags>(given->flags, flag_count);
  if (given->stop != nullptr) {
    options.stop = [stop = given->stop, context = given->context] { return stop(context) != 0; };
  }
  return options;
}

octocell_pairs* new_list(Pairs pairs) { return new octocell_pairs{std::move(pairs)}; }

const octocell_pair* in_c(const Pair* pairs) {
  return reinterpret_cast<const octocell_pair*>(pairs);
}
const octocell_shift* in_c(std::span<const Shift> shifts) {
  return reinterpret_cast<const octocell_shift*>(shifts.data());
}
octocell_pair in_c(const std::optional<Pair>& pair) {
  return pair ? octocell_pair{pair->i, pair->j} : octocell_pair{0, 0};
}

}  // namespace
}  // namespace octocell

using octocell::in_c;
using octocell::options_of;
using octocell::spheres_of;
using octocell::with_status;

extern "C" {

const char* octocell_version() { return OCTOCELL_VERSION; }

const octocell_pair* octocell_pairs_data(const octocell_pairs* pairs) {
  return in_c(pairs->list.data());
}
size_t octocell_pairs_size(const octocell_pairs* pairs) { return pairs->list.size(); }
const octocell_shift* octocell_pairs_shifts(const octocell_pairs* pairs) {
  return in_c(pairs->list.shifts());
}
void octocell_pairs_free(octocell_pairs* pairs) { delete pairs; }

octocell_status octocell_find_pairs(const octocell_sphere* spheres, size_t count,
                                    const octocell_options* options, octocell_pairs** pairs,
                                    octocell_error* error) {
  return with_status(error, [&] {
    *pairs = octocell::new_list(
        octocell::find_pairs(spheres_of(spheres, count), options_of(options, count)));
  });
}

octocell_status octocell_find_pairs_between(const octocell_sphere* spheres, size_t count,
                                            const octocell_sphere* others, size_t other_count,
                                            const octocell_options* options, octocell_pairs** pairs,
                                            octocell_error* error) {
  return with_status(error, [&] {
    *pairs = octocell::new_list(octocell::find_pairs_between(
        spheres_of(spheres, count), spheres_of(others, other_count), options_of(options, count)));
  });
}

octocell_status octocell_count(const octocell_sphere* spheres, size_t count,
                               const octocell_options* options, uint64_t* pairs,
                               octocell_error* error) {
  return with_status(error, [&] {
    *pairs = octocell::count(spheres_of(spheres, count), options_of(options, count));
  });
}

octocell_status octocell_finder_new(const octocell_options* options, size_t flag_count,
                                    octocell_finder** finder, octocell_error* error) {
  return with_status(error, [&] {
    *finder = new octocell_finder{octocell::Finder(options_of(options, flag_count))};
  });
}
octocell_status octocell_finder_find(octocell_finder* finder, const octocell_sphere* spheres,
                                     size_t count, const octocell_pair** pairs, size_t* pair_count,
                                     octocell_error* error) {
  return with_status(error, [&] {
    const std::span<const octocell::Pair> found = finder->finder.find(spheres_of(spheres, count));
    *pairs = in_c(found.data());
    *pair_count = found.size();
  });
}
const octocell_shift* octocell_finder_shifts(const octocell_finder* finder) {
  return in_c(finder->finder.shifts());
}
octocell_status octocell_finder_take(octocell_finder* finder, octocell_pairs** pairs,
                                     octocell_error* error) {
  return with_status(error, [&] { *pairs = octocell::new_list(finder->finder.take()); });
}
void octocell_finder_free(octocell_finder* finder) { delete finder; }

octocell_status octocell_chunks_new(const octocell_sphere* spheres, size_t count,
                                    uint64_t pairs_per_chunk, const octocell_options* options,
                                    octocell_chunks** chunks, octocell_error* error) {
  return with_status(error, [&] {
    *chunks = new octocell_chunks{
        octocell::Chunks(spheres_of(spheres, count), pairs_per_chunk, options_of(options, count))};
  });
}
octocell_status octocell_chunks_next(octocell_chunks* chunks, octocell_pairs** pairs,
                                     octocell_error* error) {
  return with_status(error, [&] { *pairs = octocell::new_list(chunks->chunks.next()); });
}
void octocell_chunks_free(octocell_chunks* chunks) { delete chunks; }

octocell_status octocell_verify(const octocell_sphere* spheres, size_t count,
                                const octocell_pair* pairs, size_t pair_count,
                                const octocell_options* options, octocell_verification* result,
                                octocell_error* error) {
  return with_status(error, [&] {
    const octocell::Verification found = octocell::verify(
        spheres_of(spheres, count), octocell::span_of<octocell::Pair>(pairs, pair_count),
        options_of(options, count));
    *result = {.missed = found.missed,
               .false_pairs = found.false_pairs,
               .duplicates = found.duplicates,
               .first_missed = in_c(found.first_missed),
               .first_false = in_c(found.first_false),
               .first_duplicate = in_c(found.first_duplicate)};
  });
}

octocell_status octocell_plan_new(const octocell_sphere* spheres, size_t count,
                                  const octocell_options* options, octocell_plan** plan,
                                  octocell_error* error) {
  return with_status(error, [&] {
    *plan = new octocell_plan{
        octocell::plan(spheres_of(spheres, count), options_of(options, count)).explain()};
  });
}
const char* octocell_plan_explain(const octocell_plan* plan) { return plan->text.c_str(); }
void octocell_plan_free(octocell_plan* plan) { delete plan; }

}  // extern "C"
