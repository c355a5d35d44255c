// SPDX-License-Identifier: MIT
// PQR: atoms with charge and radius, as PDB2PQR writes them and APBS reads them, in words:
//   ATOM|HETATM serial name residue [chain] residue_number x y z charge radius
// Upper and lower case are the same. From serial 10000 on, there is no blank behind HETATM. Other
// records of PDB are skipped. An unknown record is refused, because it may be a misspelled atom.
// Models (MODEL, ENDMDL, END) are frames.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

using Words = std::vector<std::string_view>;

constexpr std::size_t kWordsWithoutChain = 10;

/// All other records of the PDB format (3.30), and some that programs add.
constexpr std::string_view kSkipped[] = {
    "anisou", "author", "caveat", "cispep", "compnd", "conect", "cryst1", "dbref",  "dbref1",
    "dbref2", "expdta", "formul", "header", "helix",  "het",    "hetnam", "hetsyn", "jrnl",
    "keywds", "link",   "master", "mdltyp", "modres", "mtrix1", "mtrix2", "mtrix3", "nummdl",
    "obslte", "origx1", "origx2", "origx3", "remark", "revdat", "scale1", "scale2", "scale3",
    "seqadv", "seqres", "sheet",  "site",   "source", "splt",   "split",  "sprsde", "ssbond",
    "ter",    "title",  "user",   "turn",   "slbrig", "sigatm", "siguij", "hydbnd", "tvect"};

void split_words(std::string_view text, Words& words) {
  words.clear();
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (text.empty()) return;
    const std::size_t length = std::min(text.find_first_of(" \t"), text.size());
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
}

/// Returns true for ATOM and HETATM. Splits a serial off that follows without a blank.
bool is_atom(Words& words) {
  for (const std::string_view name : {"atom", "hetatm"}) {
    const std::string_view word = words.front();
    if (lower_case(word.substr(0, name.size())) != name) continue;
    const std::string_view serial = word.substr(name.size());
    if (serial.empty()) return true;
    if (serial.find_first_not_of("0123456789") != std::string_view::npos) continue;
    words.insert(words.begin() + 1, serial);
    return true;
  }
  return false;
}

bool is_skipped(const std::string& word) {
  return word.starts_with('#') || std::ranges::find(kSkipped, word) != std::end(kSkipped) ||
         word.starts_with("remark");
}

class PqrReader {
 public:
  PqrReader(InputFile& file, const LoadOptions& options)
      : file_(file), options_(options), lines_(file) {}

  void read(Scene& scene) {
    while (const auto line = lines_.next()) {
      line_ = trim(*line);
      split_words(line_, words_);
      if (words_.empty()) continue;
      if (is_atom(words_)) {
        add_atom(scene.spheres);
      } else {
        take_record(lower_case(words_.front()));
      }
    }
    end_frame();
    if (frames_ == 0) file_.refuse("no ATOM and no HETATM record");
    if (options_.frame >= frames_) {
      file_.refuse(fmt::format("no frame {}: it has {}, counted from 0", options_.frame, frames_));
    }
    if (frames_ > 1) scene.notes.push_back(fmt::format("frame {} of {}", options_.frame, frames_));
  }

 private:
  void take_record(const std::string& record) {
    if (record == "model" || record == "endmdl" || record == "end") {
      end_frame();
      is_model_ = record == "model";
    } else if (!is_skipped(record)) {
      refuse(fmt::format("{} is no record of PQR", quote(words_.front())));
    }
  }

  /// Counts a frame, also for a model without atoms.
  void end_frame() {
    if (has_atoms_ || is_model_) ++frames_;
    has_atoms_ = is_model_ = false;
  }

  void add_atom(std::vector<Sphere>& spheres) {
    has_atoms_ = true;
    const Sphere atom = atom_in_line();
    if (frames_ != options_.frame) return;
    if (spheres.size() == kMaxSpheres) refuse(fmt::format("more than {} spheres", kMaxSpheres));
    append_within_memory(spheres, atom, file_.path());
  }

  [[nodiscard]] Sphere atom_in_line() const {
    const std::size_t count = words_.size();
    if (count != kWordsWithoutChain && count != kWordsWithoutChain + 1) {
      refuse(fmt::format("{} fields, expected {} or, with a chain, {}", count, kWordsWithoutChain,
                         kWordsWithoutChain + 1));
    }
    float last_five[5];  // x, y, z, charge, radius
    for (std::size_t k = 0; k < 5; ++k) last_five[k] = number_in(words_[count - 5 + k]);
    const Sphere atom{last_five[0], last_five[1], last_five[2], last_five[4]};
    const std::string flaw = flaw_of(atom);
    if (!flaw.empty() && !options_.drop_invalid) refuse(flaw);
    return atom;
  }

  [[nodiscard]] float number_in(std::string_view word) const {
    const DecimalFloat parsed = parse_float(word);
    if (parsed.kind == DecimalFloat::Kind::number) return parsed.value;
    const bool too_large = parsed.kind == DecimalFloat::Kind::too_large;
    if (too_large && options_.drop_invalid) return parsed.value;
    refuse(
        fmt::format("{} is {}", quote(word), too_large ? "too large for float32" : "not a number"));
  }

  [[noreturn]] void refuse(const std::string& why) const {
    file_.refuse(lines_.number(), fmt::format("{}: {}", why, quote(line_)));
  }

  InputFile& file_;
  const LoadOptions& options_;
  LineReader lines_;
  std::string_view line_ = {};
  Words words_ = {};
  std::uint64_t frames_ = 0;  // complete ones
  bool has_atoms_ = false;    // in the present frame
  bool is_model_ = false;     // the present frame began with MODEL
};

}  // namespace

void load_pqr(InputFile& file, const LoadOptions& options, Scene& scene) {
  PqrReader(file, options).read(scene);
}

}  // namespace octocell
