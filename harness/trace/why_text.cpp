// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "harness/trace/why.hpp"

namespace octocell::trace {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kDeciders = {"plain float32, exact on this lattice",
                                                       "float32 with an error bound",
                                                       "float64 with an error bound",
                                                       "float64, without any rounding",
                                                       "integers",
                                                       "the predicate that was chosen"};

std::string_view text_of(DecidedBy by) { return kDeciders[static_cast<std::size_t>(by)]; }

std::string text_of(Cell c) { return fmt::format("({}, {}, {})", c.x, c.y, c.z); }

std::string method_of(const Account& a) {
  if (a.method != Method::home_phantom) return std::string(name_of(a.method));
  return fmt::format("{}, rule {}", name_of(a.method), name_of(a.rule));
}

/// All digits where that is short, else six and "...".
std::string short_digits(const std::string& digits) {
  constexpr std::size_t kShort = 40;
  return digits.size() <= kShort ? digits : digits.substr(0, kShort) + "...";
}

std::string lines_of(const ListedSphere& s) {
  std::string text = fmt::format("sphere {:<5} at ({}, {}, {}), radius {}\n", s.id, s.sphere.x,
                                 s.sphere.y, s.sphere.z, s.sphere.r);
  for (const ListedCell& c : s.cells) {
    text +=
        fmt::format("  {:<8} {}, id {}\n", c.is_home ? "home" : "phantom", text_of(c.cell), c.id);
  }
  if (s.cell_count > s.cells.size())
    text += fmt::format("  and {} more\n", s.cell_count - s.cells.size());
  return text;
}

std::string overlap_line(const Overlap& o) {
  const std::string_view sign = o.distance2 == o.radius_sum2 ? "=" : o.answer ? "<" : ">";
  return fmt::format(
      "overlap      {}: distance^2 = {} {} {} = (radius sum)^2, so {:.9g} {} {:.9g}; "
      "decided by {}\n",
      o.answer ? "yes" : "no", short_digits(o.distance2), sign, short_digits(o.radius_sum2),
      o.distance, sign, o.radius_sum, text_of(o.decided_by));
}

std::string roles_of(const Meeting& m, const Account& a) {
  if (m.home_of_i && m.home_of_j) return "home of both";
  if (m.home_of_i) return fmt::format("home of {}", a.i.id);
  if (m.home_of_j) return fmt::format("home of {}", a.j.id);
  return "home of neither";
}

std::string meetings_of(const Account& a) {
  if (a.method == Method::brute_force) return "meet         every pair is tested\n";
  if (a.meetings.empty()) return "meet         in no cell\n";
  std::string text;
  for (const Meeting& m : a.meetings) {
    text += fmt::format("meet         {}, id {}, {}: {}\n", text_of(m.cell), m.id, roles_of(m, a),
                        m.reason);
  }
  if (a.meeting_count > a.meetings.size())
    text += fmt::format("             and in {} more cells\n", a.meeting_count - a.meetings.size());
  return text;
}

std::string answer_line(const Account& a) {
  const std::uint64_t times = a.times_found();
  if (!a.overlap.answer) return "found        no, and rightly: they are apart\n";
  if (!a.may_collide) return "found        no, and rightly: by their flags they do not collide\n";
  if (times == 1) return "found        once, as it should be\n";
  if (times == 0) return "found        no: this pair is LOST\n";
  return fmt::format("found        {} times: this pair is a DUPLICATE\n", times);
}

Json to_json(Cell c) { return Json::array({c.x, c.y, c.z}); }

Json to_json(const ListedSphere& s) {
  Json cells = Json::array();
  for (const ListedCell& c : s.cells)
    cells.push_back({{"cell", to_json(c.cell)}, {"id", c.id}, {"home", c.is_home}});
  return {{"id", s.id},      {"x", s.sphere.x}, {"y", s.sphere.y},           {"z", s.sphere.z},
          {"r", s.sphere.r}, {"cells", cells},  {"cell_count", s.cell_count}};
}

Json to_json(const Overlap& o) {
  return {{"answer", o.answer},       {"decided_by", text_of(o.decided_by)},
          {"distance2", o.distance2}, {"radius_sum2", o.radius_sum2},
          {"distance", o.distance},   {"radius_sum", o.radius_sum}};
}

}  // namespace

std::string to_text(const Account& a, std::string_view scene) {
  std::string text = fmt::format("scene        {}\nmethod       {}\ncells        {}\n", scene,
                                 method_of(a), a.cells);
  if (a.method != Method::brute_force) text += lines_of(a.i) + lines_of(a.j);
  text += overlap_line(a.overlap) + meetings_of(a) + answer_line(a);
  if (a.flaw) text += fmt::format("flaw         {}: {}\n", a.flaw->name, a.flaw->explanation);
  return text;
}

Json to_json(const Account& a, std::string_view scene) {
  Json meetings = Json::array();
  for (const Meeting& m : a.meetings) {
    meetings.push_back({{"cell", to_json(m.cell)},
                        {"id", m.id},
                        {"home_of_i", m.home_of_i},
                        {"home_of_j", m.home_of_j},
                        {"tested", m.tested},
                        {"reason", m.reason}});
  }
  const bool has_rule = a.method == Method::home_phantom;
  return {{"scene", scene},
          {"i", a.i.id},
          {"j", a.j.id},
          {"method", name_of(a.method)},
          {"rule", has_rule ? Json(name_of(a.rule)) : Json()},
          {"cells", a.cells},
          {"spheres", Json::array({to_json(a.i), to_json(a.j)})},
          {"overlap", to_json(a.overlap)},
          {"may_collide", a.may_collide},
          {"meetings", meetings},
          {"meeting_count", a.meeting_count},
          {"times_found", a.times_found()},
          {"should_be_found", a.should_be_found()},
          {"flaw",
           a.flaw ? Json{{"name", a.flaw->name}, {"explanation", a.flaw->explanation}} : Json()}};
}

}  // namespace octocell::trace
