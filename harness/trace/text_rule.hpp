// SPDX-License-Identifier: MIT
// The course text's rule for two spheres, with its mistakes or with some of them mended, as the
// steps of course/pipeline mend them; and which mistake loses a pair: the one without which the
// rule would find it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/sphere.hpp"

namespace octocell::trace {

/// How a coordinate becomes the number of a cell.
enum class CellNumber : std::uint8_t {
  saturated,  // cast to unsigned, as a GPU does: a negative one gives 0
  truncated,  // cast to signed: toward zero
  floored,
};

/// The home cells of a scene span this box. Cells outside it hold no home.
struct CellBox {
  std::array<long, 3> first;
  std::array<long, 3> last;
};

/// Where a pair is tested.
enum class TestedWhere : std::uint8_t {
  larger_home,  // home with home; home with phantom if the phantom's home id is the larger
  any_home,     // home with home, home with phantom
  any_cell,     // phantoms with phantoms, too
};

struct TextRule {
  float side;
  float scale = 1.0F;  // of a ball when its phantoms are listed
  CellNumber number = CellNumber::saturated;
  bool has_unique_ids = false;  // instead of fields of 10 bits, joined by OR
  bool has_all_slots = false;   // room for every phantom
  TestedWhere tested = TestedWhere::larger_home;
  std::optional<CellBox> box = {};  // cells outside are left out, and ids count from its first cell
};

/// Ids in their order. The text joins three coordinates into one number; unique ids are z, y, x.
using CellKey = std::array<long, 3>;

struct TextEntry {
  std::array<long, 3> cell;
  CellKey id;
};

/// The cells in which a sphere is listed, the home first.
using TextListing = std::vector<TextEntry>;
TextListing list(const TextRule& rule, const Sphere& sphere);

std::array<long, 3> home_cell(const TextRule& rule, const Sphere& sphere);

/// Returns whether entry k of a is tested with entry l of b, which has the same id.
bool is_tested(const TextRule& rule, const TextListing& a, std::size_t k, const TextListing& b,
               std::size_t l);

/// Calls use(k, l) for each entry k of a and l of b that have the same id.
template <typename Use>
void for_each_meeting(const TextListing& a, const TextListing& b, Use use) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t l = 0; l < b.size(); ++l) {
      if (a[k].id == b[l].id) use(k, l);
    }
  }
}

/// Returns how often the rule tests the pair.
int times_tested(const TextRule& rule, const Sphere& a, const Sphere& b);

/// Which of the text's mistakes loses the pair, or gives it twice.
struct Flaw {
  std::string_view name;
  std::string_view explanation;
};
/// Needs a pair that the rule does not test exactly once.
Flaw flaw_of(const TextRule& rule, const Sphere& a, const Sphere& b);

}  // namespace octocell::trace
