// SPDX-License-Identifier: MIT
// Flags in files and from generators: what is read, what is written, what is refused and why.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/flags.hpp"
#include "harness/files/load.hpp"
#include "harness/files/save.hpp"
#include "harness/scenes/scenes.hpp"
#include "tests/support/scene_folder.hpp"

namespace octocell {
namespace {

using Words = std::vector<Flags>;

class FlagFiles : public SceneFiles {
 protected:
  std::string npy(const std::string& name, const std::string& descr, const std::string& shape,
                  const std::string& elements) const {
    const std::string dictionary =
        "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
    std::string length = bytes_of(static_cast<std::uint16_t>(dictionary.size()));
    return write(name, std::string("\x93NUMPY\x01\0", 8) + length + dictionary + elements);
  }

  std::string two_spheres() const { return write("two.csv", "0,0,0,1\n1,0,0,1\n"); }

  void expect_side_refusal(const std::string& flags, const std::string& reason) const {
    try {
      load_scene(two_spheres(), {.flags = flags});
      ADD_FAILURE() << "accepted, expected: " << reason;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(flags, 0), 0U) << message;
      EXPECT_NE(message.find(reason), std::string::npos) << message << "\nexpected: " << reason;
    }
  }
};

TEST_F(FlagFiles, CsvColumnsStandInAnyOrderAndMayBeLeftOut) {
  const Scene all = load_scene(
      write("all.csv", "Mask,x,y,static,z,r,group\n65535,1,2,1,3,4,32767\n0, 5,6,0,7,8,0\n"));
  ASSERT_EQ(all.flags.size(), 2U);
  EXPECT_EQ(all.flags[0], make_flags(true, 32767, 65535));
  EXPECT_EQ(all.flags[1], make_flags(false, 0, 0));
  EXPECT_EQ(all.spheres[1].z, 7.0F);
  const Scene only_static = load_scene(write("s.csv", "# x,y,z,r,static\n1,2,3,4,1\n"));
  ASSERT_EQ(only_static.flags.size(), 1U);
  EXPECT_EQ(only_static.flags[0], make_flags(true, 1, kMaxMask));
  EXPECT_TRUE(load_scene(write("none.csv", "x,y,z,r\n1,2,3,4\n")).flags.empty());
}

TEST_F(FlagFiles, BadColumnsAreRefusedWithTheirLine) {
  expect_csv_refusal("x,y,z,r,static\n1,2,3,4,0\n1,2,3,4,2\n",
                     ":3: static is '2' (must be 0 or 1)");
  expect_csv_refusal("x,y,z,r,static\n1,2,3,4,true\n", ":2: static is 'true'");
  expect_csv_refusal("x,y,z,r,static\n1,2,3,4,\n", ":2: static is ''");
  expect_csv_refusal("x,y,z,r,group\n1,2,3,4,32768\n",
                     "group is '32768' (must be a whole number from 0 to 32767)");
  expect_csv_refusal("x,y,z,r,group\n1,2,3,4,-1\n", "group is '-1'");
  expect_csv_refusal("x,y,z,r,mask\n1,2,3,4,65536\n", "mask is '65536'");
  expect_csv_refusal("x,y,z,r,mask\n1,2,3,4,1.0\n", "mask is '1.0'");
  expect_csv_refusal("x,y,z,r,mask\n1,2,3,4,99999999999999999999\n", "mask is '9999");
  expect_csv_refusal("x,y,z,r,static\n1,2,3,4\n", ":2: 4 fields, expected 5");
  expect_csv_refusal("x,y,z,r\n1,2,3,4,1\n", ":2: 5 fields, expected 4");
  expect_csv_refusal("x,y,z,r,static,static\n1,2,3,4,1,1\n", "neither numbers nor a header");
  expect_csv_refusal("x,y,z,static\n1,2,3,1\n", "no radii in columns x,y,z,static");
  expect_csv_refusal("1,2,3,4,1\n", "5 fields and no header");
}

TEST_F(FlagFiles, SideFilesHoldWordsOrTellStaticOnly) {
  const std::string words = npy("w.npy", "<u4", "(2,)", bytes_of(0xabcd9234U, 0xffff0001U));
  const Scene scene = load_scene(two_spheres(), {.flags = words});
  ASSERT_EQ(scene.flags.size(), 2U);
  EXPECT_EQ(scene.flags[0].word, 0xabcd9234U);
  EXPECT_EQ(scene.flags[1], Flags{});
  EXPECT_EQ(scene.spec, path("two.csv") + " --flags " + words);
  for (const char* type : {"|b1", "|u1"}) {
    const std::string file = npy("s.npy", type, "(2,)", std::string("\1\0", 2));
    const Words statics = load_scene(two_spheres(), {.flags = file}).flags;
    EXPECT_EQ(statics, (Words{make_flags(true, 1, kMaxMask), Flags{}})) << type;
  }
  const Scene generated = load_or_generate("gas:n=2", {.flags = words});
  EXPECT_EQ(generated.flags, scene.flags);
}

TEST_F(FlagFiles, BadSideFilesAreRefused) {
  const std::string two = bytes_of(1U, 2U);
  expect_side_refusal(path("missing.npy"), "No such file");
  expect_side_refusal(write("text.npy", "0\n1\n"), "not an NPY file");
  expect_side_refusal(npy("l.npy", "<u4", "(3,)", two + bytes_of(3U)),
                      "flags of 3 spheres, and the scene has 2");
  expect_side_refusal(npy("s.npy", "<u4", "(1,)", bytes_of(1U)), "flags of 1 spheres");
  expect_side_refusal(npy("t.npy", "<u4", "(2,)", bytes_of(1U)), "truncated");
  expect_side_refusal(npy("m.npy", "<u4", "(2,)", two + "x"), "too long");
  expect_side_refusal(npy("d.npy", "<u4", "(2, 1)", two), "shape (2, 1), expected (n,)");
  expect_side_refusal(npy("f.npy", "<f4", "(2,)", two), "numbers of type '<f4'");
  expect_side_refusal(npy("b.npy", ">u4", "(2,)", two), "numbers of type '>u4'");
  expect_side_refusal(npy("v.npy", "|u1", "(2,)", std::string("\1\2", 2)),
                      "sphere 1: static is 2 (must be 0 or 1)");
}

TEST_F(FlagFiles, FlagsTwiceAreRefused) {
  const std::string flags = npy("w.npy", "<u4", "(1,)", bytes_of(1U));
  const std::string scene = write("own.csv", "x,y,z,r,static\n1,2,3,4,1\n");
  EXPECT_THROW(load_scene(scene, {.flags = flags}), InputError);
  EXPECT_THROW(load_or_generate("gas:n=1,groups=1", {.flags = flags}), InputError);
  EXPECT_THROW(load_scene(scene, {.flags = ""}), InputError);
}

TEST_F(FlagFiles, WhatIsSavedIsReadAgain) {
  const Scene scene = generate("poly:n=700,static=0.4,groups=5");
  const auto expect_same = [&](const Scene& again) {
    ASSERT_EQ(again.spheres.size(), scene.spheres.size());
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
      ASSERT_EQ(again.spheres[i].x, scene.spheres[i].x);
      ASSERT_EQ(again.spheres[i].r, scene.spheres[i].r);
    }
    EXPECT_EQ(again.flags, scene.flags);
  };
  save_scene(path("a.csv"), scene.view());
  expect_same(load_scene(path("a.csv")));
  for (const char* name : {"b.npy", "c.csv"}) {
    save_scene(path(name), scene.view(), path("flags.npy"));
    EXPECT_TRUE(load_scene(path(name)).flags.empty());
    expect_same(load_scene(path(name), {.flags = path("flags.npy")}));
  }
  EXPECT_EQ(files_in_folder(), 4U);
}

TEST_F(FlagFiles, SpheresWithoutFlagsAreSavedAsSuch) {
  const Scene scene = generate("gas:n=3");
  save_scene(path("a.csv"), scene.view());
  EXPECT_EQ(content(path("a.csv")).rfind("x,y,z,r\n", 0), 0U);
  EXPECT_TRUE(load_scene(path("a.csv")).flags.empty());
  save_scene(path("b.npy"), scene.view(), path("flags.npy"));
  EXPECT_EQ(load_scene(path("b.npy"), {.flags = path("flags.npy")}).flags, Words(3));
}

TEST_F(FlagFiles, NothingIsWrittenWhereAnOutputCannotBe) {
  const Scene scene = generate("gas:n=30,static=0.5");
  const std::string kept = write("kept.npy", "precious");
  EXPECT_THROW(save_scene(path("a.npy"), scene.view()), InputError);
  EXPECT_THROW(save_scene(path("a.npy"), scene.view(), path("a.npy")), InputError);
  EXPECT_THROW(save_scene(path("a.npy"), scene.view(), path("f.csv")), InputError);
  EXPECT_THROW(save_scene(path("a.npy"), scene.view(), path("absent/f.npy")), InputError);
  EXPECT_THROW(save_scene(kept, scene.view(), path("absent/f.npy")), InputError);
  EXPECT_THROW(save_scene(path("absent/a.npy"), scene.view(), kept), InputError);
  EXPECT_EQ(content(kept), "precious");
  EXPECT_EQ(files_in_folder(), 1U);
}

std::size_t statics_of(const Scene& scene) {
  return static_cast<std::size_t>(std::ranges::count_if(scene.flags, is_static));
}

TEST(GeneratedFlags, DoNotChangeTheSpheres) {
  for (const SceneInfo& info : scenes()) {
    const std::string plain = std::string(info.name) + ":n=60";
    const Scene without = generate(plain);
    const Scene with = generate(plain + ",static=0.5,groups=4");
    EXPECT_TRUE(without.flags.empty()) << plain;
    EXPECT_EQ(with.flags.size(), 60U) << plain;
    for (std::size_t i = 0; i < 60; ++i) ASSERT_EQ(with.spheres[i].x, without.spheres[i].x);
    EXPECT_EQ(with.spec, without.spec + ",static=0.5,groups=4");
    EXPECT_EQ(generate(with.spec).flags, with.flags);
  }
}

TEST(GeneratedFlags, AreStaticInTheShareAskedFor) {
  EXPECT_EQ(statics_of(generate("gas:n=5000,static=1")), 5000U);
  EXPECT_EQ(statics_of(generate("gas:n=5000,groups=2")), 0U);
  EXPECT_NEAR(static_cast<double>(statics_of(generate("gas:n=5000,static=0.9"))), 4500.0, 100.0);
  EXPECT_NE(generate("gas:n=5000,static=0.9").flags,
            generate("gas:n=5000,static=0.9,seed=2").flags);
}

TEST(GeneratedFlags, PutEachSphereIntoOneGroupThatPassesItselfBy) {
  const Scene scene = generate("gas:n=6000,groups=15");
  std::size_t members[15] = {};
  for (const Flags f : scene.flags) {
    ASSERT_EQ(std::popcount(group_of(f)), 1);
    ASSERT_EQ(mask_of(f), kMaxMask & ~group_of(f));
    ++members[std::countr_zero(group_of(f))];
  }
  for (const std::size_t count : members) EXPECT_NEAR(static_cast<double>(count), 400.0, 100.0);
}

TEST(GeneratedFlags, OutOfRangeAreRefused) {
  for (const char* text : {"static=1.5", "static=-0.1", "groups=16", "groups=2.5", "static=x"}) {
    EXPECT_THROW(generate(std::string("gas:n=9,") + text), InputError) << text;
  }
}

}  // namespace
}  // namespace octocell
