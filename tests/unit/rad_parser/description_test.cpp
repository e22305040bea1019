#include "rad_parser/description.h"

#include <gtest/gtest.h>

#include "tests/unit/rad_parser/scene_text.h"

namespace {

using rad::Description;
using rad::kVoid;
using rad::PrimitiveId;

constexpr const char* kFirst = "void plastic m\n0\n0\n5 1 1 1 0 0\nm sphere s\n0\n0\n4 0 0 0 1\n";
constexpr const char* kSecond =
    "void mixfunc m\n4 void void x y.cal\n0\n0\nvoid alias n m\nn sphere s\n0\n0\n4 7 8 9 2\n";

Description both() {
  Description d = readText(kFirst);
  const rad::Place from = d.primitives.at(1).place;
  append(d, rad::readSceneText(kSecond, "other.rad"), from);
  return d;
}

TEST(Append, NumbersOnFromWhatThereIs) {
  const Description d = both();
  ASSERT_EQ(d.primitives.size(), 5u);
  EXPECT_EQ(d.primitives.at(1).name, "s");
  EXPECT_EQ(d.primitives.at(2).name, "m");
  EXPECT_EQ(d.string(d.primitives.at(2), 3), "y.cal");
  EXPECT_EQ(d.primitives.at(2).modifier, kVoid);
  EXPECT_EQ(d.primitives.at(3).aliased, PrimitiveId(2));
  EXPECT_EQ(d.primitives.at(4).modifier, PrimitiveId(3));
  EXPECT_EQ(d.reals(d.primitives.at(1))[3], 1);
  EXPECT_EQ(d.reals(d.primitives.at(4))[0], 7);
  EXPECT_EQ(d.at(d.primitives.at(1).place), "room.rad:5");
  EXPECT_EQ(d.at(d.primitives.at(4).place), "other.rad:6 (from room.rad:5)");
}

// Arguments of modifiers are views of words, and octrees are appended afterwards.
TEST(Append, LeavesViewsOfWordsValid) {
  Description d = readText(kSecond);
  const std::string_view word = d.string(d.primitives.at(0), 3);
  for (int i = 0; i < 20; ++i) append(d, readText(kSecond), {});
  const Description moved = std::move(d);
  EXPECT_EQ(word.data(), moved.string(moved.primitives.at(0), 3).data());
  EXPECT_EQ(word, "y.cal");
}

TEST(Append, KeepsHeaderAndCube) {
  Description d = readText(kFirst);
  d.header = {"mine"};
  Description more = readText(kSecond);
  more.header = {"theirs"};
  more.cube = rad::Cube{{0, 0, 0}, 1};
  append(d, std::move(more), {});
  EXPECT_EQ(d.header, std::vector<std::string>{"mine"});
  EXPECT_FALSE(d.cube);
}

TEST(ModifierIndex, OfThePrimitivesFromOneOn) {
  const Description d = both();
  EXPECT_EQ(rad::ModifierIndex(d).before("m", PrimitiveId(2)), PrimitiveId(0));
  EXPECT_EQ(rad::ModifierIndex(d).before("m", PrimitiveId(5)), PrimitiveId(2));
  EXPECT_EQ(rad::ModifierIndex(d, 2).before("m", PrimitiveId(2)), kVoid);
  EXPECT_EQ(rad::ModifierIndex(d, 2).before("n", PrimitiveId(5)), PrimitiveId(3));
}

// Names of surfaces are never looked up. Modifiers of the same name are.
TEST(Description, SurfacesAndModifiersMayHaveOneName) {
  const Description d = readText(
      "void plastic a\n0\n0\n5 1 1 1 0 0\na sphere b\n0\n0\n4 0 0 0 1\na sphere b\n0\n0\n4 0 0 0 1\n"
      "void plastic b\n0\n0\n5 1 1 1 0 0\nb sphere a\n0\n0\n4 0 0 0 1\na sphere a\n0\n0\n4 0 0 0 1\n");
  EXPECT_EQ(d.primitives.at(2).name, "b");
  EXPECT_EQ(d.primitives.at(4).modifier, PrimitiveId(3));
  EXPECT_EQ(d.primitives.at(5).modifier, PrimitiveId(0));
  EXPECT_EQ(d.primitives.at(1).name, d.primitives.at(2).name);
  EXPECT_TRUE(
      errorOfText(
          "void plastic a\n0\n0\n5 1 1 1 0 0\na sphere c\n0\n0\n4 0 0 0 1\nc sphere d\n0\n0\n4 0 0 0 1\n")
          .find("undefined modifier \"c\"") != std::string::npos);
}

}  // namespace
