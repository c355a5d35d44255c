// SPDX-License-Identifier: MIT
// Finds every pair of overlapping spheres, exactly.
//
//   std::vector<octocell::Sphere> spheres = {{0, 0, 0, 1}, {1.5, 0, 0, 1}, {9, 9, 9, 1}};
//   for (const octocell::Pair& pair : octocell::find_pairs(spheres))
//     std::cout << pair.i << ' ' << pair.j << '\n';  // 0 1
//
// The answer. Spheres i and j are a pair if |p_i - p_j|^2 <= (r_i + r_j)^2 over the real numbers,
// for the float32 values as they are given. Spheres that touch are a pair. Every pair is reported
// once, with i < j. No list is ever cut: a buffer that is too small grows.
//
// Input. Spheres are read where they lie, as four floats each; positions and radii share a unit of
// length, which is the caller's. There are at most kMaxSpheres. All numbers must be finite, and r
// >= 0.
//
// Errors. Functions throw Error and nothing else; its kind says what can be done about it. After an
// error, objects can be used again. An invalid sphere is named, the first if there are several.
//
// Memory. A search needs 8 bytes a pair and usually about 40 bytes a sphere, a Finder about 140
// bytes a sphere. The need is checked before memory is used.
//
// Threads. There is no global state. Different objects can be used by different threads at the same
// time; one object must be used by one thread at a time. Spheres that several calls only read can
// be shared.
//
// What is not exact: the conversion of other numbers to float32, before the spheres come here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "box.hpp"
#include "error.hpp"
#include "export.h"
#include "types.hpp"

namespace octocell {

/// Where a search runs.
enum class Device : std::uint8_t {
  cpu,
  cuda,  // a GPU, if the library was built with CUDA; spheres and pairs lie in the host's memory
};

struct Options {
  /// On how many threads of the CPU a search works, the caller's included; 0: on all that this
  /// process may use, at most 1024. The set of pairs does not depend on it.
  int threads = 0;
  /// True: pairs are sorted by (i, j). False: they come in any order, which may differ from run to
  /// run; that saves time.
  bool sorted = true;
  Device device = Device::cpu;
  /// One word a sphere, which says with what it may collide; or empty: with all. Functions borrow
  /// the words, a Finder copies them, Chunks borrow them as long as they live.
  std::span<const Flags> flags = {};
  /// A box in which the scene repeats: (i, j, S) is a pair if |p_i - p_j + S H|^2 <= (r_i + r_j)^2
  /// over the real numbers, where H are the vectors of the box. Spheres need not lie in it. One
  /// pair may meet in several images, and a sphere may meet its own; each is a pair of its own, and
  /// shifts() of the answer are the S. Of (i, j, S) and (j, i, -S) there is the one with i < j, of
  /// (i, i, S) the one whose first component that is not zero is positive. Sorted means by (i, j,
  /// S). Needs 40 bytes a pair.
  std::optional<Box> box = {};
  /// Is added to r_i + r_j, over the real numbers: 0, or from 2^-149 to the largest float32.
  double cutoff = 0.0;
  /// One number a sphere, below kMaxSpheres: only spheres with the same number can be a pair; or
  /// empty: all can. So many small systems are searched at once. They need not be in order. With
  /// two sets, the numbers of `spheres` come first, then those of `others`. Borrowed like flags.
  std::span<const std::uint32_t> batch = {};
  /// Called many times during a search on the CPU, on the thread that asked for it. If it returns
  /// true, the search ends with Error `stopped`. It must be quick, and must not throw.
  std::function<bool()> stop = {};
};

/// Returns the release, for example "0.1.0".
OCTOCELL_API std::string_view version() noexcept;

/// Returns why a device cannot be used here, in one line; none if it can.
OCTOCELL_API std::optional<std::string> why_unavailable(Device device);

/// A list of pairs that owns its memory. Moving it moves no pair.
class Pairs {
 public:
  Pairs() noexcept = default;
  Pairs(Pairs&& other) noexcept
      : first_(std::exchange(other.first_, nullptr)),
        shifts_(std::exchange(other.shifts_, nullptr)),
        size_(std::exchange(other.size_, 0)) {}
  Pairs& operator=(Pairs&& other) noexcept {
    std::swap(first_, other.first_);
    std::swap(shifts_, other.shifts_);
    std::swap(size_, other.size_);
    return *this;
  }
  OCTOCELL_API ~Pairs();

  [[nodiscard]] const Pair* data() const noexcept { return first_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] const Pair* begin() const noexcept { return first_; }
  [[nodiscard]] const Pair* end() const noexcept { return first_ + size_; }
  const Pair& operator[](std::size_t k) const noexcept { return first_[k]; }

  /// Returns the shift of each pair; an empty list if there was no box.
  [[nodiscard]] std::span<const Shift> shifts() const noexcept {
    return {shifts_, shifts_ == nullptr ? 0 : size_};
  }

 private:
  friend struct PairsAccess;
  Pair* first_ = nullptr;
  Shift* shifts_ = nullptr;
  std::size_t size_ = 0;
};

/// Finds all pairs of a scene.
OCTOCELL_API Pairs find_pairs(std::span<const Sphere> spheres, const Options& options = {});

/// Counts the pairs of a scene. Needs no memory for them.
OCTOCELL_API std::uint64_t count(std::span<const Sphere> spheres, const Options& options = {});

/// Finds all pairs of a sphere of one set with one of another: i is a position in `spheres`, j one
/// in `others`. Two spheres of one set are no pair. In a box, sphere i moved by S boxes meets
/// sphere j, for any S. Flags cannot be used.
OCTOCELL_API Pairs find_pairs_between(std::span<const Sphere> spheres,
                                      std::span<const Sphere> others, const Options& options = {});
OCTOCELL_API std::uint64_t count_between(std::span<const Sphere> spheres,
                                         std::span<const Sphere> others,
                                         const Options& options = {});

/// Finds the pairs of scene after scene, for example of the frames of a simulation. It keeps its
/// memory and its threads, and reuses what it can prove to be still right if most spheres moved
/// little. With flags, every frame must have as many spheres as there are words.
class Finder {
 public:
  OCTOCELL_API explicit Finder(const Options& options = {});
  OCTOCELL_API Finder(Finder&& other) noexcept;
  OCTOCELL_API Finder& operator=(Finder&& other) noexcept;
  OCTOCELL_API ~Finder();

  /// Returns all pairs of this frame. They are valid until the next call of any function of this
  /// object. The number of spheres may change from frame to frame.
  OCTOCELL_API std::span<const Pair> find(std::span<const Sphere> spheres);

  /// Does the same for pairs of two sets, like find_pairs_between().
  OCTOCELL_API std::span<const Pair> find_between(std::span<const Sphere> spheres,
                                                  std::span<const Sphere> others);

  /// Returns the shifts of these pairs; an empty list without a box. Valid as long as the pairs.
  [[nodiscard]] OCTOCELL_API std::span<const Shift> shifts() const;

  /// Moves the pairs of the last find() out, without a copy on the CPU. The next frame is then
  /// searched from scratch. Returns an empty list if there is no answer, or if it was taken.
  OCTOCELL_API Pairs take();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// The pairs of one scene, one chunk after the other, for lists that are larger than memory:
///
///   for (const octocell::Pairs& chunk : octocell::Chunks(spheres, 10'000'000)) write(chunk);
///
/// Chunks follow each other in the order of i: chunk after chunk, sorted pairs are the whole sorted
/// list. A chunk has at most as many pairs as was asked for, or those of a single sphere i if that
/// one has more. Each chunk searches the spheres that are left once more, so large chunks are fast.
/// The spheres must stay as they are as long as this object lives.
class Chunks {
 public:
  /// Throws Error invalid_argument if pairs_per_chunk is 0.
  OCTOCELL_API Chunks(std::span<const Sphere> spheres, std::uint64_t pairs_per_chunk,
                      const Options& options = {});
  OCTOCELL_API Chunks(Chunks&& other) noexcept;
  OCTOCELL_API Chunks& operator=(Chunks&& other) noexcept;
  OCTOCELL_API ~Chunks();

  /// Returns the next chunk; an empty one after the last.
  OCTOCELL_API Pairs next();

  class Iterator {
   public:
    using value_type = Pairs;
    using difference_type = std::ptrdiff_t;
    explicit Iterator(Chunks& chunks) : chunks_(&chunks), chunk_(chunks.next()) {}
    const Pairs& operator*() const noexcept { return chunk_; }
    Iterator& operator++() {
      chunk_ = chunks_->next();
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& at, std::default_sentinel_t) noexcept {
      return at.chunk_.empty();
    }

   private:
    Chunks* chunks_;
    Pairs chunk_;
  };
  Iterator begin() { return Iterator(*this); }
  [[nodiscard]] std::default_sentinel_t end() const noexcept { return {}; }

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// How a list of pairs differs from the answer.
struct Verification {
  std::uint64_t missed = 0;       // pairs that the list lacks
  std::uint64_t false_pairs = 0;  // pairs of the list that are none, each counted once
  std::uint64_t duplicates = 0;   // entries that repeat another one
  /// The first of each kind, by (i, j).
  std::optional<Pair> first_missed = {};
  std::optional<Pair> first_false = {};
  std::optional<Pair> first_duplicate = {};
  [[nodiscard]] bool exact() const noexcept {
    return missed == 0 && false_pairs == 0 && duplicates == 0;
  }
};

/// Compares anyone's list with the answer. The list may have any order; (j, i) counts as (i, j).
/// A pair of a sphere with itself, or with a sphere that does not exist, is false. Needs 8 bytes an
/// entry, for a sorted copy.
OCTOCELL_API Verification verify(std::span<const Sphere> spheres, std::span<const Pair> pairs,
                                 const Options& options = {});

/// How a scene would be searched.
class ScenePlan {
 public:
  OCTOCELL_API ScenePlan(ScenePlan&& other) noexcept;
  OCTOCELL_API ScenePlan& operator=(ScenePlan&& other) noexcept;
  OCTOCELL_API ~ScenePlan();

  /// Returns a short tree of text: what was measured, what was chosen, and why.
  [[nodiscard]] OCTOCELL_API std::string explain() const;

 private:
  friend OCTOCELL_API ScenePlan plan(std::span<const Sphere> spheres, const Options& options);
  struct Inside;
  explicit ScenePlan(std::unique_ptr<Inside> inside) noexcept;
  std::unique_ptr<Inside> inside_;
};

/// Plans a search of a scene, without searching.
OCTOCELL_API ScenePlan plan(std::span<const Sphere> spheres, const Options& options = {});

}  // namespace octocell
