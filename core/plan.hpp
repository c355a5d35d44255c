// SPDX-License-Identifier: MIT
// What to do with a scene. It is decided before the stages run, so no timed work waits for the
// host.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/grid.hpp"
#include "core/precision.hpp"
#include "core/skips.hpp"
#include "core/tiles.hpp"

namespace octocell {

enum class Method : std::uint8_t { home_phantom, half_shell, brute_force, tiles };
enum class Rule : std::uint8_t { lowest_cell, chapter32, as_written };

inline constexpr std::array<std::string_view, 4> kMethodNames = {"home_phantom", "half_shell",
                                                                 "brute_force", "tiles"};
inline constexpr std::array<std::string_view, 3> kRuleNames = {"lowest_cell", "chapter32",
                                                               "as_written"};
constexpr std::string_view name_of(Method m) { return kMethodNames[static_cast<std::size_t>(m)]; }
constexpr std::string_view name_of(Rule r) { return kRuleNames[static_cast<std::size_t>(r)]; }

/// Sizes of the buffers. Zero is legal: the finder then reports how much it needs.
struct Capacities {
  std::uint64_t ids = 0;              // cell ids and object ids: homes and phantoms
  std::uint64_t cells = 0;            // entries of the cell index
  std::uint64_t uncertain_pairs = 0;  // pairs that float32 cannot decide
  std::uint64_t pairs = 0;
  std::uint32_t tile_records = 0;  // of one tile: its spheres and copies
};

/// What the plan assumes about the scene. Stage 1 checks it again on the data that it is given.
struct PlanFacts {
  std::uint64_t sphere_count = 0;
  float lowest[3] = {0, 0, 0};  // over all centres
  float highest[3] = {0, 0, 0};
  float r_max = 0.0F;
  float r_min = 0.0F;
  float r_min_nonzero = 0.0F;  // smallest radius above zero; 0 if there is none
  /// 2^-g if all coordinates and radii are multiples of 2^g; 0 if that is unknown or of no use.
  double lattice_units_per_length = 0.0;
};

/// Method half_shell: the spheres of one size class, and a grid made for them.
///
/// A cell is at least one diameter wide, so spheres of the level that overlap lie in the same or in
/// adjacent cells (docs/exactness.md, claim A). Along x, cells are cut into finer columns:
/// `column_reach` columns are at least a diameter. The id of a column is first_id + column +
/// columns * row with row = y + rows_y * z, so the columns of a row, sorted, lie side by side.
struct Level {
  float r_max = 0.0F;          // of this level; radii are above those of the level before
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

/// Returns the level of a sphere: the first whose r_max is at least r. Needs r <= r_max of the last
/// level.
OCTOCELL_HD int level_of(const Levels& levels, float r) {
  int level = 0;
  while (level + 1 < levels.count && r > levels.level[level].r_max) ++level;
  return level;
}

/// For Skip::skin: a search of enlarged spheres finds all neighbor pairs. Only these can overlap as
/// long as no sphere has moved further than its radius was enlarged.
struct SkinCells {
  float growth = 0.0F;        // the most by which a radius may grow; 0: no skin
  float static_share = 0.0F;  // of the spheres; static ones need not grow as long as they do not
                              // move
  Levels levels;              // for the enlarged radii
  int key_bits = 0;
};

/// Returns the largest growth, in mean radii. With it there are 2.7 neighbor pairs for each pair.
/// If one of two spheres does not grow, the other may grow by twice as much.
constexpr float most_skin(float static_share) { return 0.4F * (1.0F + static_share); }

/// Returns at least r + growth over the reals: the sum loses at most 2^-24 of itself, and the
/// factor adds more. Monotone in both arguments. Needs growth >= 2^-60.
OCTOCELL_HD float grown_radius(float r, float growth) { return (r + growth) * kRadiusGrowth; }

/// The texts of Counts::plan_violation.
inline constexpr const char* kFactsBroken =
    "the spheres have left the box, the range of radii or the lattice that the plan rests on";
inline constexpr const char* kFlagsBroken =
    "the plan rests on flags by which no two spheres collide, and now some do";

struct Plan {
  Method method = Method::home_phantom;
  Rule rule = Rule::lowest_cell;
  Grid grid;         // for method home_phantom
  Levels levels;     // for method half_shell, and for tiles if they do not fit
  Tiles tiles;       // for method tiles
  int key_bits = 0;  // every cell id is below 2^key_bits
  Predicate predicate = Predicate::exact;  // what the user chose
  PairTest test = PairTest::filter_safe;   // the test that this predicate needs for this scene
  Packing packing;                         // for packed tests
  PlanFacts facts;
  Capacities capacity;
  int sort_digit_bits = 9;  // the widest digit that one pass of the backend's sort takes
  int threads = 1;
  Skips allowed = Skips::all();  // what may be left out if the data show that it is not needed
  Skips taken;                   // what this plan leaves out
  bool nothing_to_find = false;  // by their flags, no two spheres may collide; stage 1 checks it
  bool moving = false;           // updates will follow, so a frame may keep data for the next one
  SkinCells skin;                // for method half_shell, if frames move
  bool count_only = false;       // keeps count and checksum and stores no pairs
  /// If more candidates than this are counted, the pair tests do not start, or stop.
  std::uint64_t candidate_limit = ~std::uint64_t{0};
};

/// What a find_pairs() counted. Counts continue past the end of a full buffer: they are the sizes
/// needed.
struct Counts {
  std::uint64_t ids = 0;
  std::uint64_t cells = 0;
  std::uint64_t candidates = 0;  // pairs of spheres looked at
  std::uint64_t uncertain_pairs = 0;
  std::uint64_t pairs = 0;
  std::uint32_t tile_records = 0;  // of the fullest tile: its spheres and copies
  bool over_candidate_limit = false;
  Skips used;  // what this run left out because its data allowed it; Plan::taken has the plan's own
               // skips
  int threads = 0;  // that worked: fewer than planned if the system gave no more; 0: unknown
  /// The skip that saved this frame a search of all spheres; none if it searched.
  std::optional<Skip> reused = {};
  /// Set if a fact of the plan, or a condition of its rule, does not hold for the data.
  std::optional<std::string> plan_violation = {};
};

/// Returns true if every buffer was large enough. A count_only plan stores neither uncertain pairs
/// nor pairs.
inline bool fits(const Counts& found, const Capacities& room, bool count_only) {
  return found.ids <= room.ids && found.cells <= room.cells &&
         found.tile_records <= room.tile_records &&
         (count_only ||
          (found.uncertain_pairs <= room.uncertain_pairs && found.pairs <= room.pairs));
}

}  // namespace octocell
