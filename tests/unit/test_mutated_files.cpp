// SPDX-License-Identifier: MIT
// Damaged files: a reader refuses a file, or reads every line of it. An oracle that shares no code
// with the readers compares the spheres with the words of each line.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "harness/files/load.hpp"
#include "tests/support/memory_file.hpp"

namespace octocell {
namespace {

using Bytes = std::string;
using Random = std::mt19937_64;

/// How many mutants of each kind of file; OCTOCELL_MUTANTS replaces it.
int mutant_count() {
  const char* asked = std::getenv("OCTOCELL_MUTANTS");
  return asked != nullptr ? static_cast<int>(std::strtoull(asked, nullptr, 10)) : 4000;
}

std::size_t below(Random& random, std::size_t n) { return n == 0 ? 0 : random() % n; }

/// What people, programs and disks put into files.
constexpr std::string_view kPieces[] = {",",        ";",
                                        "\t",       " ",
                                        "\n",       "\r\n",
                                        "\r",       "\"",
                                        "#",        "%",
                                        "-",        "+",
                                        ".",        "1e5",
                                        "e",        "nan",
                                        "inf",      "0x1",
                                        "1,5",      "1e39",
                                        "1e-50",    "x,y,z,r",
                                        "x y z",    "id",
                                        "ATOM",     "atom",
                                        "MODEL",    "END",
                                        "TER",      "\xef\xbb\xbf",
                                        "\xff\xfe", "7",
                                        "0.25",     "x",
                                        "r",        "radius",
                                        "static",   "99999999999999999999"};

Bytes mutated(Bytes bytes, Random& random) {
  for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
    const std::size_t at = below(random, bytes.size() + 1);
    const std::size_t length = 1 + below(random, 12);
    switch (below(random, 5)) {
      case 0:
        if (at < bytes.size()) bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(below(random, bytes.size() + 1), length));
        break;
      case 3:
        bytes.insert(at, kPieces[below(random, std::size(kPieces))]);
        break;
      default:
        if (below(random, 8) == 0) bytes.resize(at);
    }
  }
  return bytes;
}

std::vector<Bytes> lines_of(const Bytes& bytes) {
  std::vector<Bytes> lines(1);
  for (const char c : bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

std::vector<Bytes> words_of(const Bytes& line, std::string_view separators) {
  std::vector<Bytes> words(1);
  for (const char c : line) {
    if (separators.find(c) == std::string_view::npos) {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool is_number(const Bytes& word, float& value) {
  char* end = nullptr;
  value = std::strtof(word.c_str(), &end);
  return end != word.c_str() && *end == '\0' && word.find_first_of("xX") == Bytes::npos;
}

bool holds(const std::vector<Bytes>& words, float wanted) {
  for (const Bytes& word : words) {
    float value = 0;
    if (is_number(word, value) && value == wanted) return true;
  }
  return false;
}

bool holds_all(const std::vector<Bytes>& words, const Sphere& s) {
  return holds(words, s.x) && holds(words, s.y) && holds(words, s.z) && holds(words, s.r);
}

std::size_t numbers_among(const std::vector<Bytes>& words) {
  float ignored = 0;
  std::size_t count = 0;
  for (const Bytes& word : words) count += is_number(word, ignored) ? 1 : 0;
  return count;
}

/// The words of the lines that must be spheres of a table: all with a number before the comment.
/// The first line may be a header, and have an odd name with a number in it.
std::vector<std::vector<Bytes>> rows_of_table(const Bytes& bytes) {
  std::vector<std::vector<Bytes>> rows;
  bool is_first = true;
  for (const Bytes& line : lines_of(bytes)) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == Bytes::npos || line[begin] == '%' || line[begin] == '#') continue;
    const auto words = words_of(line.substr(0, line.find('#')), ",; \t\r\"");
    if (numbers_among(words) >= (is_first ? 3 : 1)) rows.push_back(words);
    is_first = false;
  }
  return rows;
}

Bytes in_lower_case(Bytes word) {
  for (char& c : word) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 'a' - 'A');
  }
  return word;
}

/// The words of the atoms of the first frame.
std::vector<std::vector<Bytes>> rows_of_pqr(const Bytes& bytes) {
  std::vector<std::vector<Bytes>> rows;
  bool is_model = false;
  for (const Bytes& line : lines_of(bytes)) {
    const auto words = words_of(line, " \t\r");
    if (words.empty()) continue;
    const Bytes record = in_lower_case(words.front());
    if (record.starts_with("atom") || record.starts_with("hetatm")) rows.push_back(words);
    const bool is_border = record == "model" || record == "endmdl" || record == "end";
    if (is_border && (is_model || !rows.empty())) return rows;
    if (is_border) is_model = record == "model";
  }
  return rows;
}

/// Empty if the spheres are those of the rows, in their order.
std::string difference(const std::vector<Sphere>& spheres,
                       const std::vector<std::vector<Bytes>>& rows) {
  if (spheres.size() != rows.size()) {
    return fmt::format("{} spheres of {} lines", spheres.size(), rows.size());
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!holds_all(rows[i], spheres[i])) return fmt::format("sphere {} has other numbers", i);
  }
  return "";
}

/// Tries mutants of the seeds. `wrong_in` compares what was read with the bytes.
template <typename WrongIn>
void try_mutants(const std::vector<Bytes>& seeds, const LoadOptions& options, WrongIn wrong_in) {
  Random random(42);
  const int count = mutant_count();
  int read = 0;
  for (int k = 0; k < count && !testing::Test::HasFailure(); ++k) {
    const Bytes bytes = mutated(seeds[below(random, seeds.size())], random);
    const MemoryFile file(bytes.data(), bytes.size());
    try {
      const Scene scene = load_scene(file.path(), options);
      ++read;
      EXPECT_EQ(wrong_in(scene.spheres, bytes), "") << "mutant " << k << ":\n" << bytes;
    } catch (const InputError& refusal) {
      const std::string what = refusal.what();
      EXPECT_TRUE(what.starts_with(file.path())) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }
  EXPECT_GT(read, count / 30) << "most mutants are refused: nothing is compared";
  EXPECT_LT(read, count - count / 30);
}

const std::vector<Bytes> kTables = {
    "x,y,z,r\n1.5,-2,0.25,0.5\n3,1e-3,7,2\n",
    "# x y z r\n1.5 -2 0.25 0.5\n3 1e-3 7 2\n",
    "r;z;y;x\n0.5;0.25;-2;1.5\n2;7;1e-3;3\n",
    ",x,y,z,radius,name\n0,1.5,-2,0.25,0.5,\"a\"\n1,3,1e-3,7,2,b\n",
    "\tx\ty\tz\tr\n0\t1.5\t-2\t0.25\t0.5\n1\t3\t1e-3\t7\t2\n",
    "#format id_x_y_z_r_matId\n4\t1.5\t-2\t0.25\t0.5\t1\n5\t3\t1e-3\t7\t2\t1\n",
    "9 1.5 -2 0.25 0.5\n4 3 1e-3 7 2\n8 2.5 1 1 0.125\n",
    "x,y,z,r,static,group,mask\n1.5,-2,0.25,0.5,1,3,65535\n3,1e-3,7,2,0,1,1\n",
};
const std::vector<Bytes> kPqr = {
    "REMARK 1\nATOM 1 N GLY A 1 1.5 -2 0.25 0.1 0.5\nATOM 2 C GLY A 1 3 1e-3 7 -0.25 2\nEND\n",
    "MODEL 1\nATOM 1 N GLY 1 1.5 -2 0.25 0.1 0.5\nENDMDL\nMODEL 2\natom 1 N GLY 1 9 8 7 6 "
    "5\nENDMDL\n",
    "HETATM10000 O HOH A 1 1.5 -2 0.25 -0.8 1.5\nTER\nHETATM10001 O HOH A 2 3 4 5 -0.8 1.25\n",
};

Bytes array_of_two() {
  Bytes dictionary = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4), }";
  dictionary.resize(117, ' ');
  const Sphere spheres[] = {{1.5F, -2, 0.25F, 0.5F}, {3, 1e-3F, 7, 2}};
  Bytes bytes = Bytes("\x93NUMPY\x01\x00\x76\x00", 10) + dictionary + "\n";
  return bytes.append(reinterpret_cast<const char*>(spheres), sizeof spheres);
}

TEST(MutatedFiles, OfTablesAreRefusedOrReadLineByLine) {
  try_mutants(kTables, {.format = Format::table},
              [](const std::vector<Sphere>& spheres, const Bytes& bytes) {
                return difference(spheres, rows_of_table(bytes));
              });
}

TEST(MutatedFiles, OfPqrAreRefusedOrReadLineByLine) {
  try_mutants(kPqr, {.format = Format::pqr},
              [](const std::vector<Sphere>& spheres, const Bytes& bytes) {
                return difference(spheres, rows_of_pqr(bytes));
              });
}

TEST(MutatedFiles, OfArraysAreRefusedOrReadToTheLastByte) {
  try_mutants({array_of_two()}, {.format = Format::npy},
              [](const std::vector<Sphere>& spheres, const Bytes& bytes) {
                const std::size_t size = spheres.size() * sizeof(Sphere);
                const bool is_tail =
                    size < bytes.size() &&
                    std::memcmp(bytes.data() + bytes.size() - size, spheres.data(), size) == 0;
                return Bytes(is_tail ? "" : "other numbers");
              });
}

}  // namespace
}  // namespace octocell
