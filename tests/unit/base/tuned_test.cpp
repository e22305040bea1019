#include "base/tuned.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <type_traits>

namespace {

struct Group {
  RSPHERE_TUNED(Group, double, kReal, .25);
  RSPHERE_TUNED(Group, float, kSingle, .05F);
  RSPHERE_TUNED(Group, int, kWhole, 3);
  RSPHERE_TUNED_ROOM(Group, size_t, kMany, 64);
};

#ifndef RSPHERE_SENSITIVITY
// Constant expressions with the types and values that were given, and no room to spare.
static_assert(Group::kReal == .25 && std::is_same_v<decltype(Group::kReal), const double>);
static_assert(Group::kSingle == .05F && std::is_same_v<decltype(Group::kSingle), const float>);
static_assert(Group::kWhole == 3 && std::is_same_v<decltype(Group::kWhole), const int>);
static_assert(Group::kMany == 64 && Group::kManyRoom == 64);
#endif

TEST(Tuned, HasTheValueThatIsGiven) {
  EXPECT_EQ(Group::kReal, .25);
  EXPECT_EQ(Group::kSingle, .05F);
  EXPECT_EQ(Group::kWhole, 3);
  EXPECT_EQ(Group::kMany, 64u);
  EXPECT_GE(Group::kManyRoom, Group::kMany);
}

#ifdef RSPHERE_SENSITIVITY
TEST(Tuned, FindsWholeNamesInTheEnvironment) {
  setenv("RSPHERE_TUNING", "OtherGroup.kName=1 Group.kNameToo=2 Group.kName=3.5 Last.kName=1e-6", 1);
  EXPECT_EQ(rsphere::tuning::tuned("Group.kName", 7), 3.5);
  EXPECT_EQ(rsphere::tuning::tuned("OtherGroup.kName", 7), 1);
  EXPECT_EQ(rsphere::tuning::tuned("Last.kName", 7), 1e-6);
  EXPECT_EQ(rsphere::tuning::tuned("Group.kNam", 7), 7);
  unsetenv("RSPHERE_TUNING");
}

TEST(Tuned, FindsUnknownNames) {
  setenv("RSPHERE_TUNING", "Group.kReal=1 Group.kMany=2", 1);
  EXPECT_EQ(rsphere::tuning::unknownName(), "");
  for (const char* unknown : {"Group.kRea=2", "kReal=1", "Group.kReal", "Group.kReal,Group.kMany=1"}) {
    setenv("RSPHERE_TUNING", (std::string("Group.kWhole=1 ") + unknown).c_str(), 1);
    EXPECT_EQ(rsphere::tuning::unknownName(), unknown);
  }
  unsetenv("RSPHERE_TUNING");
}
#endif

}  // namespace
