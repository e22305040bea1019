#include "scene/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "base/constants.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

// Where scenes may lie. The shapes' own coordinates are rounded to 2^-20, so that moving them is exact.
const V3d kPlaces[] = {V3d(0, 0, 0), V3d(1e5, -1e5, 1e5), V3d(5e6, 5e6, -5e6)};

double onGrid(double x) { return std::round(x * 0x1p20) * 0x1p-20; }
V3d onGrid(const V3d& p) { return V3d(onGrid(p.x), onGrid(p.y), onGrid(p.z)); }

// A shape as a function that changes its sign across the surface, and the part of that surface which counts.
// Both take points relative to the place.
struct Implicit {
  std::function<double(const V3d&)> side;
  std::function<bool(const V3d&, double slack)> counts;
};

// The nearest crossing, found by walking along the ray in small steps and halving: no algebra in common with
// what is tested. Misses pairs of crossings within a step, which is why nearer answers are judged by their
// own merits.
std::optional<double> walk(const Implicit& shape, const V3d& origin, const V3d& direction, double farthest) {
  constexpr double kStep = 1e-2;
  double before = shape.side(origin + kSamePlace * direction);
  for (double t = kSamePlace; t < farthest; t += kStep) {
    const double after = shape.side(origin + (t + kStep) * direction);
    if ((before > 0) != (after > 0)) {
      double low = t, high = t + kStep;
      for (int i = 0; i < 50; ++i) {
        const double middle = (low + high) / 2;
        ((shape.side(origin + middle * direction) > 0) == (before > 0) ? low : high) = middle;
      }
      if (shape.counts(origin + low * direction, -1e-6)) return low;
    }
    before = after;
  }
  return std::nullopt;
}

using Intersect = std::function<bool(const V3d&, const V3d&, double, ShapeHit&)>;

// Random rays through a box of half-size 3 around the place.
void compare(const Implicit& shape, const V3d& place, const Intersect& intersects, bool inward,
             uint64_t seed) {
  Random random(seed);
  constexpr double kFarthest = 8;
  // A coordinate's rounding, and the hit's, which a surface seen at a grazing angle may stretch.
  const double rounding = 1e-13 + 1e-15 * place.length();
  int hits = 0, found = 0;
  for (int i = 0; i < 400; ++i) {
    const V3d origin = onGrid(randomPoint(random, 3));
    const V3d direction = (randomPoint(random, 1.5) - origin).normalized();
    const std::optional<double> expected = walk(shape, origin, direction, kFarthest);
    ShapeHit hit;
    hit.distance = -1;
    const bool isHit = intersects(place + origin, direction, kFarthest, hit);
    if (!isHit) {
      EXPECT_FALSE(expected.has_value()) << "ray " << i << " missed what is at " << *expected;
      EXPECT_EQ(hit.distance, -1) << "a miss must not touch the hit";
      continue;
    }
    ++hits;
    const V3d point = origin + hit.distance * direction;
    const double stretch = 1 / std::max(std::abs(hit.cosine), 1e-4);
    EXPECT_LT(std::abs(shape.side(point)), rounding * stretch) << "not on the surface, ray " << i;
    EXPECT_TRUE(shape.counts(point, 1e-9)) << "not on the part that counts, ray " << i;
    if (expected) {
      ++found;
      EXPECT_LE(hit.distance, *expected + 1e-9 + rounding * stretch) << "not the nearest, ray " << i;
    }
    EXPECT_NEAR(hit.normal.length(), 1, 1e-14);
    EXPECT_NEAR(hit.cosine, -hit.normal.dot(direction), 1e-14);
    // side grows towards the outside, which is the front unless it is inward.
    const double step = 1e-4;
    const double grows = shape.side(point + step * hit.normal) - shape.side(point - step * hit.normal);
    EXPECT_GT(inward ? -grows : grows, 0) << "normal on the wrong side, ray " << i;
  }
  EXPECT_GT(hits, 40) << "too few rays hit for a test";
  EXPECT_GT(found, 9 * hits / 10);
}

TEST(SphereShape, AgreesWithAWalkAlongTheRay) {
  for (const V3d& place : kPlaces)
    for (const bool inward : {false, true}) {
      const V3d center(.25, -.5, .125);
      const double radius = 1.25;
      const Sphere sphere{place + center, radius, inward};
      const Implicit shape{[&](const V3d& p) { return (p - center).length() - radius; },
                           [](const V3d&, double) { return true; }};
      compare(
          shape, place,
          [&](const V3d& o, const V3d& d, double t, ShapeHit& h) { return intersect(sphere, o, d, t, h); },
          inward, 1);
    }
}

TEST(ConeShape, AgreesWithAWalkAlongTheRay) {
  struct Case {
    double radius0, radius1;
  };
  for (const V3d& place : kPlaces)
    for (const Case& c : {Case{1, 1}, Case{1.5, .25}, Case{0, 1}, Case{1, 0}, Case{.5, .5078125}})
      for (const bool inward : {false, true}) {
        Cone cone;
        const V3d base(.5, -.75, -.5), end(-.25, .5, 1.5);
        cone.base = place + base;
        cone.length = (end - base).length();
        cone.axis = (end - base) / cone.length;
        cone.radius0 = c.radius0;
        cone.radius1 = c.radius1;
        cone.inward = inward;
        const auto along = [&](const V3d& p) { return (p - base).dot(cone.axis); };
        const Implicit shape{
            [&](const V3d& p) {
              const double a = along(p);
              return (p - base - a * cone.axis).length() -
                     (c.radius0 + (c.radius1 - c.radius0) * a / cone.length);
            },
            [&](const V3d& p, double slack) { return along(p) > -slack && along(p) < cone.length + slack; }};
        SCOPED_TRACE(testing::Message() << "radii " << c.radius0 << " " << c.radius1 << " at " << place.x);
        compare(
            shape, place,
            [&](const V3d& o, const V3d& d, double t, ShapeHit& h) { return intersect(cone, o, d, t, h); },
            inward, 2);
      }
}

TEST(RingShape, AgreesWithAWalkAlongTheRay) {
  for (const V3d& place : kPlaces)
    for (const double inner : {0., .5}) {
      const V3d center(.25, .5, -.125), normal = V3d(1, -2, 3).normalized();
      const Ring ring{place + center, normal, inner, 1.5};
      const Implicit shape{[&](const V3d& p) { return (p - center).dot(normal); },
                           [&](const V3d& p, double slack) {
                             const double r = (p - center).length();
                             return r > inner - slack && r < 1.5 + slack;
                           }};
      compare(
          shape, place,
          [&](const V3d& o, const V3d& d, double t, ShapeHit& h) { return intersect(ring, o, d, t, h); },
          false, 3);
    }
}

// Even-odd and winding agree for polygons whose seams are walked both ways; the winding number is the sum of
// angles under which the edges are seen.
bool windsAround(const std::vector<V3d>& vertices, const V3d& point, const V3d& normal) {
  double sum = 0;
  for (size_t i = 0; i < vertices.size(); ++i) {
    const V3d a = vertices[i] - point, b = vertices[(i + 1) % vertices.size()] - point;
    sum += std::atan2(a.cross(b).dot(normal), a.dot(b));
  }
  return std::abs(sum) > kPi;
}

double distanceToBoundary(const std::vector<V3d>& vertices, const V3d& point) {
  double nearest = 1e30;
  for (size_t i = 0; i < vertices.size(); ++i) {
    const V3d a = vertices[i], along = vertices[(i + 1) % vertices.size()] - a;
    const double length2 = along.length2();
    const double t = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0., 1.) : 0;
    nearest = std::min(nearest, (point - a - t * along).length());
  }
  return nearest;
}

// Flat polygons given in the plane of x and y, put into space by exact moves and turns of the axes.
V3d turned(double x, double y, int turn) {
  return turn == 0 ? V3d(x, y, .5) : turn == 1 ? V3d(.5, x, y) : V3d(y, -.25, x);
}

TEST(PolygonShape, AgreesWithAWalkAlongTheRay) {
  const std::vector<std::vector<std::pair<double, double>>> outlines = {
      {{-1, -1}, {1.5, -1}, {.25, 1.25}},                                                  // triangle
      {{-1.5, -1.5}, {1.5, -1.5}, {1.5, 1.5}, {0, -.5}, {-1.5, 1.5}},                      // concave
      {{-1.5, -1}, {1.5, -1}, {1.5, 1}, {.5, 1}, {.5, 0}, {-.5, 0}, {-.5, 1}, {-1.5, 1}},  // U
      // a square hole, reached by a seam that is walked twice
      {{-1.5, -1.5},
       {1.5, -1.5},
       {1.5, 1.5},
       {-1.5, 1.5},
       {-1.5, -1.5},
       {-.5, -.5},
       {-.5, .75},
       {.75, .75},
       {.75, -.5},
       {-.5, -.5}}};
  for (const V3d& place : kPlaces)
    for (size_t outline = 0; outline < outlines.size(); ++outline)
      for (int turn = 0; turn < 3; ++turn) {
        std::vector<V3d> local, world;
        for (const auto& [x, y] : outlines[outline]) {
          local.push_back(turned(x, y, turn));
          world.push_back(place + local.back());
        }
        const Polygon polygon = makePolygon(world, 0, static_cast<uint32_t>(world.size()));
        const V3d normal = polygon.normal;
        const Implicit shape{[&](const V3d& p) { return (p - local[0]).dot(normal); },
                             [&](const V3d& p, double slack) {
                               const bool in = windsAround(local, p, normal);
                               const double edge = distanceToBoundary(local, p);
                               return slack > 0 ? in || edge < slack : in && edge > -slack;
                             }};
        SCOPED_TRACE(testing::Message() << "outline " << outline << " turn " << turn << " at " << place.x);
        compare(
            shape, place,
            [&](const V3d& o, const V3d& d, double t, ShapeHit& h) {
              return intersect(polygon, world, o, d, t, h);
            },
            false, 4);
      }
}

// The step between representable numbers at 6e6 is 1e-9: a millionth of the sphere's radius.
TEST(SphereShape, IsHitFromVeryFarAway) {
  const Sphere sphere{V3d(6e6, -6e6, 6e6), 1e-3};
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const V3d origin = randomPoint(random, 6e6);
    const V3d towards = (sphere.center - origin).normalized();
    const V3d across = towards.cross(randomDirection(random)).normalized();
    ShapeHit hit;
    const V3d inside = (sphere.center + .999e-3 * across - origin).normalized();
    EXPECT_TRUE(intersect(sphere, origin, inside, 1e10, hit));
    EXPECT_NEAR(hit.distance, (sphere.center - origin).length(), 1.1e-3);
    EXPECT_NEAR(hit.normal.length(), 1, 1e-14);
    const V3d outside = (sphere.center + 1.001e-3 * across - origin).normalized();
    EXPECT_FALSE(intersect(sphere, origin, outside, 1e10, hit));
  }
}

TEST(Shapes, AreHitFromWithinTheRaysLengthOnly) {
  const std::vector<V3d> square = {V3d(-1, -1, 0), V3d(1, -1, 0), V3d(1, 1, 0), V3d(-1, 1, 0)};
  const Polygon polygon = makePolygon(square, 0, 4);
  const Ring ring{V3d(0, 0, 0), V3d(0, 0, 1), 0, 1};
  const Sphere sphere{V3d(0, 0, -1), 1};
  const Cone cone{V3d(0, -1, -1), V3d(0, 1, 0), 2, 1, 1};
  const std::vector<Intersect> shapes = {
      [&](const V3d& o, const V3d& d, double t, ShapeHit& h) {
        return intersect(polygon, square, o, d, t, h);
      },
      [&](const V3d& o, const V3d& d, double t, ShapeHit& h) { return intersect(ring, o, d, t, h); },
      [&](const V3d& o, const V3d& d, double t, ShapeHit& h) { return intersect(sphere, o, d, t, h); },
      [&](const V3d& o, const V3d& d, double t, ShapeHit& h) { return intersect(cone, o, d, t, h); }};
  const V3d down(0, 0, -1);
  ShapeHit hit;
  for (size_t i = 0; i < shapes.size(); ++i) {
    SCOPED_TRACE(i);
    const auto& hits = shapes[i];
    EXPECT_TRUE(hits(V3d(0, 0, 2), down, 2, hit)) << "at the very end";
    EXPECT_EQ(hit.distance, 2);
    EXPECT_EQ(hit.cosine, 1);
    EXPECT_FALSE(hits(V3d(0, 0, 2), down, std::nextafter(2., 0.), hit));
    EXPECT_TRUE(hits(V3d(0, 0, 2 * kSamePlace), down, 10, hit));
    EXPECT_NEAR(hit.distance, 2 * kSamePlace, 1e-15);
    const bool second = hits(V3d(0, 0, kSamePlace / 2), down, 10, hit);
    EXPECT_EQ(second, i >= 2) << "the near side must be passed";
    if (second) {
      EXPECT_NEAR(hit.distance, 2, 1e-6);
      EXPECT_LT(hit.cosine, 0) << "the far side is met from behind";
    }
    EXPECT_FALSE(hits(V3d(0, 0, 1), V3d(0, 0, 1), 10, hit)) << "behind the ray";
  }
  EXPECT_FALSE(intersect(polygon, square, V3d(-5, 0, 0), V3d(1, 0, 0), 10, hit)) << "in its plane";
  EXPECT_FALSE(intersect(ring, V3d(-5, 0, 0), V3d(1, 0, 0), 10, hit)) << "in its plane";
  EXPECT_FALSE(intersect(cone, V3d(0, -5, -1), V3d(0, 1, 0), 20, hit)) << "through the open ends";
}

TEST(ConeShape, HasNoSecondHalfBeyondItsTip) {
  const Cone cone{V3d(0, 0, 0), V3d(0, 0, 1), 1, 1, 0};
  ShapeHit hit;
  EXPECT_FALSE(intersect(cone, V3d(-5, 0, 1.5), V3d(1, 0, 0), 20, hit));
  EXPECT_FALSE(intersect(cone, V3d(-5, 0, -.5), V3d(1, 0, 0), 20, hit));
  ASSERT_TRUE(intersect(cone, V3d(-5, 0, .5), V3d(1, 0, 0), 20, hit));
  EXPECT_NEAR(hit.distance, 4.5, 1e-14);
  EXPECT_NEAR(hit.normal.x, -std::sqrt(.5), 1e-14);
  EXPECT_NEAR(hit.normal.z, std::sqrt(.5), 1e-14);
}

// A ray along a generator has a linear equation instead of a quadratic one; one through the tip has no
// normal to give.
TEST(ConeShape, AnswersInDegenerateDirections) {
  const Cone cone{V3d(0, 0, 0), V3d(0, 0, 1), 1, 1, 0};
  const V3d generator = V3d(-1, 0, 1).normalized();
  ShapeHit hit;
  // Parallel to the generator at y = 0, half a unit inside: it leaves on the other side.
  ASSERT_TRUE(intersect(cone, V3d(.5, 0, 0), generator, 20, hit));
  EXPECT_NEAR((V3d(.5, 0, 0) + hit.distance * generator).z, .75, 1e-12);
  for (const V3d& d : {V3d(0, 0, 1), V3d(0, 0, -1), V3d(1, 0, 0), V3d(1, 2, -1).normalized()}) {
    const V3d origin = V3d(0, 0, 1) - 2. * d;
    if (!intersect(cone, origin, d, 20, hit)) continue;
    EXPECT_TRUE(std::isfinite(hit.distance));
    EXPECT_NEAR(hit.normal.length(), 1, 1e-12);
  }
  EXPECT_FALSE(intersect(cone, V3d(1, 0, 0) - 3. * generator, generator, 2, hit));
}

// ---- bounds

bool contains(const Box3d& box, const V3d& p, double slack) {
  for (int i = 0; i < 3; ++i)
    if (p[i] < box.min[i] - slack || p[i] > box.max[i] + slack) return false;
  return true;
}

// Grows a box by the points that a shape's random surface points are; it may not leave the bounds, nor stay
// far from them.
struct Reached {
  Box3d bounds, reached;
  double slack;
  void add(const V3d& p) {
    reached.extendBy(p);
    EXPECT_TRUE(contains(bounds, p, slack));
  }
  void expectTight(double gap) const {
    EXPECT_LT((reached.min - bounds.min).length(), gap);
    EXPECT_LT((reached.max - bounds.max).length(), gap);
  }
};

TEST(Bounds, ContainRandomSurfacePointsAndLittleElse) {
  Random random(6);
  for (const V3d& place : kPlaces)
    for (int i = 0; i < 20; ++i) {
      const double slack = 1e-14 + 4e-16 * place.length();
      const V3d axis = i < 3 ? V3d(i == 0, i == 1, i == 2) : randomDirection(random);
      const V3d x =
          axis.cross(i == 0 ? V3d(0, 1, 0) : V3d(1, 0, 0).cross(axis) + V3d(.1, .2, .3)).normalized();
      const V3d y = axis.cross(x);
      const V3d base = place + randomPoint(random, 2);

      const Sphere sphere{base, 1.5};
      Reached onSphere{bounds(sphere), {}, slack};
      const Cone cone{base, axis, 2, between(random, 0, 1), i % 4 ? between(random, 0, 1) : 0.};
      Reached onCone{bounds(cone), {}, slack};
      const Ring ring{base, axis, .5, 1.25};
      Reached onRing{bounds(ring), {}, slack};
      for (int k = 0; k < 4000; ++k) {
        onSphere.add(base + 1.5 * randomDirection(random));
        const double angle = 2 * kPi * random.uniform(), s = k % 2 ? random.uniform() : k % 4 / 2;
        const V3d around = std::cos(angle) * x + std::sin(angle) * y;
        onCone.add(base + 2 * s * axis + (cone.radius0 + s * (cone.radius1 - cone.radius0)) * around);
        onRing.add(base + between(random, .5, 1.25) * around);
      }
      onSphere.expectTight(.1);
      onCone.expectTight(.1);
      onRing.expectTight(.1);
    }
}

// Every place where a polygon may be hit has to be in its bounds: the mean plane leaves the vertices' box.
TEST(Bounds, ContainWhereBentPolygonsAreHit) {
  Random random(7);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<V3d> vertices;
    const V3d place = kPlaces[i % 3];
    const double bend = i % 2 ? 1e-3 : .1;
    for (const auto& [x, y] : {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
      vertices.push_back(place + turned(x, y, i % 3) + randomPoint(random, bend));
    const Polygon polygon = makePolygon(vertices, 0, 4);
    EXPECT_LT(thicknessOf(polygon, vertices), 2 * bend);
    const Box3d box = bounds(polygon, vertices);
    for (int k = 0; k < 100; ++k) {
      const V3d origin = place + 5. * randomDirection(random);
      const V3d direction = (place + randomPoint(random, 1) - origin).normalized();
      ShapeHit hit;
      if (!intersect(polygon, vertices, origin, direction, 20, hit)) continue;
      ++hits;
      EXPECT_TRUE(contains(box, origin + hit.distance * direction, 1e-13 + 1e-15 * place.length()));
    }
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace rsphere
