// SPDX-License-Identifier: MIT
// PQR: atoms with charge and radius, as PDB2PQR writes them and APBS reads them:
//   ATOM|HETATM serial name residue [chain] residue_number x y z charge radius
// The fields are separated by blanks. All other records are skipped.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/available_memory.hpp"
#include "core/text.hpp"
#include "harness/files/decimal.hpp"
#include "harness/files/line_reader.hpp"
#include "harness/files/load_formats.hpp"
#include "harness/files/validate.hpp"

namespace octocell {
namespace {

constexpr std::size_t kFieldsWithoutChain = 10;

struct Record {
  std::string_view text;
  std::size_t line;  // from 1
};

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> words;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) return words;
    const std::size_t length = std::min(text.find_first_of(kBlanks), text.size());
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
}

float number_in(const InputFile& file, const Record& record, std::string_view word) {
  const DecimalFloat parsed = parse_float(word);
  if (parsed.kind == DecimalFloat::Kind::number) return parsed.value;
  const bool too_large = parsed.kind == DecimalFloat::Kind::too_large;
  file.refuse(record.line, fmt::format("{} is {}: {}", quote(word),
                                       too_large ? "too large for float32" : "not a number",
                                       quote(record.text)));
}

Sphere atom_in(const InputFile& file, const Record& record) {
  const std::vector<std::string_view> words = words_of(record.text);
  if (words.size() != kFieldsWithoutChain && words.size() != kFieldsWithoutChain + 1) {
    file.refuse(record.line,
                fmt::format("{} fields, expected {} or, with a chain, {}: {}", words.size(),
                            kFieldsWithoutChain, kFieldsWithoutChain + 1, quote(record.text)));
  }
  float last_five[5];  // x, y, z, charge, radius
  for (std::size_t k = 0; k < 5; ++k) {
    last_five[k] = number_in(file, record, words[words.size() - 5 + k]);
  }
  const Sphere atom{last_five[0], last_five[1], last_five[2], last_five[4]};
  if (const std::string flaw = flaw_of(atom); !flaw.empty()) {
    file.refuse(record.line, fmt::format("{}: {}", flaw, quote(record.text)));
  }
  return atom;
}

bool is_atom(std::string_view line) {
  return line.starts_with("ATOM") || line.starts_with("HETATM");
}

}  // namespace

std::vector<Sphere> load_pqr(InputFile& file) {
  LineReader lines(file);
  std::vector<Sphere> spheres;
  while (const auto line = lines.next()) {
    if (!is_atom(*line)) continue;
    if (spheres.size() == kMaxSpheres) {
      file.refuse(lines.number(), fmt::format("more than {} spheres", kMaxSpheres));
    }
    append_within_memory(spheres, atom_in(file, {trim(*line), lines.number()}), file.path());
  }
  if (spheres.empty()) file.refuse("no ATOM and no HETATM record");
  return spheres;
}

}  // namespace octocell
