// SPDX-License-Identifier: MIT
#include "harness/engine/images/find_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/images/image_overlap.hpp"
#include "harness/engine/images/found_list.hpp"

namespace octocell::images {
namespace {

constexpr std::uint64_t kCandidatesPerBlock = 1 << 14;
constexpr double kMostDirectTests = 0x1p42;  // that takes hours

/// Returns a pair of images as it is reported: sphere `p` moved by `shift` meets sphere q.
Found found(std::uint32_t p, std::uint32_t q, const Shift& shift) {
  if (p == q) return {{p, q}, is_positive(shift) ? shift : -shift};
  return p < q ? Found{{p, q}, shift} : Found{{q, p}, -shift};
}

/// Returns the pair with positions in the sets of the question.
Found in_sets(const Question& question, Found f) {
  if (question.second_from) f.pair.j -= static_cast<std::uint32_t>(*question.second_from);
  return f;
}

bool overlaps(const Question& question, const Found& f) {
  const auto spheres = question.scene.spheres;
  return images_overlap({spheres[f.pair.i], spheres[f.pair.j], f.shift, question.gap},
                        question.box);
}

/// Lets each thread work on blocks; an error of one ends the others, and is thrown.
template <typename Work>
void for_blocks(cpu::Threads& threads, std::uint64_t size, std::uint64_t block, const Work& work) {
  std::atomic<bool> failed = false;
  std::exception_ptr error;
  std::mutex mutex;
  threads.for_blocks(size, block, [&](std::uint64_t begin, std::uint64_t end) {
    if (failed) return;
    try {
      work(begin, end);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!failed.exchange(true)) error = std::current_exception();
    }
  });
  if (error) std::rethrow_exception(error);
}

/// Decides the pairs of the enclosing scene.
void decide(const Images& images, std::span<const Pair> candidates, cpu::Threads& threads,
            FoundList& list) {
  const Question& question = images.question();
  list.reserve(candidates.size());
  for_blocks(threads, candidates.size(), kCandidatesPerBlock,
             [&](std::uint64_t begin, std::uint64_t end) {
               std::vector<Found> some;
               some.reserve(end - begin);
               for (const Pair& pair : candidates.subspan(begin, end - begin)) {
                 const Image a = images.at(pair.i);
                 const Image b = images.at(pair.j);
                 const Found f = found(a.sphere, b.sphere, a.shift - b.shift);
                 if (!may_pair(question, f.pair.i, f.pair.j)) continue;
                 const bool decided = images.as_given(pair.i) && images.as_given(pair.j);
                 if (decided || overlaps(question, f)) some.push_back(in_sets(question, f));
               }
               list.append(some);
             });
}

/// Where the home of a sphere lies, in boxes.
struct Place {
  double along[3];
};

/// Compares each two spheres in each of the images in which they may be near each other.
void compare_directly(const Images& images, cpu::Threads& threads, FoundList& list) {
  if (!(images.direct_tests() < kMostDirectTests)) {
    throw LimitError(
        fmt::format("box: about {:.3g} pairs of images are near each other; this "
                    "implementation's limit is {:.3g}",
                    images.direct_tests(), kMostDirectTests));
  }
  constexpr std::size_t kAtOnce = 1 << 12;
  const Question& question = images.question();
  const auto spheres = question.scene.spheres;
  std::vector<Place> places(spheres.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) images.place_of(i, places[i].along);
  for_blocks(threads, spheres.size(), 1, [&](std::uint64_t first, std::uint64_t) {
    std::vector<Found> some;
    const auto i = static_cast<std::uint32_t>(first);
    const std::uint64_t first_partner =
        question.second_from ? std::max(first, *question.second_from) : first;
    for (auto j = static_cast<std::uint32_t>(first_partner); j < spheres.size(); ++j) {
      if (!may_pair(question, i, j)) continue;
      const auto& at = places[j].along;
      const Range there[3] = {{at[0], at[0]}, {at[1], at[1]}, {at[2], at[2]}};
      const Shift homes = images.home_of(i) - images.home_of(j);
      images.for_steps(i, there, spheres[j].r, [&](const Shift& step) {
        if (i == j && !is_positive(step)) return;
        const Found f = {{i, j}, step + homes};
        if (overlaps(question, f)) some.push_back(in_sets(question, f));
        if (some.size() < kAtOnce) return;
        list.append(some);
        some.clear();
      });
    }
    list.append(some);
  });
}

}  // namespace

ImagePairs ImageFinder::find(const Question& question, const How& how, const Search& search) {
  FoundList list(how);
  const auto scene = searched_scene(question, how.way);
  if (scene) {
    const OwnedPairs candidates = search(*scene);
    decide(images_, {candidates.items.data(), candidates.count}, threads_, list);
  } else {
    compare_directly(images_, threads_, list);
  }
  ImagePairs answer = list.finish(question.scene.spheres.size(), threads_);
  answer.compared_directly = !scene;
  answer.images = scene ? scene->spheres.size() - question.scene.spheres.size() : 0;
  return answer;
}

std::optional<SceneView> ImageFinder::searched_scene(const Question& question, Way way) {
  images_.place(question, threads_);
  const bool compares =
      way == Way::cheaper ? images_.direct_tests() <= images_.search_tests() : way == Way::compare;
  if (compares) return std::nullopt;
  images_.enclose();
  return images_.scene();
}

}  // namespace octocell::images
