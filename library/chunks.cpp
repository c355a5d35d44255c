// SPDX-License-Identifier: MIT
// The pairs of one scene in chunks. A chunk has the pairs whose smaller id lies in a range. To find
// them, spheres before the range are left out and those behind it are made static: then every pair
// has a sphere of the range, and its smaller id is there, because no smaller ids are left.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/flags.hpp"
#include "include/octocell/octocell.hpp"
#include "library/errors.hpp"
#include "library/search.hpp"

namespace octocell {

using library::with_errors;

struct Chunks::Inside {
  Inside(std::span<const Sphere> all, std::uint64_t pairs_per_chunk, const Options& options)
      : spheres(all), most(pairs_per_chunk), user_flags(options.flags), search(options) {
    if (most == 0) throw InputError("chunks of 0 pairs; must be 1 or more");
    if (search.has_images())
      throw InputError("chunks and verify: a box, a cutoff or batches cannot be used there");
    width = spheres.size();
  }

  /// Finds the pairs whose smaller id is in [begin, begin + width), with a width for which they
  /// fit.
  OwnedPairs next_range();
  /// Returns the flags of the spheres from `begin` on; those of [begin, begin + width) may move.
  std::span<const Flags> flags_of_range();
  /// Removes pairs of two spheres that the user made static, then adds `begin` to all ids.
  void restore(OwnedPairs& pairs) const;

  std::span<const Sphere> spheres;
  std::uint64_t most;
  std::span<const Flags> user_flags;
  library::Search search;
  std::vector<Flags> flags;
  std::size_t begin = 0;  // of the range that is searched next
  std::size_t width = 0;  // of that range, as far as is known
};

namespace {

/// Returns a width for which about nine tenths of the list would be filled.
std::size_t fitting_width(std::size_t width, std::uint64_t found, std::uint64_t most) {
  const double share =
      0.9 * static_cast<double>(most) / static_cast<double>(std::max<std::uint64_t>(found, 1));
  return static_cast<std::size_t>(static_cast<double>(width) * std::min(share, 16.0)) + 1;
}

}  // namespace

std::span<const Flags> Chunks::Inside::flags_of_range() {
  const std::size_t left = spheres.size() - begin;
  if (width == left) return user_flags.empty() ? user_flags : user_flags.subspan(begin);
  flags.assign(left, Flags{});
  if (!user_flags.empty()) std::ranges::copy(user_flags.subspan(begin), flags.begin());
  for (std::size_t k = 0; k < left; ++k) {
    flags[k] = make_flags(k >= width, group_of(flags[k]), mask_of(flags[k]));
  }
  return flags;
}

OwnedPairs Chunks::Inside::next_range() {
  for (;;) {
    const std::size_t left = spheres.size() - begin;
    width = std::min(width, left);
    const std::uint64_t wanted = width == 1 ? left : std::min<std::uint64_t>(most, width * left);
    const auto [found, room] =
        search.run_bounded({spheres.subspan(begin), flags_of_range()}, wanted);
    // There is less room than wanted if memory is short.
    const std::size_t next_width = fitting_width(width, found, room < wanted ? room : most);
    if (found <= room) {
      OwnedPairs pairs = search.take();
      restore(pairs);
      begin += width;
      width = next_width;
      return pairs;
    }
    if (width == 1) {
      throw MemoryError("the pairs of one sphere do not fit into the memory that is available");
    }
    width = std::min(next_width, width - 1);
  }
}

void Chunks::Inside::restore(OwnedPairs& pairs) const {
  const std::span<Pair> all(pairs.items.data(), pairs.count);
  auto kept = all.end();
  if (!user_flags.empty()) {
    kept = std::remove_if(all.begin(), all.end(), [&](Pair pair) {
      return !may_collide(user_flags[begin + pair.i], user_flags[begin + pair.j]);
    });
  }
  pairs.count = static_cast<std::uint64_t>(kept - all.begin());
  const auto first = static_cast<std::uint32_t>(begin);
  for (Pair& pair : all.first(pairs.count)) pair = {pair.i + first, pair.j + first};
}

Chunks::Chunks(std::span<const Sphere> spheres, std::uint64_t pairs_per_chunk,
               const Options& options)
    : inside_(with_errors(
          [&] { return std::make_unique<Inside>(spheres, pairs_per_chunk, options); })) {}
Chunks::Chunks(Chunks&& other) noexcept = default;
Chunks& Chunks::operator=(Chunks&& other) noexcept = default;
Chunks::~Chunks() = default;

Pairs Chunks::next() {
  return with_errors([&] {
    OwnedPairs pairs;
    while (pairs.count == 0 && inside_->begin < inside_->spheres.size()) {
      pairs = inside_->next_range();
    }
    return library::handed_over(std::move(pairs));
  });
}

}  // namespace octocell
