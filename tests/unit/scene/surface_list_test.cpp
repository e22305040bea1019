#include "scene/surface_list.h"

#include <gtest/gtest.h>

#include <vector>

namespace rsphere {
namespace {

TEST(SurfaceList, ShowsShapesFinishesAndPrimitives) {
  const std::vector<V3d> vertices{{0, 0, 3}, {4, 0, 3}, {0, 1, 3}};
  SurfaceList list;
  list.finishes().resize(2);
  list.finishes()[1].material = ModifierId(7);
  list.finishes()[1].goal = true;
  list.push_back(makePolygon(vertices, 0, 3), 1, PrimitiveId(4));
  list.push_back(Sphere{{1, 2, 3}, 5}, 0, PrimitiveId(5));
  list.push_back(Distant{}, 1, PrimitiveId(6));
  list.push_back(makePolygon(vertices, 0, 3), 0, PrimitiveId(9));
  list.push_back(makePolygon(vertices, 0, 2), 0, PrimitiveId(10));  // has no area

  ASSERT_EQ(list.size(), 5u);
  const auto* polygon = list.at(0).shape.as<Polygon>();
  ASSERT_TRUE(polygon);
  EXPECT_EQ(areaOf(*polygon, vertices), 2);
  EXPECT_EQ(list.at(0).shape.as<Sphere>(), nullptr);
  ASSERT_TRUE(list.at(1).shape.as<Sphere>());
  EXPECT_EQ(list.at(1).shape.as<Sphere>()->radius, 5);
  EXPECT_EQ(list.at(1).shape.as<Polygon>(), nullptr);
  EXPECT_TRUE(list.at(2).shape.as<Distant>());
  ASSERT_TRUE(list.at(4).shape.as<Polygon>());
  EXPECT_FALSE(list.at(4).shape.as<Polygon>()->hasArea);

  EXPECT_EQ(list.at(0).material, ModifierId(7));
  EXPECT_TRUE(list.at(0).goal);
  EXPECT_FALSE(list.at(2).goal) << "distant sources are no goals";
  EXPECT_EQ(list.at(3).material, kNone);

  const std::vector<int> primitives = {4, 5, 6, 9, 10};
  size_t i = 0;
  for (const Surface& s : list) {
    EXPECT_EQ(s.id, SurfaceId(i));
    EXPECT_EQ(list.primitiveOf(s.id), PrimitiveId(primitives[i]));
    ++i;
  }
  EXPECT_EQ(i, list.size());
  size_t first = 0;
  for (const Surface& s : list.first(2)) first += s.id.index() + 1;
  EXPECT_EQ(first, 3u);
}

}  // namespace
}  // namespace rsphere
