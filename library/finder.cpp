// SPDX-License-Identifier: MIT
// find_pairs, count and Finder: one scene, or one frame after the other.
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "include/octocell/octocell.hpp"
#include "library/errors.hpp"
#include "library/search.hpp"

namespace octocell {

using library::Search;
using library::with_errors;

Pairs find_pairs(std::span<const Sphere> spheres, const Options& options) {
  return with_errors([&] {
    Search search(options);
    search.run({spheres, options.flags});
    return library::handed_over(search.take());
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

struct Finder::Inside {
  Search search;
  std::vector<Flags> flags;

  explicit Inside(const Options& options)
      : search(options), flags(options.flags.begin(), options.flags.end()) {
    search.how.moving = true;
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

Pairs Finder::take() {
  return with_errors([&] { return library::handed_over(inside_->search.take()); });
}

}  // namespace octocell
