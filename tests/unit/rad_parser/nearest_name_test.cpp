#include "rad_parser/nearest_name.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace rad {
namespace {

std::string nearestOf(std::string_view wanted, std::initializer_list<std::string_view> names) {
  NearestName nearest(wanted);
  for (const std::string_view name : names) nearest.consider(name);
  return std::string(nearest.name());
}

TEST(EditDistance, CountsChangedAddedAndRemovedLetters) {
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("", "wall"), 4u);
  EXPECT_EQ(editDistance("wall", ""), 4u);
  EXPECT_EQ(editDistance("wall", "wall"), 0u);
  EXPECT_EQ(editDistance("wall", "ball"), 1u);
  EXPECT_EQ(editDistance("wall", "walls"), 1u);
  EXPECT_EQ(editDistance("floor", "flor"), 1u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("polgyon", "polygon"), 1u) << "two letters in the wrong order";
  EXPECT_EQ(editDistance("sopt", "spot"), 1u);
  EXPECT_EQ(editDistance("spot", "tops"), 3u);
}

TEST(NearestName, IsTheOneWithTheFewestChanges) {
  EXPECT_EQ(nearestOf("window_glas", {"window_frame", "window_glass", "window_grass"}), "window_glass");
  EXPECT_EQ(nearestOf("polgyon", {"sphere", "polygon"}), "polygon");
  EXPECT_EQ(nearestOf("sopt", {"spot", "wall"}), "spot");
  EXPECT_EQ(nearestOf("WALL", {"wall", "hall"}), "wall") << "case is compared last";
  EXPECT_EQ(nearestOf("Wall", {"ball", "wall"}), "wall");
}

TEST(NearestName, IsNotGuessed) {
  EXPECT_EQ(nearestOf("wall", {}), "");
  EXPECT_EQ(nearestOf("wall", {"floor", "waist"}), "") << "two changes of four letters";
  EXPECT_EQ(nearestOf("m1", {"m2"}), "") << "short names resemble too many others";
  EXPECT_EQ(nearestOf("mat3", {"mat1", "mat2"}), "") << "both are as near";
  EXPECT_EQ(nearestOf("mat3", {"mat1", "mat2", "mat"}), "");
  EXPECT_EQ(nearestOf("mat3", {"mat1", "mat1"}), "mat1") << "a name that is defined twice is one name";
  EXPECT_EQ(nearestOf("wall", {"wall"}), "") << "it is the name itself, which is not defined there";
  const std::string longName(NearestName::kLongest, 'x'), tooLong = longName + 'x';
  EXPECT_EQ(nearestOf(longName, {tooLong}), tooLong);
  EXPECT_EQ(nearestOf(tooLong, {longName}), "");
}

TEST(NearestName, EndsAMessage) {
  NearestName nearest("plasstic");
  EXPECT_EQ(nearest.hint(), "");
  nearest.consider("plastic");
  EXPECT_EQ(nearest.hint(), "; the nearest is \"plastic\"");
}

}  // namespace
}  // namespace rad
