// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/trace/run_trace.hpp"

namespace octocell::trace {
namespace {

constexpr std::size_t kLineWidth = 100;

/// A row of a table: its title, and a text for each place.
struct Row {
  std::string title;
  std::vector<std::string> cells;
};

/// Writes rows with aligned places, as many places a line as fit.
std::string table(const std::vector<Row>& rows) {
  std::size_t title_width = 0;
  std::size_t cell_width = 1;
  std::size_t places = 0;
  for (const Row& row : rows) {
    title_width = std::max(title_width, row.title.size());
    places = std::max(places, row.cells.size());
    for (const std::string& cell : row.cells) cell_width = std::max(cell_width, cell.size());
  }
  const std::size_t a_line =
      std::max<std::size_t>(1, (kLineWidth - title_width - 2) / (cell_width + 1));
  std::string text;
  for (std::size_t begin = 0; begin < places; begin += a_line) {
    if (begin != 0) text += "\n";
    for (const Row& row : rows) {
      text += fmt::format("  {:<{}}", row.title, title_width);
      for (std::size_t k = begin; k < std::min(begin + a_line, row.cells.size()); ++k) {
        text += fmt::format(" {:>{}}", row.cells[k], cell_width);
      }
      text += "\n";
    }
  }
  return text;
}

template <typename T>
Row numbers(std::string title, const std::vector<T>& items) {
  Row row = {std::move(title), {}};
  for (const T& item : items) row.cells.push_back(fmt::format("{}", item));
  return row;
}

Row places(std::size_t count) {
  Row row = {"place", {}};
  for (std::size_t k = 0; k < count; ++k) row.cells.push_back(fmt::format("{}", k));
  return row;
}

/// "3H": sphere 3 in its home; "3P": in a phantom cell.
Row spheres(const std::vector<Object>& objects) {
  Row row = {"sphere", {}};
  for (const Object object : objects) {
    row.cells.push_back(
        fmt::format("{}{}", object & kIdMask, (object & kPhantom) != 0 ? 'P' : 'H'));
  }
  return row;
}

/// The words with their control bits (core/object_word.hpp).
Row words_of(const std::vector<Object>& objects) {
  Row row = {"object", {}};
  for (const Object object : objects) row.cells.push_back(fmt::format("{:08x}", object));
  return row;
}

/// On which axes this is the lowest cell that the sphere meets: "xyz", "x-z".
Row lowest(const std::vector<Object>& objects) {
  Row row = {"lowest", {}};
  for (const Object object : objects) {
    std::string axes = "xyz";
    for (std::size_t a = 0; a < 3; ++a) {
      if ((object >> (kLowestShift + a) & 1U) == 0) axes[a] = '-';
    }
    row.cells.push_back(axes);
  }
  return row;
}

std::string why_not(std::string_view what, std::string_view reason) {
  return fmt::format("  no {}: {}\n", what, reason);
}

std::string ids_text(const RecordedIds& ids) {
  if (!ids.cell_ids.exists) return why_not("cell ids", ids.cell_ids.why_not);
  return table({places(ids.cell_ids.items.size()), numbers("cell_id", ids.cell_ids.items),
                spheres(ids.objects.items)});
}

/// Also the control bits, where there are any.
std::string cell_ids_text(const RunTrace& trace) {
  const RecordedIds& ids = trace.record.ids;
  if (!ids.cell_ids.exists) return why_not("cell ids", ids.cell_ids.why_not);
  std::vector<Row> rows = {places(ids.cell_ids.items.size()),
                           numbers("cell_id", ids.cell_ids.items), spheres(ids.objects.items)};
  if (trace.plan.method == Method::home_phantom) rows.push_back(words_of(ids.objects.items));
  const bool has_lowest = trace.plan.rule == Rule::lowest_cell;
  if (trace.plan.method == Method::home_phantom && has_lowest)
    rows.push_back(lowest(ids.objects.items));
  std::string text = table(rows);
  const Recorded<chapter32::ControlBits>& bits = trace.record.control_bits;
  if (!bits.exists) return text;
  Row of_spheres = {"control bits", {}};
  for (const chapter32::ControlBits b : bits.items)
    of_spheres.cells.push_back(fmt::format("{:03x}", b));
  return text + table({of_spheres});
}

std::string pass_text(const SortPass& pass, const std::vector<std::uint32_t>& before,
                      std::size_t number) {
  const Row digits = places(pass.counts.size());
  std::string text = fmt::format("  pass {}: bits {} to {}\n", number, pass.digit.shift,
                                 pass.digit.shift + pass.digit.width - 1);
  text += table(
      {{"digit", digits.cells}, numbers("counts", pass.counts), numbers("offsets", pass.offsets)});
  text += table({numbers("goes to", destinations(pass, before))});
  return text + table({places(pass.cell_ids.size()), numbers("cell_id", pass.cell_ids),
                       spheres(pass.objects)});
}

std::string sort_text(const RunRecord& record) {
  if (!record.passes.exists) {
    return why_not("passes", record.passes.why_not) + ids_text(record.sorted);
  }
  if (record.passes.items.empty()) return "  no pass: all ids are equal\n";
  std::string text;
  const std::vector<std::uint32_t>* before = &record.ids.cell_ids.items;
  for (const SortPass& pass : record.passes.items) {
    text +=
        pass_text(pass, *before, static_cast<std::size_t>(&pass - record.passes.items.data()) + 1);
    before = &pass.cell_ids;
  }
  return text;
}

/// Writes entries below each other; `heads` names their columns.
std::string list(const std::vector<std::string>& heads,
                 const std::vector<std::vector<std::string>>& entries) {
  std::vector<std::size_t> widths;
  for (const std::string& head : heads) widths.push_back(head.size());
  for (const auto& entry : entries) {
    for (std::size_t k = 0; k < entry.size(); ++k) widths[k] = std::max(widths[k], entry[k].size());
  }
  std::string text;
  const auto write = [&](const std::vector<std::string>& line) {
    for (std::size_t k = 0; k < line.size(); ++k)
      text += fmt::format("  {:>{}}", line[k], widths[k]);
    text += "\n";
  };
  write(heads);
  for (const auto& entry : entries) write(entry);
  return text;
}

template <typename... T>
std::vector<std::string> words(const T&... values) {
  return {fmt::format("{}", values)...};
}

std::string cell_index_text(const RunRecord& record) {
  std::vector<std::vector<std::string>> entries;
  if (record.rows.exists) {
    for (const ColumnRow& row : record.rows.items)
      entries.push_back(words(row.first_id, row.begin));
    return list({"first id", "begin"}, entries);
  }
  if (!record.cells.exists) return why_not("list of cells", record.cells.why_not);
  for (const CellEntry& cell : record.cells.items) {
    entries.push_back(
        words(record.sorted.cell_ids.items[cell.begin], cell.begin, cell.homes, cell.phantoms));
  }
  return list({"cell", "begin", "H", "P"}, entries);
}

std::string pair_tests_text(const RunTrace& trace) {
  const Recorded<Considered>& considered = trace.record.considered;
  if (!considered.exists) return why_not("candidates", considered.why_not);
  std::vector<std::vector<std::string>> entries;
  for (const Considered& c : considered.items) {
    const auto [verdict, reason] = decision_on(c, trace);
    entries.push_back(words(c.cell_id, c.i, c.j, verdict, reason));
  }
  return list({"cell", "i", "j", "verdict", "reason"}, entries);
}

std::string pairs_text(std::string title, const std::vector<Pair>& pairs) {
  Row row = {std::move(title), {}};
  for (const Pair& pair : pairs) row.cells.push_back(fmt::format("({}, {})", pair.i, pair.j));
  return pairs.empty() ? fmt::format("  {}\n", row.title) : table({row});
}

std::string head_text(const RunTrace& trace) {
  const Plan& plan = trace.plan;
  const bool has_rule = plan.method == Method::home_phantom;
  return fmt::format("{}: {} spheres, {} {}{}, ids of {} bits\n", trace.scene,
                     trace.view.spheres.size(), trace.backend, name_of(plan.method),
                     has_rule ? fmt::format(" {}", name_of(plan.rule)) : "", plan.key_bits);
}

}  // namespace

std::string to_text(const RunTrace& trace) {
  const RunRecord& record = trace.record;
  const PlanFacts& facts = trace.plan.facts;
  std::string text = head_text(trace);
  text += fmt::format("\n1 bounds\n  centres {} to {}, radii up to {}\n", facts.lowest,
                      facts.highest, facts.r_max);
  text += "\n2 cell_ids (H: home, P: phantom)\n" + cell_ids_text(trace);
  text += "\n3 sort\n" + sort_text(record);
  text += "\n4 cell_index\n" + cell_index_text(record);
  text += "\n5 pair_tests\n" + pair_tests_text(trace);
  text += "\n6 resolve\n";
  const std::vector<Pair>& uncertain = record.uncertain.items;
  text += uncertain.empty() ? "  no uncertain pairs\n" : pairs_text("uncertain", uncertain);
  return text + "\npairs\n" + pairs_text(fmt::format("{} found", trace.pairs.size()), trace.pairs);
}

}  // namespace octocell::trace
