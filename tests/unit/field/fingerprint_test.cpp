#include "field/fingerprint.h"

#include <gtest/gtest.h>

#include "tests/unit/support/files_of.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere::fingerprint_test {
namespace {

constexpr const char* kRoom = R"(
void plastic wall 0 0 5 .5 .5 .5 0 0
void light lamp 0 0 3 1 1 1
wall sphere ball 0 0 4 0 0 0 1
wall cone tip 0 0 8 0 0 1 0 0 2 .5 .25
wall cup dent 0 0 8 0 0 1 0 0 2 .75 .35
wall ring lid 0 0 8 0 0 2.5 0 0 1 0 .45
wall polygon floor 0 0 9 0 0 0 1 0 0 0 1.25 0
lamp source sun 0 0 4 0 0 1 .53
lamp sphere bulb 0 0 4 2 0 0 .1
)";

uint64_t of(const std::string& text) { return fingerprint(sceneOf(text)); }

std::string with(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.rfind(old), old.size(), now);
}

TEST(Fingerprints, TellScenesApart) {
  EXPECT_EQ(of(kRoom), of(kRoom));
  EXPECT_EQ(of(kRoom), of("# a remark\n\n" + with(kRoom, " .1", " 1e-1")));
  EXPECT_NE(of(kRoom), of(with(kRoom, ".1", ".1000000000000001")));
  for (const char* number : {".1", ".53", "1.25", ".45", "2.5", ".35", ".75", ".25", "0 0 4 0 0 0 1"})
    EXPECT_NE(of(kRoom), of(with(kRoom, number, std::string(number) + "3"))) << number;
  EXPECT_NE(of(kRoom), of(with(kRoom, "cup dent", "cone dent")));
  EXPECT_NE(of(kRoom), of(with(kRoom, ".5 0 0", ".5 .1 0")));
  EXPECT_NE(of(kRoom), of(with(kRoom, "wall sphere", "lamp sphere")));
  EXPECT_NE(of(kRoom), of(with(kRoom, "sphere ball", "bubble ball")));
  EXPECT_NE(of(kRoom), of(with(kRoom, "light lamp", "illum lamp")));
  EXPECT_NE(of(kRoom), of(std::string(kRoom) + "lamp sphere another 0 0 4 3 0 0 .1"));
}

TEST(Fingerprints, TellTheFilesOfAScene) {
  const SceneFolder folder;
  const auto room = [&](const std::string& file) {
    return "void brightfunc pattern 2 f " + file + " 0 0\npattern plastic wall 0 0 5 .5 .5 .5 0 0\n" +
           "wall sphere ball 0 0 4 0 0 0 1\n";
  };
  const std::string file = folder.write("a.cal", "f = 1;");
  const uint64_t before = of(room(file));
  EXPECT_EQ(of(room(file)), before);
  folder.write("a.cal", "f = 2;");
  EXPECT_NE(of(room(file)), before);
}

// A lone point is the name of no function file, and of a folder.
TEST(Fingerprints, OfFunctionsWithoutAFile) {
  const auto room = [](const std::string& value) {
    return "void brightfunc pattern 2 " + value + " . 0 0\npattern plastic wall 0 0 5 .5 .5 .5 0 0\n" +
           "wall sphere ball 0 0 4 0 0 0 1\n";
  };
  EXPECT_EQ(of(room(".5")), of(room(".5")));
  EXPECT_NE(of(room(".5")), of(room(".6")));
}

TEST(Fingerprints, TellWhatOctreesHold) {
  const SceneFolder folder;
  const auto placed = [&](const std::string& radius) {
    const std::string octree = folder.octree(
        "a.oct", "void plastic wall 0 0 5 .5 .5 .5 0 0\nwall sphere ball 0 0 4 0 0 0 " + radius);
    return of("void instance there 1 " + octree + " 0 0\n");
  };
  const uint64_t before = placed("1");
  EXPECT_EQ(placed("1"), before);
  EXPECT_NE(placed("2"), before);
}

}  // namespace
}  // namespace rsphere::fingerprint_test
