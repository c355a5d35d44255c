// SPDX-License-Identifier: MIT
// What to do with a scene, decided before the stages run, so that nothing timed waits for the host.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/grid.hpp"
#include "core/pair_test.hpp"
#include "core/skips.hpp"

namespace octocell {

enum class Method : std::uint8_t { home_phantom, half_shell, brute_force };
enum class Rule : std::uint8_t { lowest_cell, chapter32, as_written };

inline constexpr std::array<std::string_view, 3> kMethodNames = {"home_phantom", "half_shell",
                                                                 "brute_force"};
inline constexpr std::array<std::string_view, 3> kRuleNames = {"lowest_cell", "chapter32",
                                                               "as_written"};
constexpr std::string_view name_of(Method m) { return kMethodNames[static_cast<std::size_t>(m)]; }
constexpr std::string_view name_of(Rule r) { return kRuleNames[static_cast<std::size_t>(r)]; }

/// Room for what is found on the way. Zero is legal: the finder then says how much is needed.
struct Capacities {
  std::uint64_t ids = 0;              // cell ids, and object ids: homes and phantoms
  std::uint64_t cells = 0;            // entries of the cell index
  std::uint64_t uncertain_pairs = 0;  // pairs that float32 cannot decide
  std::uint64_t pairs = 0;
};

/// What the plan takes for granted. Stage 1 checks it again on the data it is given.
struct PlanFacts {
  std::uint64_t sphere_count = 0;
  float lowest[3] = {0, 0, 0};  // of the centres
  float highest[3] = {0, 0, 0};
  float r_max = 0.0F;
  float r_min = 0.0F;
  float r_min_nonzero = 0.0F;  // smallest radius above zero; 0 if there is none
  /// 2^-g: all coordinates and radii are multiples of 2^g. 0: unknown, or of no use.
  double lattice_units_per_length = 0.0;
};

/// Method half_shell: the spheres of one class of size, and the grid made to their measure.
///
/// A cell is a diameter wide or more, so that spheres of the level that overlap lie in the same or
/// in adjacent cells (docs/exactness.md, claim A). Along x cells are cut into columns, finer:
/// `column_reach` columns are at least a diameter. The id of a column is first_id + column +
/// columns * row with row = y + rows_y * z, so that a row's columns, sorted, lie side by side.
struct Level {
  float r_max = 0.0F;          // radii above the level below, up to this
  Grid grid;                   // ids from 0
  std::uint32_t first_id = 0;  // its ids are [first_id, first_id + ids)
  std::uint32_t ids = 1;
  std::uint32_t column_reach = 1;  // in columns
};
inline constexpr int kMaxLevels = 6;

struct Levels {
  int count = 0;
  Level level[kMaxLevels];  // the smallest spheres first
};

/// The level of a sphere: the first that is wide enough. r <= r_max of the last.
OCTOCELL_HD int level_of(const Levels& levels, float r) {
  int level = 0;
  while (level + 1 < levels.count && r > levels.level[level].r_max) ++level;
  return level;
}

/// Skip::skin: a search of spheres that have grown finds pairs that are near, and that stay the
/// only ones that can overlap while nothing has moved further than the growth.
struct SkinCells {
  float growth = 0.0F;        // the most that a radius may grow by; 0: no skin
  float static_share = 0.0F;  // of the spheres: these need not grow while they stand
  Levels levels;              // for radii that have grown by it
  int key_bits = 0;
};

/// The most growth, in mean radii: 2.7 neighbor pairs for a pair. Where one of two does not grow,
/// the other may by twice as much.
constexpr float most_skin(float static_share) { return 0.4F * (1.0F + static_share); }

/// At least r + growth over the reals: the sum loses at most 2^-24 of itself, the factor adds more.
/// Monotone in both. growth >= 2^-60.
OCTOCELL_HD float grown_radius(float r, float growth) { return (r + growth) * kRadiusGrowth; }

/// What Counts::plan_violation says where they no longer hold.
inline constexpr const char* kFactsBroken =
    "the spheres have left the box, the range of radii or the lattice that the plan rests on";
inline constexpr const char* kFlagsBroken =
    "the plan rests on flags by which no two spheres collide, and now some do";

struct Plan {
  Method method = Method::home_phantom;
  Rule rule = Rule::lowest_cell;
  Grid grid;                               // of method home_phantom
  Levels levels;                           // of method half_shell
  int key_bits = 0;                        // every cell id is below 2^key_bits
  Predicate predicate = Predicate::exact;  // what was asked for
  PairTest test = PairTest::filter_safe;   // what that takes here
  Packing packing;                         // of packed tests
  PlanFacts facts;
  Capacities capacity;
  int sort_digit_bits = 9;  // the most that one pass of the backend's sort takes
  int threads = 1;
  Skips allowed = Skips::all();  // what may be left out where the data show that it can
  Skips taken;                   // what this plan leaves out
  bool nothing_to_find = false;  // by their flags no two spheres may collide; stage 1 checks it
  bool moving = false;           // updates will come: what a frame leaves may serve the next
  SkinCells skin;                // of method half_shell, where frames move
  bool count_only = false;       // keep count and checksum, store no pairs
  /// Pair tests are not started when more candidates than this are counted beforehand.
  std::uint64_t candidate_limit = ~std::uint64_t{0};
};

/// What a find_pairs() met. Counts go on past the end of a full buffer: they are the sizes needed.
struct Counts {
  std::uint64_t ids = 0;
  std::uint64_t cells = 0;
  std::uint64_t candidates = 0;  // pairs of spheres looked at
  std::uint64_t uncertain_pairs = 0;
  std::uint64_t pairs = 0;
  bool over_candidate_limit = false;
  Skips used;       // what the data allowed to leave out in this run; the plan has its own
  int threads = 0;  // that worked: fewer than planned where the system gave no more; 0: not told
  /// What spared this frame a search of all spheres; none: it had one.
  std::optional<Skip> reused = {};
  /// Set when a fact of the plan, or a condition of its rule, does not hold for the data.
  std::optional<std::string> plan_violation = {};
};

/// True if every buffer was large enough. A count_only plan keeps neither uncertain pairs nor
/// pairs.
inline bool fits(const Counts& found, const Capacities& room, bool count_only) {
  return found.ids <= room.ids && found.cells <= room.cells &&
         (count_only ||
          (found.uncertain_pairs <= room.uncertain_pairs && found.pairs <= room.pairs));
}

}  // namespace octocell
