#include "rays/chosen_surfaces.h"

#include <gtest/gtest.h>

#include <vector>

namespace rsphere {
namespace {

TEST(ChosenSurfaces, AreNumberedInTheirOrder) {
  const std::vector<int> chosen = {0, 3, 63, 64, 65, 200, 391, 639};
  ChosenSurfaces surfaces(640);
  for (const int i : chosen) surfaces.add(SurfaceId(i));
  uint32_t next = 0;
  for (int i = 0; i < 640; ++i) {
    const auto number = surfaces.numberOf(SurfaceId(i));
    const bool isChosen = next < chosen.size() && chosen[next] == i;
    ASSERT_EQ(number.has_value(), isChosen) << i;
    if (isChosen) {
      EXPECT_EQ(*number, next++);
    }
  }
  EXPECT_EQ(next, chosen.size());
}

}  // namespace
}  // namespace rsphere
