// SPDX-License-Identifier: MIT
// Files: which are read, and which are refused and why.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "harness/files/load.hpp"
#include "harness/files/validate.hpp"
#include "tests/support/scene_folder.hpp"

namespace octocell {
namespace {

void expect_equal(const Sphere& s, float x, float y, float z, float r) {
  EXPECT_EQ(s.x, x);
  EXPECT_EQ(s.y, y);
  EXPECT_EQ(s.z, z);
  EXPECT_EQ(s.r, r);
}

std::string npy(const std::string& dictionary, const std::string& numbers, int version = 1) {
  std::string length = bytes_of(static_cast<std::uint32_t>(dictionary.size()));
  if (version == 1) length.resize(2);
  return std::string("\x93NUMPY") + static_cast<char>(version) + '\0' + length + dictionary +
         numbers;
}

const std::string kOneRow = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 4), }   \n";
const std::string kOneDoubleRow = "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 4), }\n";
const std::string kOne = bytes_of(1.0F, -2.0F, 3.5F, 0.25F);

TEST_F(SceneFiles, NpyVersionsAreRead) {
  for (const int version : {1, 2, 3}) {
    const Scene scene = load_scene(write("one.npy", npy(kOneRow, kOne, version)));
    EXPECT_EQ(scene.name, "one");
    EXPECT_EQ(scene.spec, path("one.npy"));
    ASSERT_EQ(scene.spheres.size(), 1U);
    expect_equal(scene.spheres[0], 1.0F, -2.0F, 3.5F, 0.25F);
  }
  const std::string other = R"({"shape":(1,4),"fortran_order":False,"descr":"<f4"})";
  EXPECT_EQ(load_scene(write("other.npy", npy(other, kOne))).spheres.size(), 1U);
  const std::string none = "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 4), }\n";
  EXPECT_TRUE(load_scene(write("none.npy", npy(none, ""))).spheres.empty());
}

TEST_F(SceneFiles, DamagedNpyIsRefused) {
  const auto refuse = [&](const std::string& bytes, const std::string& reason) {
    expect_refusal(write("bad.npy", bytes), reason);
  };
  refuse("", "is empty");
  refuse("x,y,z,r\n1,2,3,4\n", "not an NPY file: it begins with 'x,y,z,'");
  refuse("\x93NU", "not an NPY file");
  refuse(std::string("\x93NUMPY\x01\0", 8), "truncated: the NPY header is not complete");
  refuse(npy(kOneRow, kOne, 4), "NPY version 4.0, expected 1.0, 2.0 or 3.0");
  refuse(npy(kOneRow, kOne).substr(0, 40), "truncated: the NPY header is not complete");
  refuse(npy(kOneRow, kOne.substr(1)), "truncated: shape (1, 4) needs");
  refuse(npy(kOneRow, kOne + "x"), "too long: shape (1, 4) needs");
  refuse(npy(std::string(70000, ' '), kOne, 2), "NPY header of 70000 bytes");
}

TEST_F(SceneFiles, OtherNpyLayoutsAreRefused) {
  const auto refuse = [&](const std::string& type, const std::string& order,
                          const std::string& shape, const std::string& reason) {
    const std::string header =
        "{'descr': " + type + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
    expect_refusal(write("bad.npy", npy(header, kOne)), reason);
  };
  refuse("'<f8'", "False", "(1, 4)", "'<f8', expected '<f4' (float32); --round-input");
  refuse("'>f4'", "False", "(1, 4)", "big-endian");
  refuse("'<i4'", "False", "(1, 4)", "numbers of type '<i4', expected '<f4'");
  refuse("[('x', '<f4')]", "False", "(1,)", "expected one type for all numbers");
  refuse("'<f4'", "True", "(1, 4)", "Fortran order, expected C order");
  refuse("'<f4'", "False", "(4,)", "shape (4,), expected (n, 4)");
  refuse("'<f4'", "False", "(4, 1)", "shape (4, 1), expected (n, 4)");
  refuse("'<f4'", "False", "(1, 4, 1)", "shape (1, 4, 1), expected (n, 4)");
  refuse("'<f4'", "False", "()", "shape (), expected (n, 4)");
  refuse("'<f4'", "False", "(268435457, 4)", "268435457 spheres (at most 268435456)");
  refuse("'<f4'", "False", "(268435456, 4)", "truncated");
  refuse("'<f4'", "False", "(99999999999999999999, 4)", "expected a whole number");
  refuse("'<f4'", "False", "(-1, 4)", "expected a whole number, found '-1, 4)");
  refuse("'<f4'", "Maybe", "(1, 4)", "expected True or False, found 'Maybe");
}

TEST_F(SceneFiles, GarbageInTheNpyHeaderIsRefused) {
  const auto refuse = [&](const std::string& dictionary, const std::string& reason) {
    expect_refusal(write("bad.npy", npy(dictionary, kOne)), reason);
  };
  refuse("", "expected '{', found its end");
  refuse("{}", "expected the keys descr, fortran_order and shape");
  refuse("{'descr': '<f4', 'shape': (1, 4)}", "expected the keys");
  refuse("{'descr': '<f4', 'descr': '<f4'}", "expected 'descr' only once");
  refuse("{'colour': 1}", "instead of 'colour'");
  refuse("{'descr' '<f4'}", "expected ':'");
  refuse("{'descr': '<f4", "expected a closing quote");
  refuse("{'descr': '<f4' 'shape': (1, 4)}", "expected '}'");
  refuse(kOneRow.substr(0, kOneRow.size() - 1) + "x\n", "expected nothing after '}', found 'x'");
}

TEST_F(SceneFiles, NpyWithABadSphereIsRefused) {
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 4), }\n";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const auto refuse = [&](const std::string& second, const std::string& reason) {
    expect_refusal(write("bad.npy", npy(header, kOne + second)), reason);
  };
  refuse(bytes_of(0.0F, 0.0F, 0.0F, -0.5F), "sphere 1: r is -0.5 (must be >= 0)");
  refuse(bytes_of(0.0F, nan, 0.0F, 1.0F), "sphere 1: y is nan (must be finite)");
  refuse(bytes_of(0.0F, 0.0F, -inf, 1.0F), "sphere 1: z is -inf (must be finite)");
  refuse(bytes_of(0.0F, 0.0F, 0.0F, inf), "sphere 1: r is inf (must be finite)");
}

TEST_F(SceneFiles, DoublesAreRoundedOnRequestOnly) {
  const std::string file =
      write("d.npy", npy(kOneDoubleRow, bytes_of(0.1, 1.0 + 0x1p-24, -1e-60, 2.5)));
  expect_refusal(file, "--round-input");
  const Scene scene = load_scene(file, {.round_input = true});
  expect_equal(scene.spheres.at(0), 0.1F, 1.0F, -0.0F, 2.5F);
  ASSERT_TRUE(scene.unrounded.has_value());
  EXPECT_EQ(scene.unrounded->at(0).x, 0.1);
  EXPECT_EQ(scene.unrounded->at(0).y, 1.0 + 0x1p-24);
  const auto refuse = [&](const std::string& row, const std::string& reason) {
    expect_refusal(write("bad.npy", npy(kOneDoubleRow, row)), reason, {.round_input = true});
  };
  refuse(bytes_of(0.0, 1e39, 0.0, 1.0), "sphere 0: y is 1e+39 (float32 ends at 3.4e38)");
  refuse(bytes_of(0.0, 0.0, 0.0, -1e-300), "sphere 0: r is -1e-300 (must be >= 0)");
  EXPECT_FALSE(load_scene(write("f.npy", npy(kOneRow, kOne)), {.round_input = true}).unrounded);
}

TEST_F(SceneFiles, CsvIsReadWithAndWithoutHeader) {
  for (const char* text :
       {"x,y,z,r\n1,-2,3.5,0.25\n", "1,-2,3.5,0.25", "X, Y, Z, R\r\n1,-2,3.5,.25\r\n",
        "# x,y,z,r\n\n  1 ,-2,\t3.5 , +2.5e-1 # a comment\n\n", "r,z,y,x\n0.25,3.5,-2,1\n",
        "# r,z,y,x\n0.25,3.5,-2,1\n", "\xef\xbb\xbfx,y,z,r\n1,-2,3.5,0.25\n"}) {
    const Scene scene = load_scene(write("one.csv", text));
    ASSERT_EQ(scene.spheres.size(), 1U) << text;
    expect_equal(scene.spheres[0], 1.0F, -2.0F, 3.5F, 0.25F);
  }
  EXPECT_TRUE(load_scene(write("none.csv", "x,y,z,r\n")).spheres.empty());
}

TEST_F(SceneFiles, DecimalsAreRoundedOnce) {
  // 1 + 2^-24 and a little: via double this would be rounded twice, down to 1.
  const Scene scene = load_scene(
      write("round.csv",
            "1.000000059604644775390625000000000000001,1.000000059604644775390625,0.1,0\n"
            "1e-50,-1e-400,1e-45,0.7e-45\n"
            "3.4028235e38,3.40282356e38,1.17549435e-38,16777217\n"));
  expect_equal(scene.spheres.at(0), 1.0F + 0x1p-23F, 1.0F, 0.1F, 0.0F);
  expect_equal(scene.spheres.at(1), 0.0F, 0.0F, 0x1p-149F, 0.0F);
  EXPECT_TRUE(std::signbit(scene.spheres.at(1).y));
  const float largest = std::numeric_limits<float>::max();
  expect_equal(scene.spheres.at(2), largest, largest, 0x1p-126F, 16777216.0F);
}

TEST_F(SceneFiles, BadCsvIsRefusedWithItsLine) {
  expect_csv_refusal("", "is empty");
  expect_csv_refusal("\n \n# nothing\n", "neither a header nor a sphere");
  expect_csv_refusal("x,y,z,r\n1,2,3\n",
                     ":2: 3 fields, expected 4 with commas between (x,y,z,r): '1,2,3'");
  expect_csv_refusal("\n\n1,2,3,4,5\n", ":3: 5 fields and no header");
  expect_csv_refusal("1,2,3,4\n1 2 3 4\n", ":2: 1 field, expected 4");
  expect_csv_refusal("a,y,z,mass\n", ":1: neither numbers nor a header with x, y, z and r");
  expect_csv_refusal("x,y,z,z\n", ":1: neither numbers nor a header");
  expect_csv_refusal("1,2,3,4\nx,y,z,r\n", ":2: 'x' is not a number: 'x,y,z,r'");
  expect_csv_refusal("1,2,3,4\n1,2,,4\n", ":2: '' is not a number: '1,2,,4'");
  expect_csv_refusal("1,2,3,4x\n", ":1: '4x' is not a number");
  expect_csv_refusal("1,2,0x3,4\n", ":1: '0x3' is not a number");
  expect_csv_refusal("1,1e39,3,4\n", ":1: '1e39' is too large for float32: '1,1e39,3,4'");
  expect_csv_refusal("1,-3.4028236e38,3,4\n", "is too large for float32");
  expect_csv_refusal("1,2,nan,4\n", ":1: z is nan (must be finite): '1,2,nan,4'");
  expect_csv_refusal("1,2,3,inf\n", ":1: r is inf (must be finite)");
  expect_csv_refusal("1,2,3,4\n1,2,3,-0.5\n", ":2: r is -0.5 (must be >= 0)");
  expect_csv_refusal("1,2,3,\x1b[31m\n", "'\\x1b[31m' is not a number");
}

TEST_F(SceneFiles, PqrIsReadWithAndWithoutChain) {
  const Scene scene =
      load_scene(write("two.pqr",
                       "REMARK   1 made up\r\n"
                       "ATOM      1  N   ILE L   1      16.4  -20.5  5.25 -0.3 1.85\n"
                       "TER\n"
                       "HETATM 9 NA NA 14 0.1 2 -3 1.0 0.2245\r\n"
                       "END\n"));
  ASSERT_EQ(scene.spheres.size(), 2U);
  expect_equal(scene.spheres[0], 16.4F, -20.5F, 5.25F, 1.85F);
  expect_equal(scene.spheres[1], 0.1F, 2.0F, -3.0F, 0.2245F);
}

TEST_F(SceneFiles, BadPqrIsRefusedWithItsLine) {
  const auto refuse = [&](const std::string& text, const std::string& reason) {
    expect_refusal(write("bad.pqr", text), reason);
  };
  refuse("REMARK only\n", "no ATOM and no HETATM record");
  refuse("REMARK\nATOM 1 N ILE 1 1.0 2.0 3.0 0.5\n", ":2: 9 fields, expected 10");
  refuse("ATOM 1 N ILE 1 -16.400-20.500 5.25 0.5 1.5 N\n", ":1: '-16.400-20.500' is not a number");
  refuse("ATOM 1 N ILE 1 1 2 3 0.5 -1.5\n", ":1: r is -1.5 (must be >= 0)");
  refuse("ATOM 1 N ILE 1 1e40 2 3 0.5 1.5\n", ":1: '1e40' is too large for float32");
}

TEST_F(SceneFiles, WhatIsNoFileIsRefused) {
  expect_refusal(path("absent.npy"), "No such file or directory");
  expect_refusal(folder_.string(), "is a folder, not a file");
  expect_refusal("/dev/null", "is not a regular file");
  expect_refusal(write("scene.text", "1,2,3,4\n"), "suffix '.text', expected .npy, .csv");
  expect_refusal(write("scene", "1,2,3,4\n"), "suffix '', expected .npy, .csv");
  ASSERT_EQ(mkfifo(path("pipe.csv").c_str(), 0600), 0);
  expect_refusal(path("pipe.csv"), "is not a regular file");
  if (geteuid() == 0) return;  // root may read everything
  const std::string locked = write("locked.csv", "1,2,3,4\n");
  fs::permissions(locked, fs::perms::none);
  expect_refusal(locked, "Permission denied");
}

TEST_F(SceneFiles, ArgumentIsAFileOrAGenerator) {
  const std::string file = write("MINE.CSV", "1,2,3,4\n");
  EXPECT_EQ(load_or_generate(file).spheres.size(), 1U);
  EXPECT_EQ(load_or_generate("gas:n=7").spheres.size(), 7U);
  EXPECT_THROW(load_or_generate("absent.npy"), InputError);
  EXPECT_THROW(load_or_generate("absent"), InputError);
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  write("gas", "not a scene");
  write("plain", "not a scene");
  EXPECT_EQ(load_or_generate("gas:n=7").spheres.size(), 7U);
  EXPECT_EQ(load_or_generate("gas").spheres.size(), 100000U);
  EXPECT_THROW(load_or_generate("./gas"), InputError);
  try {
    load_or_generate("plain");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("suffix ''"), std::string::npos) << error.what();
  }
  fs::current_path(before);
}

TEST(Validate, NamesTheFirstBadSphere) {
  std::vector<Sphere> spheres(20, Sphere{0, 0, 0, 0});
  EXPECT_NO_THROW(validate(spheres, "here"));
  spheres[17].r = -0.5F;
  try {
    validate(spheres, "here");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "here: sphere 17: r is -0.5 (must be >= 0)");
  }
}

}  // namespace
}  // namespace octocell
