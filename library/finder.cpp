// SPDX-License-Identifier: MIT
// find_pairs, count and Finder: one scene, or one frame after the other.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "include/octocell/octocell.hpp"
#include "library/errors.hpp"
#include "library/search.hpp"

namespace octocell {

using library::Search;
using library::with_errors;

namespace {

constexpr const char* kNoFlags = "flags: cannot be used with two sets of spheres";

const Options& without_flags(const Options& options) {
  if (!options.flags.empty()) throw InputError(kNoFlags);
  return options;
}

}  // namespace

Pairs find_pairs(std::span<const Sphere> spheres, const Options& options) {
  return with_errors([&] {
    Search search(options);
    search.run({spheres, options.flags});
    return search.handed_over();
  });
}

std::uint64_t count(std::span<const Sphere> spheres, const Options& options) {
  return with_errors([&] {
    Search search(options);
    search.how.count_only = true;
    search.run({spheres, options.flags});
    return search.count();
  });
}

Pairs find_pairs_between(std::span<const Sphere> spheres, std::span<const Sphere> others,
                         const Options& options) {
  return with_errors([&] {
    Search search(without_flags(options));
    search.run_between(spheres, others);
    return search.handed_over();
  });
}

std::uint64_t count_between(std::span<const Sphere> spheres, std::span<const Sphere> others,
                            const Options& options) {
  return with_errors([&] {
    Search search(without_flags(options));
    search.how.count_only = true;
    search.run_between(spheres, others);
    return search.count();
  });
}

struct Finder::Inside {
  Search search;
  std::vector<Flags> flags;
  std::vector<std::uint32_t> batch;

  explicit Inside(const Options& options)
      : search(options),
        flags(options.flags.begin(), options.flags.end()),
        batch(options.batch.begin(), options.batch.end()) {
    search.how.moving = true;
    search.batch = batch;
  }
};

Finder::Finder(const Options& options)
    : inside_(with_errors([&] { return std::make_unique<Inside>(options); })) {}
Finder::Finder(Finder&& other) noexcept = default;
Finder& Finder::operator=(Finder&& other) noexcept = default;
Finder::~Finder() = default;

std::span<const Pair> Finder::find(std::span<const Sphere> spheres) {
  return with_errors([&] {
    inside_->search.run_frame({spheres, inside_->flags});
    return inside_->search.pairs();
  });
}

std::span<const Pair> Finder::find_between(std::span<const Sphere> spheres,
                                           std::span<const Sphere> others) {
  return with_errors([&] {
    if (!inside_->flags.empty()) throw InputError(kNoFlags);
    inside_->search.run_between(spheres, others);
    return inside_->search.pairs();
  });
}

std::span<const Shift> Finder::shifts() const { return inside_->search.shifts(); }

Pairs Finder::take() {
  return with_errors([&] { return inside_->search.handed_over(); });
}

}  // namespace octocell
