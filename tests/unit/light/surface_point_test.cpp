#include "light/surface_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// A shape alone, by its lines in a scene file.
Scene alone(const char* shape) {
  return sceneOf("void plastic gray 0 0 5 .5 .5 .5 0 0\ngray " + std::string(shape));
}

bool meets(const Scene& scene, const V3d& origin, const V3d& direction, ShapeHit& hit) {
  return intersect(scene.surfaces.at(0).shape, scene.vertices, origin, direction, 1e10, hit);
}

constexpr const char* kShapes[] = {
    "sphere s 0 0 4 1 2 3 .5",
    "bubble s 0 0 4 1 2 3 .5",
    "cylinder s 0 0 7 1 2 3 2 2 4 .3",
    "tube s 0 0 7 1 2 3 2 2 4 .3",
    "cone s 0 0 8 1 2 3 2 2 4 .3 .1",
    "cup s 0 0 8 1 2 3 2 2 4 0 .4",
    "ring s 0 0 8 1 2 3 1 1 1 .2 .9",
    "polygon s 0 0 9 0 0 0 1 0 0 0 1 2",
    "polygon s 0 0 15 0 0 0 2 0 0 3 1 1 1 2 2 0 1 1",
    "sphere s 0 0 4 1e3 2 3 1e-2",
    "polygon s 0 0 12 1e5 0 0 100001 0 0 100001 1 0 1e5 1 0",
};

// A ray from just before the point, against any direction of the front, meets the shape there, from its
// front.
TEST(SurfacePoint, RaysFromBeforeTheFrontMeetIt) {
  for (const char* shape : kShapes) {
    const Scene scene = alone(shape);
    Random random(1);
    int met = 0, steep = 0;
    for (int i = 0; i < 2000; ++i) {
      const SurfacePoint at = samplePoint(scene.surfaces.at(0).shape, scene.vertices, random);
      ASSERT_NEAR(at.normal.length(), 1, 1e-12) << shape;
      V3d away = randomDirection(random);
      if (away.dot(at.normal) < 0) away = -away;
      if (away.dot(at.normal) < .1) continue;
      ++steep;
      ShapeHit hit;
      if (!meets(scene, at.point + at.clearance * away, -away, hit)) continue;
      if (std::abs(hit.distance - at.clearance) > 1e-9 + 1e-3 * at.clearance) continue;
      ++met;
      ASSERT_NEAR((hit.normal - at.normal).length(), 0, 1e-6) << shape;
      ASSERT_GT(hit.cosine, 0) << shape;
    }
    EXPECT_GT(met, .995 * steep) << shape;
  }
}

// Second moments tell points that are even by area from others. They are in closed form: sphere r^2/3, ring
// (inner^2 + outer^2)/4, cylinder r^2/2 across and length^2/12 along, square side^2/12.
TEST(SurfacePoint, EvenByArea) {
  const struct {
    const char* shape;
    V3d middle, axis;
    double square;  // mean square along the axis
  } cases[] = {
      {"sphere s 0 0 4 1 2 3 .5", V3d(1, 2, 3), V3d(1, 0, 0), .25 / 3},
      {"bubble s 0 0 4 1 2 3 .5", V3d(1, 2, 3), V3d(0, 0, 1), .25 / 3},
      {"cylinder s 0 0 7 1 2 3 1 2 5 .3", V3d(1, 2, 4), V3d(0, 0, 1), 4. / 12},
      {"cylinder s 0 0 7 1 2 3 1 2 5 .3", V3d(1, 2, 4), V3d(1, 0, 0), .09 / 2},
      {"ring s 0 0 8 1 2 3 0 0 1 .2 .9", V3d(1, 2, 3), V3d(0, 1, 0), (.04 + .81) / 4},
      {"ring s 0 0 8 1 2 3 0 0 1 0 .9", V3d(1, 2, 3), V3d(1, 0, 0), .81 / 4},
      {"polygon s 0 0 12 0 0 0 2 0 0 2 1 0 0 1 0", V3d(1, .5, 0), V3d(1, 0, 0), 4. / 12},
      {"polygon s 0 0 12 0 0 0 2 0 0 2 1 0 0 1 0", V3d(1, .5, 0), V3d(0, 1, 0), 1. / 12},
      // a regular hexagon of side 1: 5/24
      {"polygon s 0 0 18 1 0 0 .5 .8660254038 0 -.5 .8660254038 0 -1 0 0 -.5 -.8660254038 0 .5 -.8660254038 "
       "0",
       V3d(0, 0, 0), V3d(1, 0, 0), 5. / 24},
  };
  for (const auto& c : cases) {
    const Scene scene = alone(c.shape);
    Random random(2);
    Sample square;
    for (int i = 0; i < 50000; ++i) {
      const SurfacePoint at = samplePoint(scene.surfaces.at(0).shape, scene.vertices, random);
      const double along = (at.point - c.middle).dot(c.axis);
      square.add(along * along);
    }
    SCOPED_TRACE(c.shape);
    expectMean(square, c.square);
  }
}

}  // namespace
}  // namespace rsphere
