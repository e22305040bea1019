#include "occluders/joined_polygons.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/random.h"
#include "tests/unit/support/scene_of.h"

namespace rsphere {
namespace {

const std::string kPanelMaterials =
    "void plastic wall 0 0 5 .6 .6 .6 0 0\nvoid glass pane 0 0 3 .9 .9 .9\n"
    "void light lamp 0 0 3 1 1 1\n";

struct Panels {
  explicit Panels(const std::string& text) : scene(sceneOf(kPanelMaterials + text)), tracer(scene, true) {}
  Scene scene;
  Tracer tracer;
  JoinedPolygons joined{scene, tracer};

  const JoinedPolygons::Area* first(bool front = true) const { return joined.areaOf(SurfaceId(0), front); }
};

std::string panel(double x, double y, double size = 1, double z = 0, const char* material = "wall") {
  return fmt::format("{0} polygon p 0 0 12 {1} {2} {5} {3} {2} {5} {3} {4} {5} {1} {4} {5}\n", material, x, y,
                     x + size, y + size, z);
}

// Whether a square, given by its middle, lies in the area.
bool holdsSquare(const JoinedPolygons::Area* area, double x, double y, double half, double margin = 1e-5) {
  const std::vector<V3d> corners{
      {x - half, y - half, 0}, {x + half, y - half, 0}, {x + half, y + half, 0}, {x - half, y + half, 0}};
  return area && area->contains(corners, margin);
}

TEST(JoinedPolygons, TouchingSquaresAreOneArea) {
  const Panels p(panel(0, 0) + panel(1, 0) + panel(0, 1) + panel(1, 1));
  ASSERT_TRUE(p.first());
  EXPECT_EQ(p.first()->size(), 4);
  EXPECT_EQ(p.first()->box(), Box3d(V3d(0), V3d(2, 2, 0)));
  EXPECT_TRUE(holdsSquare(p.first(), 1, 1, .9));
  EXPECT_TRUE(holdsSquare(p.first(false), 1, 1, .9)) << "from behind";
  EXPECT_FALSE(holdsSquare(p.first(), 1, 1, .9, .2)) << "the margin";
  EXPECT_FALSE(holdsSquare(p.first(), 1.2, 1, .9));
  EXPECT_FALSE(holdsSquare(p.first(), 7, 1, .1)) << "outside";
}

TEST(JoinedPolygons, WhatIsApartIsNotJoined) {
  EXPECT_FALSE(Panels(panel(0, 0) + panel(1.00001, 0)).first()) << "a gap";
  EXPECT_EQ(Panels(panel(0, 0) + panel(1, 1)).first()->size(), 1) << "a corner alone";
  EXPECT_FALSE(Panels(panel(0, 0) + panel(1, 0, 1, 1e-4)).first()) << "another plane";
  EXPECT_FALSE(Panels(panel(0, 0) + panel(1, 0, 1, 0, "pane")).first()) << "glass";
  EXPECT_FALSE(Panels(panel(0, 0)).first()) << "alone";
}

// Only of a rectangle, and only those in its inside.
TEST(JoinedPolygons, HolesInRectangles) {
  const auto without = [&](int missing, int also = -1) {
    std::string text;
    for (int i = 0; i < 16; ++i)
      if (i != missing && i != also) text += panel(i % 4, i / 4);
    return text;
  };
  const auto holesOf = [](const std::string& text) {
    const Panels p(text);
    return p.first() ? p.first()->holes() : std::vector<Box3d>();
  };
  EXPECT_TRUE(holesOf(without(-1)).empty());
  const auto one = holesOf(without(5));
  ASSERT_EQ(one.size(), 1);
  EXPECT_NEAR((one[0].min - V3d(1, 1, 0)).length(), 0, 1e-9);
  EXPECT_NEAR((one[0].max - V3d(2, 2, 0)).length(), 0, 1e-9);
  EXPECT_EQ(holesOf(without(5, 6)).size(), 1) << "of two panels";
  EXPECT_EQ(holesOf(without(5, 10)).size(), 1) << "of two panels that meet in a corner";
  EXPECT_TRUE(holesOf(without(7)).empty()) << "at the edge";
  EXPECT_TRUE(holesOf(without(15, 5)).empty()) << "a corner is missing";
}

// A gap or a pinhole between four squares.
TEST(JoinedPolygons, GapsOfAnyWidthAreOutlines) {
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    const Panels slit(panel(0, 0) + panel(1 + gap, 0) + panel(0, -1, 1) + panel(1, -1, 1));
    EXPECT_FALSE(holdsSquare(slit.first(), 1, 0, .5)) << gap;
    EXPECT_FALSE(holdsSquare(slit.first(), 1, .4, .2)) << gap;
    EXPECT_TRUE(holdsSquare(slit.first(), 1, -.4, .2)) << gap;
  }
}

// Seams, holes and crossing edges follow the rule of odd crossings.
TEST(JoinedPolygons, ConcavePolygons) {
  const Panels frame("wall polygon f 0 0 30 0 0 0 4 0 0 4 4 0 0 4 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0\n");
  EXPECT_TRUE(holdsSquare(frame.first(), 3, 3, .9));
  EXPECT_TRUE(holdsSquare(frame.first(), .5, .5, .45)) << "on the seam";
  EXPECT_FALSE(holdsSquare(frame.first(), 1.5, 1.5, .4)) << "in the hole";
  EXPECT_FALSE(holdsSquare(frame.first(), 2, 2, 1.5)) << "around the hole";
  const Panels twice("wall polygon t 0 0 24 0 0 0 4 0 0 4 3 0 0 3 0 0 0 0 4 0 0 4 3 0 0 3 0\n");
  EXPECT_FALSE(holdsSquare(twice.first(), 2, 1.5, .5));
  const Panels filled("wall polygon f 0 0 30 0 0 0 4 0 0 4 4 0 0 4 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0\n" +
                      panel(1, 1));
  EXPECT_TRUE(holdsSquare(filled.first(), 2, 2, 1.5)) << "a lid on the hole";
}

// Random rectangles, also with coordinates and edges in common, beside brute force.
TEST(JoinedPolygons, AgreesWithPointsInRandomRectangles) {
  Random random(3);
  int within = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const bool turned = trial % 3 == 2;
    std::string text;
    const auto coordinate = [&] {
      const double x = 6 * random.uniform();
      return random.uniform() < .8 ? std::floor(x) : x;
    };
    for (int i = 0; i < 14; ++i) {
      double x0 = coordinate(), x1 = coordinate(), y0 = coordinate(), y1 = coordinate();
      if (x0 == x1 || y0 == y1) continue;
      const auto corner = [&](double x, double y) {
        return turned ? fmt::format(" {:.17g} {:.17g} 0", .6 * x - .8 * y, .8 * x + .6 * y)
                      : fmt::format(" {:.17g} {:.17g} 0", x, y);
      };
      text +=
          "wall polygon r 0 0 12" + corner(x0, y0) + corner(x1, y0) + corner(x1, y1) + corner(x0, y1) + "\n";
    }
    const Panels p(text);
    for (const SurfaceId id : p.scene.outermostIds()) {
      const JoinedPolygons::Area* const area = p.joined.areaOf(id, random.uniform() < .5);
      if (!area) continue;
      for (int k = 0; k < 10; ++k) {
        const V3d middle = area->box().min + V3d(area->box().size().x * random.uniform(),
                                                 area->box().size().y * random.uniform(), 0);
        const double half = .1 + random.uniform();
        if (!holdsSquare(area, middle.x, middle.y, half)) continue;
        ++within;
        for (int n = 0; n < 50; ++n) {
          const V3d at = middle + half * V3d(2 * random.uniform() - 1, 2 * random.uniform() - 1, 0);
          EXPECT_EQ(p.tracer.shadow(at + V3d(0, 0, 1), {0, 0, -1}, 2, kNone), Shadow::blocked);
        }
      }
    }
  }
  EXPECT_GT(within, 300);
}

// Many long polygons that cross take no more than a time that grows with their number.
TEST(JoinedPolygons, AGridOfStripsIsAnsweredAtOnce) {
  std::string text;
  for (int i = 0; i < 1500; ++i) {
    text += fmt::format("wall polygon x 0 0 12 0 {0} 0 3000 {0} 0 3000 {1} 0 0 {1} 0\n", 2 * i, 2 * i + 1);
    text += fmt::format("wall polygon y 0 0 12 {0} 0 0 {1} 0 0 {1} 3000 0 {0} 3000 0\n", 2 * i, 2 * i + 1);
  }
  EXPECT_FALSE(holdsSquare(Panels(text).first(), 1500, 1500, 3));
}

}  // namespace
}  // namespace rsphere
