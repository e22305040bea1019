#include "trace/tracer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::tracer_test {
namespace {

// Shapes are put at multiples of 2^-10, so that moving them by whole units rounds nothing.
double onGrid(double x) { return std::round(x * 0x1p10) * 0x1p-10; }
V3d onGrid(const V3d& p) { return V3d(onGrid(p.x), onGrid(p.y), onGrid(p.z)); }
std::string text(const V3d& p) { return fmt::format(" {} {} {}", p.x, p.y, p.z); }

constexpr const char* kMaterials =
    "void plastic gray\n0\n0\n5 .5 .5 .5 0 0\n"
    "void glass pane\n0\n0\n3 .9 .9 .9\n"
    "void metal steel\n0\n0\n5 .5 .5 .5 .9 0\n"
    "void light lamp\n0\n0\n3 1 1 1\n";

// Many shapes of every type in a box of half-size 10 around the place.
std::string clutter(const V3d& place, int count) {
  Random random(11);
  const char* const modifiers[] = {"gray", "pane", "steel", "void"};
  std::string scene = kMaterials;
  for (int i = 0; i < count; ++i) {
    const V3d at = place + onGrid(randomPoint(random, 10));
    const V3d u = onGrid(randomPoint(random, 2)), v = onGrid(randomPoint(random, 2));
    const double r = onGrid(between(random, .1, 1.5)), r1 = onGrid(between(random, .1, 1));
    const auto modifier = modifiers[random.bits() % 4];
    switch (i % 6) {
      case 0: scene += fmt::format("{} sphere s{}\n0\n0\n4{} {}\n", modifier, i, text(at), r); break;
      case 1:
        scene += fmt::format("{} cone s{}\n0\n0\n8{}{} {} {}\n", modifier, i, text(at), text(at + u), r, r1);
        break;
      case 2:
        scene += fmt::format("{} tube s{}\n0\n0\n7{}{} {}\n", modifier, i, text(at), text(at + u), r1);
        break;
      case 3:
        scene += fmt::format("{} ring s{}\n0\n0\n8{}{} 0 {}\n", modifier, i, text(at), text(u), r);
        break;
      default:
        scene += fmt::format("{} polygon s{}\n0\n0\n12{}{}{}{}\n", modifier, i, text(at), text(at + u),
                             text(at + u + v), text(at + v));
    }
  }
  return scene;
}

bool meets(const Scene& scene, const Surface& surface, const V3d& origin, const V3d& direction,
           double farthest, ShapeHit& hit) {
  if (const auto* s = surface.shape.as<Polygon>())
    return intersect(*s, scene.vertices, origin, direction, farthest, hit);
  if (const auto* s = surface.shape.as<Sphere>()) return intersect(*s, origin, direction, farthest, hit);
  if (const auto* s = surface.shape.as<Cone>()) return intersect(*s, origin, direction, farthest, hit);
  if (const auto* s = surface.shape.as<Ring>()) return intersect(*s, origin, direction, farthest, hit);
  return false;
}

// Every surface asked in turn. No two of these scenes' surfaces coincide but by accident.
Hit nearestOfAll(const Scene& scene, const V3d& origin, const V3d& direction, double farthest) {
  Hit nearest;
  for (const SurfaceId i : scene.surfaces.ids()) {
    ShapeHit hit;
    if (!meets(scene, scene.surfaces[i], origin, direction, farthest, hit)) continue;
    if (hit.distance >= nearest.distance) continue;
    nearest = {i, hit.distance, hit.normal, hit.cosine};
  }
  return nearest;
}

struct Probe {
  V3d origin, direction;
};

// From within the clutter, from outside, and from very far away.
std::vector<Probe> probes(int count) {
  Random random(12);
  std::vector<Probe> rays;
  for (int i = 0; i < count; ++i) {
    const double from = i % 3 == 0 ? 10 : i % 3 == 1 ? 40 : 1e5;
    const V3d origin = onGrid(randomPoint(random, from));
    rays.push_back({origin, (randomPoint(random, 10) - origin).normalized()});
  }
  return rays;
}

TEST(Tracer, FindsWhatALoopOverAllSurfacesFindsWhereverTheSceneLies) {
  const Scene home = sceneOf(clutter(V3d(0, 0, 0), 400));
  const std::vector<Probe> rays = probes(6000);
  for (const double shift : {0., 1e5, 5e6}) {
    const V3d place(shift, -shift, shift);
    const Scene scene = sceneOf(clutter(place, 400));
    const Tracer tracer(scene, true);
    int hits = 0, otherThanLoop = 0, otherThanAtHome = 0;
    for (const Probe& ray : rays) {
      const double farthest = hits % 5 ? kFarAway : 8;
      const Hit found = tracer.nearest(place + ray.origin, ray.direction, farthest);
      const Hit expected = nearestOfAll(scene, place + ray.origin, ray.direction, farthest);
      hits += expected.surface != kNone;
      otherThanLoop += found.surface != expected.surface || found.distance != expected.distance;
      otherThanAtHome += found.surface != nearestOfAll(home, ray.origin, ray.direction, farthest).surface;
    }
    EXPECT_GT(hits, 3000);
    EXPECT_EQ(otherThanLoop, 0) << "shift " << shift;
    // Edges may be hit or missed by a rounding of 1e-9 in 5e6.
    EXPECT_EQ(otherThanAtHome, 0) << "shift " << shift;
  }
}

TEST(Tracer, FindsAMillimetreSphereInASceneOfSixThousandKilometres) {
  const Scene scene = sceneOf(std::string(kMaterials) +
                              "gray sphere tiny\n0\n0\n4 123456 -234567 345678 .001\n"
                              "gray bubble sky\n0\n0\n4 0 0 0 6e6\n");
  const Tracer tracer(scene, true);
  const V3d center(123456, -234567, 345678);
  Random random(13);
  for (int i = 0; i < 1000; ++i) {
    const V3d away = randomDirection(random);
    const V3d origin = center + (i % 2 ? 1. : 1e6) * away;
    const V3d across = away.cross(randomDirection(random)).normalized();
    const V3d at = center + .9e-3 * across, past = center + 1.1e-3 * across;
    EXPECT_EQ(tracer.nearest(origin, (at - origin).normalized()).surface, SurfaceId(0));
    EXPECT_EQ(tracer.nearest(origin, (past - origin).normalized()).surface, SurfaceId(1));
  }
}

TEST(Tracer, FanOfAThousandTrianglesHasNoHole) {
  for (const double shift : {0., 1e5}) {
    std::string fan = kMaterials;
    const V3d apex(shift, shift, 0);
    for (int k = 0; k < 1000; ++k) {
      const auto rim = [&](int i) {
        const double a = 2 * std::numbers::pi * (i % 1000) / 1000;
        return apex + V3d(std::cos(a), std::sin(a), 0);
      };
      fan += fmt::format("gray polygon p\n0\n0\n9{}{}{}\n", text(apex), text(rim(k)), text(rim(k + 1)));
    }
    const Scene scene = sceneOf(fan);
    const Tracer tracer(scene, true);
    Random random(14);
    for (int i = 0; i < 5000; ++i) {
      const double angle = 2 * std::numbers::pi * random.uniform();
      const V3d target = apex + 1e-5 * V3d(std::cos(angle), std::sin(angle), 0);
      const V3d origin = apex + V3d(0, 0, 1) + randomPoint(random, .5);
      EXPECT_NE(tracer.nearest(origin, (target - origin).normalized()).surface, kNone);
    }
  }
}

// ---- ties

std::string square(const char* modifier, const char* name, bool up = true, double z = 0) {
  return up ? fmt::format("{} polygon {}\n0\n0\n12 -1 -1 {z} 1 -1 {z} 1 1 {z} -1 1 {z}\n", modifier, name,
                          fmt::arg("z", z))
            : fmt::format("{} polygon {}\n0\n0\n12 -1 1 {z} 1 1 {z} 1 -1 {z} -1 -1 {z}\n", modifier, name,
                          fmt::arg("z", z));
}

// The name of what a ray from above hits first.
std::string seenFromAbove(const std::string& surfaces) {
  const Scene scene = sceneOf(kMaterials + surfaces);
  const Tracer tracer(scene, true);
  const Hit hit = tracer.nearest(V3d(.25, .125, 3), V3d(0, 0, -1));
  return hit.surface == kNone ? "" : std::string(scene.surfaceName(scene.surfaces[hit.surface]));
}

// Each rule in both orders of the file, and with the rules after it speaking for the loser.
TEST(Tracer, ChoosesBetweenCoincidentSurfacesAsRadianceDoes) {
  struct Tie {
    std::string winner, loser, why;
  };
  const std::vector<Tie> ties = {
      {square("gray", "winner", false), square("void", "loser"), "one with a material"},
      {square("pane", "winner", false), square("void", "loser"), "one with a material, though transparent"},
      {square("gray", "winner", false), square("pane", "loser"), "opaque before transparent"},
      {square("gray", "winner"), square("steel", "loser", false), "front before back"},
      {square("steel", "winner"), square("gray", "loser"), "the later modifier"},
      {square("steel", "winner", false), square("gray", "loser", false),
       "the later modifier, both from behind"},
      {square("gray", "winner", true, -.9e-6), square("void", "loser"), "close counts as coincident"},
  };
  for (const Tie& tie : ties) {
    EXPECT_EQ(seenFromAbove(tie.winner + tie.loser), "winner") << tie.why;
    EXPECT_EQ(seenFromAbove(tie.loser + tie.winner), "winner") << tie.why << ", other order";
  }
  EXPECT_EQ(seenFromAbove(square("gray", "first") + square("gray", "second")), "second")
      << "of one modifier, the later surface";
  EXPECT_EQ(seenFromAbove(square("gray", "low", true, -2e-6) + square("void", "high")), "high")
      << "beyond the tolerance the nearer one counts";
}

TEST(Tracer, TakesAnyNumberOfCoincidentSurfaces) {
  for (const int copies : {20, 300}) {
    std::string scene;
    for (int i = 0; i < copies; ++i) scene += square("gray", "other");
    const std::string winner = square("steel", "winner");
    for (const std::string& all : {scene + winner, winner + scene}) EXPECT_EQ(seenFromAbove(all), "winner");
    for (int i = 0; i < copies; ++i) scene += square("gray", "other", false);
    EXPECT_EQ(seenFromAbove(scene), "other");
  }
}

// ---- shadows

// By the loop: what lies before the source.
Shadow shadowOfAll(const Scene& scene, const V3d& origin, const V3d& direction, double distance,
                   SurfaceId source) {
  Shadow shadow = Shadow::clear;
  for (const SurfaceId i : scene.surfaces.ids()) {
    const Surface& s = scene.surfaces[i];
    ShapeHit hit;
    if (i == source) continue;
    if (!meets(scene, s, origin, direction, distance - kSamePlace, hit)) continue;
    if (const Material* m = scene.materialOf(s); m && !isTransparent(*m)) return Shadow::blocked;
    shadow = Shadow::unsure;
  }
  return shadow;
}

TEST(Tracer, TellsShadowsAsALoopOverAllSurfacesDoes) {
  for (const double shift : {0., 1e5, 5e6}) {
    const V3d place(shift, shift, -shift);
    const Scene scene = sceneOf(clutter(place, 90) +
                                fmt::format("lamp sphere l\n0\n0\n4{} 1\n", text(place + V3d(0, 0, 14))));
    const SurfaceId lamp = scene.surfaces.last();
    const Tracer tracer(scene, true);
    Random random(15);
    int counts[3] = {0, 0, 0}, wrong = 0;
    for (int i = 0; i < 6000; ++i) {
      const V3d origin = place + onGrid(randomPoint(random, 11));
      const bool distant = i % 2;
      const V3d aim = place + V3d(0, 0, 14) + .5 * randomDirection(random);
      const V3d direction = distant ? randomDirection(random) : (aim - origin).normalized();
      double distance = kFarAway;
      if (!distant) {
        ShapeHit hit;
        ASSERT_TRUE(meets(scene, scene.surfaces[lamp], origin, direction, kFarAway, hit));
        distance = hit.distance;
      }
      const SurfaceId source = distant ? kNone : lamp;
      const Shadow expected = shadowOfAll(scene, origin, direction, distance, source);
      ++counts[static_cast<int>(expected)];
      wrong += tracer.shadow(origin, direction, distance, source) != expected;
    }
    EXPECT_EQ(wrong, 0) << "shift " << shift;
    for (const int count : counts) EXPECT_GT(count, 200) << "too few of a kind for a test";
  }
}

// Light may be refracted past what stands behind a dielectric, but not past what stands before it.
TEST(Tracer, TellsShadowsBehindWhatRefractsApart) {
  const std::string materials = std::string(kMaterials) +
                                "void dielectric ice\n0\n0\n5 .9 .9 .9 1.3 0\n"
                                "void interface oil\n0\n0\n8 .9 .9 .9 1.5 .9 .9 .9 1.3\n"
                                "void mixfunc half\n4 gray ice .5 .\n0\n0\n"
                                "void mirror twoway\n1 ice\n0\n3 .9 .9 .9\n"
                                "void illum window\n1 half\n0\n3 1 1 1\n"
                                "void antimatter cut\n1 ice\n0\n0\n";
  const char* const refracting[] = {"ice", "oil", "half", "twoway", "window", "cut"};
  const char* const straight[] = {"pane", "void", "lamp", "gray", "gray", "gray"};
  Random random(21);
  std::string things = materials;
  for (int i = 0; i < 200; ++i) {
    const V3d at = randomPoint(random, 5), u = randomPoint(random, 2), v = randomPoint(random, 2);
    const char* modifier = (random.uniform() < .4 ? refracting : straight)[random.bits() % 6];
    if (i % 2)
      things += fmt::format("{} sphere s{}\n0\n0\n4{} {}\n", modifier, i, text(at), between(random, .1, 1));
    else
      things +=
          fmt::format("{} polygon s{}\n0\n0\n9{}{}{}\n", modifier, i, text(at), text(at + u), text(at + v));
  }
  const Scene scene = sceneOf(things);
  const Tracer tracer(scene, true);
  int counts[4] = {0, 0, 0, 0}, wrong = 0;
  std::vector<uint32_t> blockers(100, Tracer::kNoBlocker);
  for (int i = 0; i < 5000; ++i) {
    const V3d origin = randomPoint(random, 6), direction = randomDirection(random);
    const double distance = between(random, 1, 20);
    double refracts = kFarAway, stops = kFarAway;
    Shadow expected = Shadow::clear;
    for (const Surface& s : scene.surfaces) {
      ShapeHit hit;
      if (!meets(scene, s, origin, direction, distance, hit)) continue;
      expected = Shadow::unsure;
      const std::string_view name = scene.modifierName(s);
      if (name == "gray" || name == "lamp") stops = std::min(stops, hit.distance);
      if (std::find(std::begin(refracting), std::end(refracting), name) != std::end(refracting))
        refracts = std::min(refracts, hit.distance);
    }
    if (stops < kFarAway) expected = stops < refracts ? Shadow::blocked : Shadow::refracted;
    ++counts[static_cast<int>(expected)];
    // Whatever stopped the ray before.
    wrong += tracer.shadow(origin, direction, distance, kNone, &blockers[i % 100]) != expected;
    wrong += tracer.shadow(origin, direction, distance, kNone) != expected;
  }
  EXPECT_EQ(wrong, 0);
  for (const int count : counts) EXPECT_GT(count, 150) << "too few of a kind for a test";
}

// Curved surfaces can be met again from where they were met; what is named and plane is left out even where a
// ray begins before it.
TEST(Tracer, LeavesOutThePlaneSurfaceThatARayBeginsOnAndNoOther) {
  const Scene scene = sceneOf(clutter(V3d(0, 0, 0), 90));
  const Tracer tracer(scene, true);
  Random random(16);
  int again = 0;
  for (int i = 0; i < 3000; ++i) {
    const V3d origin = onGrid(randomPoint(random, 11)), direction = randomDirection(random);
    const Hit first = tracer.nearest(origin, direction);
    if (first.surface == kNone) continue;
    const V3d point = origin + first.distance * direction, onward = randomDirection(random);
    const Hit next = tracer.nearest(point, onward, kFarAway, first.surface);
    EXPECT_EQ(next.surface, tracer.nearest(point, onward).surface);
    EXPECT_EQ(tracer.shadow(point, onward, kFarAway, kNone, nullptr, first.surface),
              tracer.shadow(point, onward, kFarAway, kNone));
    again += next.surface == first.surface;
    const bool plane = planeNormal(scene.surfaces[first.surface].shape) != nullptr;
    EXPECT_EQ(tracer.nearest(origin, direction, kFarAway, first.surface).surface == first.surface, !plane);
  }
  EXPECT_GT(again, 20) << "too few to tell";
}

// A source is not in its own shadow, nor in that of what lies under it.
TEST(Tracer, TieAtTheSourceDecidesItsShadow) {
  const auto shadowAt = [](const std::string& surfaces) {
    const Scene scene = sceneOf(kMaterials + surfaces);
    const Tracer tracer(scene, true);
    SurfaceId lamp;
    for (const SurfaceId i : scene.surfaces.ids())
      if (scene.surfaceName(scene.surfaces[i]) == "lamp") lamp = i;
    return tracer.shadow(V3d(.25, .125, 3), V3d(0, 0, -1), 3, lamp);
  };
  const std::string lamp = square("lamp", "lamp"), plate = square("gray", "plate");
  EXPECT_EQ(shadowAt(lamp), Shadow::clear);
  EXPECT_EQ(shadowAt(lamp + plate), Shadow::clear) << "light is the later modifier";
  EXPECT_EQ(shadowAt(plate + lamp), Shadow::clear);
  EXPECT_EQ(shadowAt(lamp + square("gray", "plate", true, .01)), Shadow::blocked);
  EXPECT_EQ(shadowAt(lamp + square("gray", "plate", true, -.01)), Shadow::clear);
  EXPECT_EQ(shadowAt(lamp + square("pane", "plate", true, .01)), Shadow::unsure);
  const std::string later = "void plastic later\n0\n0\n5 .5 .5 .5 0 0\n" + square("later", "plate");
  EXPECT_EQ(shadowAt(lamp + later), Shadow::blocked) << "the later modifier lies on the lamp";
}

TEST(Tracer, OpaqueFromBehindOnlyWhereBackFacesAreVisible) {
  const Scene scene = sceneOf(kMaterials + square("gray", "plate", false));
  EXPECT_EQ(Tracer(scene, true).shadow(V3d(0, 0, 1), V3d(0, 0, -1), kFarAway, kNone), Shadow::blocked);
  EXPECT_EQ(Tracer(scene, false).shadow(V3d(0, 0, 1), V3d(0, 0, -1), kFarAway, kNone), Shadow::unsure);
  EXPECT_EQ(Tracer(scene, false).shadow(V3d(0, 0, -1), V3d(0, 0, 1), kFarAway, kNone), Shadow::blocked);
}

// ---- limits

TEST(Tracer, RaysDoNotHitWhereTheyStart) {
  const Scene scene = sceneOf(kMaterials + square("gray", "a") + square("gray", "b", true, -5));
  const Tracer tracer(scene, true);
  EXPECT_EQ(tracer.nearest(V3d(0, 0, 0), V3d(0, 0, -1)).surface, SurfaceId(1));
  EXPECT_EQ(tracer.nearest(V3d(0, 0, .5e-6), V3d(0, 0, -1)).surface, SurfaceId(1));
  EXPECT_EQ(tracer.nearest(V3d(0, 0, 2e-6), V3d(0, 0, -1)).surface, SurfaceId(0));
}

TEST(Tracer, RaysThatStartInSpaceHitWhatIsNear) {
  const Scene scene = sceneOf(kMaterials + square("gray", "a") + square("gray", "b", true, -5));
  const Tracer tracer(scene, true);
  const V3d down(0, 0, -1);
  EXPECT_EQ(tracer.nearest(V3d(0, 0, 1e-9), down, kFarAway, kInSpace).surface, SurfaceId(0));
  EXPECT_EQ(tracer.nearest(V3d(0, 0, 1e-14), down, kFarAway, kInSpace).surface, SurfaceId(1)) << "rounding";
  EXPECT_EQ(tracer.shadow(V3d(0, 0, 1e-9), down, 4, kNone, nullptr, kInSpace), Shadow::blocked);
  EXPECT_EQ(tracer.shadow(V3d(0, 0, 1e-9), down, 4, kNone), Shadow::clear);
  EXPECT_FALSE(tracer.isClear(V3d(0, 0, 1e-9), down, 4, kInSpace));
  EXPECT_TRUE(tracer.isClear(V3d(0, 0, 1e-9), down, 4));
}

// The same scene and rays at other sizes, where 1e-6 would be a wall or less than rounding.
TEST(Tracer, MarginsFollowTheSizeOfTheScene) {
  for (const double size : {1e-9, 1e-6, 1e-3, 1., 1e3, 1e9}) {
    const auto plate = [&](const char* name, double z) {
      return fmt::format("gray polygon {} 0 0 12 {a} {a} {z} {b} {a} {z} {b} {b} {z} {a} {b} {z}\n", name,
                         fmt::arg("a", -size), fmt::arg("b", size), fmt::arg("z", z));
    };
    const Scene scene = sceneOf(kMaterials + plate("a", 0) + plate("b", -size) +
                                fmt::format("gray sphere c 0 0 4 0 0 {} {}\n", 2 * size, .5 * size));
    const Tracer tracer(scene, true);
    const V3d down(0, 0, -1);
    EXPECT_EQ(tracer.nearest(V3d(0, 0, 1e-3 * size), down).surface, SurfaceId(0)) << size;
    EXPECT_EQ(tracer.nearest(V3d(0, 0, 0), down).surface, SurfaceId(1)) << size;
    const Hit ball = tracer.nearest(V3d(.1 * size, 0, size), V3d(0, 0, 1));
    EXPECT_EQ(ball.surface, SurfaceId(2)) << size;
    const V3d onBall = V3d(.1 * size, 0, size) + ball.distance * V3d(0, 0, 1);
    EXPECT_EQ(tracer.nearest(onBall, ball.normal, kFarAway, ball.surface).surface, SurfaceId(0)) << size;
    EXPECT_EQ(tracer.shadow(V3d(0, 0, 1e-3 * size), down, .5 * size, kNone), Shadow::blocked) << size;
  }
}

TEST(Tracer, StopsAtTheFarthestPlace) {
  const Scene scene = sceneOf(kMaterials + square("gray", "a"));
  const Tracer tracer(scene, true);
  EXPECT_EQ(tracer.nearest(V3d(0, 0, 5), V3d(0, 0, -1), 5).surface, SurfaceId(0));
  const Hit miss = tracer.nearest(V3d(0, 0, 5), V3d(0, 0, -1), 4.999);
  EXPECT_EQ(miss.surface, kNone);
  EXPECT_EQ(miss.distance, kFarAway);
}

// Whether the bounds of any surface that is small and not in the neighborhood's plane come within its radius.
bool anySmallNearOfAll(const Scene& scene, const Tracer::Neighborhood& around) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& s) {
    const Box3d box = bounds(s.shape, scene.vertices);
    if (box.isEmpty()) return false;
    double squares = 0, width = 0;
    for (int i = 0; i < 3; ++i) {
      const double out = std::max({box.min[i] - around.point[i], 0., around.point[i] - box.max[i]});
      squares += out * out;
      width = std::max(width, box.size()[i]);
    }
    return width <= around.widest && squares <= around.radius * around.radius;
  });
}

TEST(Tracer, FindsSmallObjectsAsALoopOverAllSurfacesDoes) {
  for (const double shift : {0., 1e5, 5e6}) {
    const V3d place(shift, shift, -shift);
    const Scene scene = sceneOf(clutter(place, 90));
    const Tracer tracer(scene, true);
    Random random(16);
    int found = 0, wrong = 0;
    for (int i = 0; i < 4000; ++i) {
      Tracer::Neighborhood around;
      around.point = place + onGrid(randomPoint(random, 14));
      around.normal = randomDirection(random);
      around.radius = between(random, .1, 4);
      around.widest = between(random, .5, 3);
      const bool expected = anySmallNearOfAll(scene, around);
      found += expected;
      wrong += tracer.anySmallNear(around) != expected;
    }
    EXPECT_EQ(wrong, 0) << "shift " << shift;
    EXPECT_GT(found, 400) << "too few for a test";
    EXPECT_LT(found, 3600) << "too many for a test";
  }
}

TEST(Tracer, TilesInThePlaneOfAFloorAreNoObjectsOnIt) {
  const Scene scene = sceneOf(std::string(kMaterials) +
                              "gray polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 4 -9 9 4\n"
                              "gray polygon tile 0 0 12 0 0 2 1 0 2 1 9 4 0 9 4\n"
                              "gray ring manhole 0 0 8 -3 0 2 0 -4 18 0 .5\n");
  const Tracer tracer(scene, true);
  const V3d up = V3d(0, -4, 18).normalized(), across = V3d(0, 18, 4).normalized();
  const V3d site = V3d(-1, 0, 2) + 1e-4 * up;
  EXPECT_FALSE(tracer.anySmallNear({site, up, 3, 10, 3e-4}));
  EXPECT_TRUE(tracer.anySmallNear({site, up, 3, 10, 1e-5})) << "the plane is farther than the thickness";
  EXPECT_TRUE(tracer.anySmallNear({site, across, 3, 10, 3e-4})) << "a wall beside them sees them as objects";
  EXPECT_FALSE(tracer.anySmallNear({site, across, 3, .9, 3e-4})) << "the tile and the manhole are wider";
}

TEST(Tracer, AnswersForScenesWithNothingToHit) {
  for (const char* surfaces : {"", "lamp source sun\n0\n0\n4 0 0 1 .5\n"}) {
    const Scene scene = sceneOf(std::string(kMaterials) + surfaces);
    const Tracer tracer(scene, true);
    EXPECT_EQ(tracer.nearest(V3d(0, 0, 0), V3d(0, 0, 1)).surface, kNone);
    EXPECT_EQ(tracer.shadow(V3d(0, 0, 0), V3d(0, 0, 1), kFarAway, kNone), Shadow::clear);
    EXPECT_TRUE(tracer.bounds().isEmpty());
    EXPECT_FALSE(tracer.anySmallNear({V3d(0, 0, 0), V3d(0, 0, 1), 10, 10, 0}));
  }
}

}  // namespace
}  // namespace rsphere::tracer_test
