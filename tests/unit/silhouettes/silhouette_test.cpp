#include "silhouettes/silhouette.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "tests/unit/support/statistics.h"

namespace rsphere {
namespace {

struct Plane {
  std::vector<V3d> vertices;
  Polygon polygon;
  explicit Plane(std::vector<V3d> v)
      : vertices(std::move(v)), polygon(makePolygon(vertices, 0, static_cast<uint32_t>(vertices.size()))) {}
  Silhouette seenFrom(const V3d& point) const { return silhouetteOf(polygon, vertices, point); }
};

Plane rectangle(double a, double b, const V3d& corner = V3d(0, 0, 0)) {
  return Plane({corner, corner + V3d(a, 0, 0), corner + V3d(a, b, 0), corner + V3d(0, b, 0)});
}

// A square of side 4 with a hole of side 2, joined by a seam.
Plane holed() {
  return Plane({V3d(-2, -2, 0), V3d(2, -2, 0), V3d(2, 2, 0), V3d(-2, 2, 0), V3d(-2, -2, 0), V3d(-1, -1, 0),
                V3d(-1, 1, 0), V3d(1, 1, 0), V3d(1, -1, 0), V3d(-1, -1, 0)});
}

// An arrow head: reentrant at its last corner.
Plane concave() { return Plane({V3d(0, 2, 0), V3d(-2, -2, 0), V3d(0, -1, 0), V3d(2, -2, 0)}); }

Silhouette seen(const Shape& shape, const V3d& point) { return silhouetteOf(shape, {}, point); }

// The share of even directions that meet a plane's polygon, by rays over a grid of its square of half-size 2
// in z = 0: the solid angle as the integral of cosine / distance^2 over area.
double quadrature(const Plane& plane, const V3d& point, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const V3d at(4 * (i + .5) / n - 2, 4 * (j + .5) / n - 2, 0);
      if (!inside(plane.polygon, plane.vertices, at)) continue;
      const double distance = (at - point).length();
      sum += 16. / n / n * std::abs(point.z) / (distance * distance * distance);
    }
  return sum;
}

// Chi-squared of samples of the region, as a normal deviate: cells of the square are the even ones that its
// directions are put back in by an independent count, the mean position of even directions that are kept
// where contains() says so. spoil: squares one of the numbers, which a test must see.
double evenness(const Silhouette& s, const V3d& axis, double reach, bool spoil, uint64_t seed) {
  constexpr int kCells = 8;
  V3d x = axis.cross(std::abs(axis.x) < .5 ? V3d(1, 0, 0) : V3d(0, 1, 0)).normalized();
  const V3d y = axis.cross(x);
  const auto cell = [&](const V3d& d) {
    const auto at = [&](double t) {
      return std::min(kCells - 1, static_cast<int>((std::clamp(t / reach, -1., .999999) + 1) / 2 * kCells));
    };
    return static_cast<size_t>(kCells * at(d.dot(x)) + at(d.dot(y)));
  };
  Random random(seed);
  // Even directions of a cap around the axis that holds the region.
  std::vector<double> expected(kCells * kCells), counts(kCells * kCells);
  const double versine = 1 - std::sqrt(std::max(0., 1 - 2 * std::min(.5, reach * reach)));
  double kept = 0;
  for (int i = 0; i < 2000000; ++i) {
    const double v = versine * random.uniform(), angle = 2 * kPi * random.uniform();
    const double sine = std::sqrt(v * (2 - v));
    const V3d d = sine * (std::cos(angle) * x + std::sin(angle) * y) + (1 - v) * axis;
    if (!s.contains(d)) continue;
    expected[cell(d)] += 1;
    kept += 1;
  }
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const double u1 = random.uniform(), u2 = random.uniform();
    counts[cell(s.sample(u1, spoil ? std::pow(u2, 1.25) : u2))] += 1;
  }
  for (double& e : expected) e *= kSamples / kept;
  return chiSquaredSigmas(counts, expected);
}

TEST(Silhouette, SphereFillsItsCap) {
  for (const double distance : {1.0000001, 1.5, 3., 1e3, 1e6}) {
    const Silhouette s = seen(Sphere{V3d(distance, 0, 0), 1}, V3d(0, 0, 0));
    const double sine = 1 / distance;
    const double exact = distance < 10 ? 2 * kPi * (1 - std::sqrt(1 - sine * sine))
                                       : kPi * sine * sine * (1 + sine * sine / 4);
    EXPECT_NEAR(s.solidAngle() / exact, 1, 1e-12 + sine * sine * sine * sine / (distance < 10 ? 1e12 : 1))
        << distance;
    EXPECT_EQ(s.solidAngle(), s.regionSolidAngle());
  }
}

TEST(Silhouette, SphereAroundThePointFillsAll) {
  const Sphere sphere{V3d(1, 2, 3), 2};
  for (const V3d& p : {V3d(1, 2, 3), V3d(2, 2, 3), V3d(3, 2, 3)}) {
    const Silhouette s = seen(sphere, p);
    EXPECT_NEAR(s.solidAngle(), 4 * kPi, 1e-14);
    EXPECT_TRUE(s.contains(V3d(0, 0, 1)) && s.contains(V3d(0, 0, -1)) && s.contains(V3d(1, 0, 0)));
  }
}

TEST(Silhouette, MinuteSphereFarAway) {
  const V3d towards = V3d(1, 2, 3).normalized();
  const Silhouette s = seen(Sphere{1e3 * towards, 1e-6}, V3d(0, 0, 0));
  EXPECT_NEAR(s.solidAngle() / (kPi * 1e-18), 1, 1e-12);
  Random random(1);
  double farthest = 0;
  for (int i = 0; i < 10000; ++i) {
    const V3d d = s.sample(random.uniform(), random.uniform());
    EXPECT_TRUE(s.contains(d));
    farthest = std::max(farthest, (d - towards).length());
  }
  EXPECT_NEAR(farthest, 1e-9, 2e-12);  // the samples really spread
}

TEST(Silhouette, TriangleOfAnOctant) {
  const Plane plane({V3d(1, 0, 0), V3d(0, 1, 0), V3d(0, 0, 1)});
  EXPECT_NEAR(plane.seenFrom(V3d(0, 0, 0)).solidAngle(), kPi / 2, 1e-15);
  EXPECT_NEAR(plane.seenFrom(V3d(0, 0, 0)).regionSolidAngle(), kPi / 2, 1e-15);
}

// Rectangle a x b over its corner at c: atan(ab / (c sqrt(a^2 + b^2 + c^2))).
TEST(Silhouette, RectangleOverItsCorner) {
  for (const double scale : {1e-3, 1., 1e3})
    for (const double c : {1e-6, .01, .5, 2., 100., 1e5}) {
      const double a = 3, b = 2;
      const Plane plane = rectangle(a * scale, b * scale);
      const double exact = std::atan(a * b / (c * std::sqrt(a * a + b * b + c * c)));
      for (const double side : {1., -1.}) {
        const Silhouette s = plane.seenFrom(V3d(0, 0, side * c * scale));
        EXPECT_NEAR(s.solidAngle() / exact, 1, 1e-12) << scale << ' ' << c;
        EXPECT_NEAR(s.regionSolidAngle() / exact, 1, c < 1e4 ? 1e-9 : 4) << scale << ' ' << c;
      }
    }
}

TEST(Silhouette, FarFromTheOrigin) {
  const V3d shift(1e5, -1e5, 1e5);
  const Plane near({V3d(1, 0, 0), V3d(0, 1, 0), V3d(-1, -1, .5)});
  Plane far({shift + near.vertices[0], shift + near.vertices[1], shift + near.vertices[2]});
  const V3d point(.25, .125, 2);
  EXPECT_NEAR(far.seenFrom(shift + point).solidAngle(), near.seenFrom(point).solidAngle(), 1e-14);
  const Silhouette a = seen(Sphere{shift + V3d(1, 2, 3), .5}, shift + point);
  EXPECT_NEAR(a.solidAngle(), seen(Sphere{V3d(1, 2, 3), .5}, point).solidAngle(), 1e-14);
}

TEST(Silhouette, ConcaveAndHoledByQuadrature) {
  for (const Plane& plane : {concave(), holed()})
    for (const V3d& point : {V3d(.3, .2, 1), V3d(-1.7, .4, -2), V3d(5, 4, .8), V3d(0, -1.5, 3)}) {
      const Silhouette s = plane.seenFrom(point);
      const double expected = quadrature(plane, point, 2000);
      EXPECT_NEAR(s.solidAngle(), expected, 2e-4 * expected);
      EXPECT_GE(s.regionSolidAngle(), s.solidAngle());
      EXPECT_LE(s.regionSolidAngle(), 2 * kPi * (1 + 1e-12));
    }
}

TEST(Silhouette, NothingIsSeenInAPolygonsPlane) {
  const Plane plane = rectangle(3, 2, V3d(1, 1, .7));
  for (const V3d& p : {V3d(2, 2, .7), V3d(1, 1, .7), V3d(2, 1, .7), V3d(7, 7, .7), V3d(7, 1, .7)}) {
    const Silhouette s = plane.seenFrom(p);
    EXPECT_EQ(s.solidAngle(), 0);
    EXPECT_EQ(s.regionSolidAngle(), 0);
    EXPECT_FALSE(s.contains(V3d(0, 0, 1)) || s.contains(V3d(1, 0, 0)));
    EXPECT_NEAR(plane.seenFrom(p + V3d(1e-7, 0, 0)).solidAngle(), 0, 0);
  }
  // In a plane askew, as near as coordinates go.
  const V3d u(.3, .5, .7), v(-.2, .9, .1);
  const Plane askew({V3d(0, 0, 0), u, u + v, v});
  EXPECT_EQ(askew.seenFrom(.3 * u + .4 * v).regionSolidAngle(), 0);
  EXPECT_NEAR(askew.seenFrom(.3 * u + .4 * v + 1e-6 * u.cross(v)).solidAngle(), 2 * kPi, 1e-4);
  EXPECT_EQ(seen(Ring{V3d(0, 0, 1), V3d(0, 0, 1), 0, 1}, V3d(.5, 0, 1)).regionSolidAngle(), 0);
}

TEST(Silhouette, EdgeOnIsASliver) {
  const Plane plane = rectangle(1, 1, V3d(1, -.5, 0));
  for (const double height : {1e-3, 1e-6, 1e-9, 1e-11}) {
    const Silhouette s = plane.seenFrom(V3d(0, 0, height));
    // Twice the rectangle 2 x .5 over its corner less the one of 1 x .5; atan(1/x) = pi/2 - x + x^3/3.
    const double a = height * std::sqrt(4.25) / 1, b = height * std::sqrt(1.25) / .5;
    EXPECT_NEAR(s.solidAngle() / (2 * (b - a)), 1, 2 * height * height + 1e-12 / height * 1e-3 + 1e-14);
    EXPECT_NEAR(s.regionSolidAngle(), s.solidAngle(), 1e-9 * s.solidAngle());
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
      const V3d d = s.sample(random.uniform(), random.uniform());
      EXPECT_TRUE(s.contains(d));
      EXPECT_LE(std::abs(d.z), height * 1.001);
    }
  }
}

// Both sides are seen, and the region lies where the rays meet the polygon.
TEST(Silhouette, PolygonContainsWhatRaysHitAndNothingElse) {
  const Plane plane({V3d(-1, -1, 0), V3d(1, -1.5, 0), V3d(2, 1, 0), V3d(0, 1.5, 0), V3d(-1.2, .4, 0)});
  Random random(3);
  for (const V3d& point : {V3d(0, 0, .5), V3d(0, 0, -.5), V3d(4, 3, 1), V3d(-3, 1, -.2)}) {
    const Silhouette s = plane.seenFrom(point);
    for (int i = 0; i < 100000; ++i) {
      const V3d d = randomDirection(random);
      ShapeHit hit;
      const bool meets = intersect(plane.polygon, plane.vertices, point, d, 1e10, hit);
      ASSERT_EQ(s.contains(d), meets);
    }
  }
}

// A warped quadrangle is hit in its mean plane.
TEST(Silhouette, WarpedPolygonIsSeenWhereRaysMeetIt) {
  const Plane plane({V3d(-1, -1, .1), V3d(1, -1, -.1), V3d(1, 1, .1), V3d(-1, 1, -.1)});
  ASSERT_GT(thicknessOf(plane.polygon, plane.vertices), .05);
  const V3d point(.2, .1, .9);
  const Silhouette s = plane.seenFrom(point);
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    const V3d d = randomDirection(random);
    ShapeHit hit;
    ASSERT_EQ(s.contains(d), intersect(plane.polygon, plane.vertices, point, d, 1e10, hit));
  }
}

// Concave polygons, cones, cylinders and rings: bounded.
TEST(Silhouette, RegionHoldsEveryDirectionInWhichTheShapeIsSeen) {
  Random random(5);
  const auto check = [&](const Silhouette& s, const V3d& point, const auto& meets) {
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
      const V3d d = randomDirection(random);
      if (!meets(point, d)) continue;
      ++hits;
      ASSERT_TRUE(s.contains(d));
    }
    // What the region holds is no less than what is seen.
    EXPECT_LE(hits, 20000 * s.regionSolidAngle() / (4 * kPi) * 1.1 + 40);
  };
  for (int k = 0; k < 60; ++k) {
    const V3d point = randomPoint(random, 2);
    ShapeHit hit;
    const V3d axis = randomDirection(random);
    const double r0 = between(random, .05, 1), r1 = k % 3 ? between(random, 0, 1) : r0;
    const Cone cone{randomPoint(random, 2), axis, between(random, .1, 2), r0, r1, k % 2 == 0};
    check(seen(cone, point), point,
          [&](const V3d& o, const V3d& d) { return intersect(cone, o, d, 1e10, hit); });
    const Ring ring{randomPoint(random, 2), axis, k % 2 ? r0 / 2 : 0, r0};
    check(seen(ring, point), point,
          [&](const V3d& o, const V3d& d) { return intersect(ring, o, d, 1e10, hit); });
    const Plane plane = k % 2 ? concave() : holed();
    check(plane.seenFrom(point), point, [&](const V3d& o, const V3d& d) {
      return intersect(plane.polygon, plane.vertices, o, d, 1e10, hit);
    });
  }
}

TEST(Silhouette, NearARingHalfOfTheDirections) {
  const Silhouette s = seen(Ring{V3d(0, 0, 1), V3d(0, 0, 1), 0, 1}, V3d(.5, 0, .9));
  EXPECT_NEAR(s.regionSolidAngle(), 2 * kPi, 1e-14);
  EXPECT_TRUE(s.contains(V3d(0, 0, 1)));
  EXPECT_FALSE(s.contains(V3d(0, 0, -1)));
}

TEST(Silhouette, SamplesAreEvenBySolidAngle) {
  struct Case {
    Silhouette silhouette;
    V3d axis;
    double reach;
  };
  const Plane wide = rectangle(3, 2, V3d(-1.5, -1, 0));
  const Plane five({V3d(-1, -1, 0), V3d(1, -1.5, 0), V3d(2, 1, 0), V3d(0, 1.5, 0), V3d(-1.2, .4, 0)});
  const Case cases[] = {
      {seen(Sphere{V3d(0, 0, -2), 1}, V3d(0, 0, 0)), V3d(0, 0, -1), .5},
      {seen(Sphere{V3d(0, 0, -1e3), 1}, V3d(0, 0, 0)), V3d(0, 0, -1), 1e-3},
      {wide.seenFrom(V3d(0, 0, 1)), V3d(0, 0, -1), .9},
      {wide.seenFrom(V3d(0, 0, -1e3)), V3d(0, 0, 1), 2e-3},
      {five.seenFrom(V3d(.3, 0, 2)), V3d(0, 0, -1), .8},
  };
  uint64_t seed = 10;
  for (const Case& c : cases) {
    ++seed;
    EXPECT_LT(evenness(c.silhouette, c.axis, c.reach, false, seed), kMostSigmas) << seed;
    EXPECT_GT(evenness(c.silhouette, c.axis, c.reach, true, seed), kMostSigmas) << seed;
  }
}

TEST(Silhouette, RandomConvexPolygons) {
  Random random(6);
  for (int k = 0; k < 10000; ++k) {
    // Corners on an ellipse in a random plane, of any size and distance.
    const V3d n = randomDirection(random);
    const V3d x = n.cross(randomDirection(random)).normalized(), y = n.cross(x);
    const double size = std::pow(10, between(random, -6, 3)), flat = std::pow(10, between(random, -4, 0));
    const V3d center = randomDirection(random) * std::pow(10, between(random, -3, 3));
    const int count = 3 + static_cast<int>(random.bits() % 8);
    std::vector<V3d> vertices;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * kPi * (i + .8 * random.uniform()) / count;
      vertices.push_back(center + size * (std::cos(angle) * x + flat * std::sin(angle) * y));
    }
    const Plane plane(std::move(vertices));
    if (areaOf(plane.polygon, plane.vertices) == 0) continue;
    const Silhouette s = plane.seenFrom(V3d(0, 0, 0));
    ASSERT_GE(s.solidAngle(), 0);
    ASSERT_LE(s.solidAngle(), 2 * kPi * (1 + 1e-12));
    ASSERT_GE(s.regionSolidAngle(), s.solidAngle() * (1 - 1e-9));
    if (!(s.regionSolidAngle() > 0)) continue;
    for (int i = 0; i < 20; ++i) {
      const double u1 = i == 0 ? 0 : i == 1 ? 1 : random.uniform();
      const V3d d = s.sample(u1, i == 2 ? 0 : i == 3 ? 1 : random.uniform());
      ASSERT_NEAR(d.length(), 1, 1e-14);
      ASSERT_TRUE(s.contains(d)) << k;
    }
  }
}

TEST(Silhouette, NoneForDegenerateShapes) {
  EXPECT_EQ(Plane({V3d(0, 0, 1), V3d(1, 0, 1), V3d(2, 0, 1)}).seenFrom(V3d(0, 0, 0)).regionSolidAngle(), 0);
  EXPECT_EQ(Silhouette().regionSolidAngle(), 0);
  EXPECT_FALSE(Silhouette().contains(V3d(0, 0, 1)));
  EXPECT_EQ(polygonSolidAngle({}, V3d(0, 0, 0)), 0);
}

}  // namespace
}  // namespace rsphere
