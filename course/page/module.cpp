// SPDX-License-Identifier: MIT
// What the page calls: spheres in, a trace as JSON out. Built for WebAssembly, and natively for
// tests: scripts/build_page_module.sh has both commands.
#include <cstdint>
#include <string>
#include <vector>

#include "course/page/trace.hpp"

namespace {

using namespace course;

std::vector<Sphere> spheres;
std::string text;
double numbers[5];

void add(std::uint64_t value) { text += std::to_string(value); }

/// Writes "name":[...], with one value for each item.
template <typename Items, typename Write>
void array(const char* name, const Items& items, Write write) {
  text += '"';
  text += name;
  text += "\":[";
  bool is_first = true;
  for (const auto& item : items) {
    if (!is_first) text += ',';
    is_first = false;
    write(item);
  }
  text += ']';
}

void whole_numbers(const char* name, const std::vector<std::uint32_t>& values) {
  array(name, values, [](std::uint32_t value) { add(value); });
}

void entries(const std::vector<Entry>& all) {
  array("cell_ids", all, [](const Entry& e) { add(e.cell_id); });
  text += ',';
  array("objects", all, [](const Entry& e) {
    if (e.cell_id == kEmpty) {
      text += "null";
      return;
    }
    text += "{\"sphere\":";
    add(e.sphere);
    text += e.is_phantom ? ",\"phantom\":true,\"cell\":[" : ",\"phantom\":false,\"cell\":[";
    add(e.cell.x);
    text += ',';
    add(e.cell.y);
    text += ',';
    add(e.cell.z);
    text += "]}";
  });
}

void passes(const Trace& t) {
  array("passes", t.passes, [](const Pass& pass) {
    text += "{\"shift\":";
    add(static_cast<std::uint64_t>(pass.shift));
    text += ",\"bits\":";
    add(static_cast<std::uint64_t>(pass.bits));
    text += ',';
    whole_numbers("counts", pass.counts);
    text += ',';
    whole_numbers("offsets", pass.offsets);
    text += ',';
    whole_numbers("places", pass.places);
    text += ',';
    entries(pass.entries);
    text += '}';
  });
}

constexpr const char* kVerdicts[] = {"passed over", "apart", "overlap"};
constexpr const char* kReasons[] = {"home with home",
                                    "the phantom has the larger home id",
                                    "the phantom has the smaller home id",
                                    "both are phantoms",
                                    "a home of lower type holds both",
                                    "no home of lower type holds both",
                                    "lowest common cell",
                                    "not the lowest common cell",
                                    "same row",
                                    "neighbouring row"};

void pairs(const char* name, const std::vector<Pair>& all) {
  array(name, all, [](Pair p) {
    text += '[';
    add(p.i);
    text += ',';
    add(p.j);
    text += ']';
  });
}

void stages(const Trace& t) {
  text += "\"stages\":{\"cell_ids\":{";
  entries(t.entries);
  text += "},\"sort\":{";
  passes(t);
  text += "},\"cell_index\":{";
  array("cells", t.cells, [](const IndexCell& c) {
    text += "{\"cell\":";
    add(c.cell_id);
    text += ",\"begin\":";
    add(c.begin);
    text += ",\"homes\":";
    add(c.homes);
    text += ",\"phantoms\":";
    add(c.phantoms);
    text += '}';
  });
  text += "},\"pair_tests\":{";
  array("considered", t.considered, [](const Considered& c) {
    text += "{\"i\":";
    add(c.i);
    text += ",\"j\":";
    add(c.j);
    text += ",\"cell\":";
    add(c.cell_id);
    text += ",\"verdict\":\"";
    text += kVerdicts[static_cast<int>(c.verdict)];
    text += "\",\"reason\":\"";
    text += kReasons[static_cast<int>(c.reason)];
    text += "\"}";
  });
  text += "}}";
}

}  // namespace

extern "C" {

/// Returns room for `count` spheres: four floats each.
Sphere* room_for(std::uint32_t count) {
  spheres.resize(count);
  return spheres.data();
}

/// Traces them by rule 0 to 3 of course::Rule. Returns JSON; its length is text_length().
const char* trace(std::uint32_t rule, double side) {
  const Trace t = trace_scene(spheres, static_cast<Rule>(rule), side);
  text = "{";
  stages(t);
  text += ',';
  pairs("pairs", t.pairs);
  text += ',';
  pairs("exact", exact_pairs(spheres));
  text += ",\"counts\":[";
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) text += ',';
    add(t.counts[axis]);
    numbers[axis] = t.corner[axis];
  }
  text += "],\"key_bits\":";
  add(static_cast<std::uint64_t>(t.key_bits));
  text += '}';
  numbers[3] = t.side;
  numbers[4] = t.column;
  return text.data();
}

std::uint32_t text_length() { return static_cast<std::uint32_t>(text.size()); }

/// The corner of cell (0, 0, 0), the side of a cell, the width of a column.
const double* grid_numbers() { return numbers; }
}
