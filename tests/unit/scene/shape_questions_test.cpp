#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "base/constants.h"
#include "scene/shape.h"

namespace rsphere::shape_questions_test {
namespace {

struct Row {
  Shape shape;
  bool plain = false, closed = false;
  double area = 0;
  const V3d* plane = nullptr;
  double offset = 0;
};

TEST(ShapeQuestions, HaveTheseAnswers) {
  // A triangle in the plane z = 3, and a ring around the axis z in the plane z = 2.
  const std::vector<V3d> vertices{{0, 0, 3}, {4, 0, 3}, {0, 1, 3}};
  const V3d up(0, 0, 1);
  const std::vector<Row> rows = {
      {makePolygon(vertices, 0, 3), true, false, 2, &up, 3},
      {Ring{{5, 5, 2}, up, 1, 3}, true, false, kPi * 8, &up, 2},
      {Sphere{{0, 0, 0}, 2, false}, true, true, kPi * 16},
      {Sphere{{0, 0, 0}, 2, true}, true, true, kPi * 16},
      {Cone{{0, 0, 0}, up, 4, 1, 2, false}, true, false, kPi * 12},
      {Distant{}},
      {Instance{}},
      {MeshInstance{}},
      {MeshFaces{}},
  };
  std::set<size_t> alternatives;
  for (const Row& row : rows) {
    SCOPED_TRACE(row.shape.index());
    alternatives.insert(row.shape.index());
    EXPECT_EQ(isPlain(row.shape), row.plain);
    EXPECT_EQ(isClosed(row.shape), row.closed);
    EXPECT_DOUBLE_EQ(areaOf(row.shape, vertices), row.area);
    const V3d* normal = planeNormal(row.shape);
    ASSERT_EQ(normal != nullptr, row.plane != nullptr);
    if (normal) {
      EXPECT_EQ(*normal, *row.plane);
    }
    EXPECT_EQ(planeOffset(row.shape), row.offset);
    EXPECT_EQ(bounds(row.shape, vertices).isEmpty(), !row.plain);
    ShapeHit hit;
    if (!row.plain) {
      EXPECT_FALSE(intersect(row.shape, vertices, V3d(.5, .1, 9), -up, kFarAway, hit));
    }
  }
  EXPECT_EQ(alternatives.size(), std::variant_size_v<Shape>);
  EXPECT_EQ(centerOf(std::get<Polygon>(rows[0].shape), std::vector<V3d>{{0, 0, 0}, {3, 0, 3}, {0, 3, 0}}),
            V3d(1, 1, 1));
}

}  // namespace
}  // namespace rsphere::shape_questions_test
