// examples/grid without its tracing: areas, grids, isolines and the picture.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "area.h"
#include "drawing.h"
#include "isolines.h"
#include "layout.h"
#include "rad_parser/scene_file.h"
#include "tests/unit/support/files_of.h"

namespace grid {
namespace {

constexpr const char* kMaterials =
    "void plastic carpet 0 0 5 .2 .2 .2 0 0 void plastic wood 0 0 5 .3 .3 .3 0 0\n";
// 6 x 4, without the upper right quarter of 3 x 2.
const std::string kL = "carpet polygon L 0 0 18 0 0 0 6 0 0 6 2 0 3 2 0 3 4 0 0 4 0\n";
// 6 x 6 with a hole from (2,2) to (4,4) behind a seam from (0,0) to (2,2).
const std::string kHole =
    "carpet polygon holed 0 0 30 0 0 0 6 0 0 6 6 0 0 6 0 0 0 0  2 2 0 2 4 0 4 4 0 4 2 0 2 2 0\n";

Area areaOf(const std::string& polygons, const std::string& name, bool reversed = false,
            bool upOnly = false) {
  const std::string names[] = {name};
  return findArea(rad::readSceneText(kMaterials + polygons, "test"), names, reversed, upOnly);
}

std::string messageOf(const std::string& polygons, const std::string& name) {
  try {
    areaOf(polygons, name);
  } catch (const rad::Error& error) {
    return error.what();
  }
  return "no error";
}

// The grid of a linear field, lux = 100 + 30 u + 50 v.
double linear(const V2d& p) { return 100 + 30 * p.x + 50 * p.y; }
std::vector<double> linear(const Grid& grid) {
  std::vector<double> values;
  for (const V2d& p : grid.points) values.push_back(linear(p));
  return values;
}

TEST(GridArea, BoundaryOfAnLIsItsSixEdges) {
  const Area area = areaOf(kL, "L");
  EXPECT_EQ(area.edges().size(), 6u);
  EXPECT_TRUE(area.contains(V2d(1, 3)));
  EXPECT_FALSE(area.contains(V2d(4, 3)));
  EXPECT_DOUBLE_EQ(area.distanceToEdge(V2d(2, 2.5)), 1);
}

// As programs draw circles. Comparing all corners with all others took seconds.
TEST(GridArea, CirclesOfManyCornersAreReadyAtOnce) {
  constexpr int kCorners = 20000;
  std::string circle = "carpet polygon circle 0 0 60000";
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    circle +=
        " " + std::to_string(5 + 2 * std::cos(angle)) + " " + std::to_string(2 * std::sin(angle)) + " 0";
  }
  const Area area = areaOf(circle, "circle");
  EXPECT_NEAR(static_cast<double>(area.edges().size()), kCorners, 100);
  EXPECT_TRUE(area.contains(V2d(5 + 1.41, 1.41)));
  EXPECT_FALSE(area.contains(V2d(5 + 1.42, 1.42)));
  EXPECT_NEAR(area.distanceToEdge(V2d(5, 1)), 1, 1e-5);
  EXPECT_EQ(layGrid(area, .5, 0).points.size(), 32u);
}

TEST(GridArea, SeamOfAHoleIsNoEdge) {
  const Area area = areaOf(kHole, "holed");
  EXPECT_EQ(area.edges().size(), 8u);
  EXPECT_FALSE(area.contains(V2d(3, 3)));
  EXPECT_NEAR(area.distanceToEdge(V2d(1, 1)), 1, 1e-12);  // (1,1) lies on the seam
}

TEST(GridArea, TrianglesInOnePlaneAreOneSurface) {
  // The second triangle has the opposite sense, and a vertex of the third lies within an edge of the second.
  const std::string triangles =
      "carpet polygon a 0 0 9 0 0 0 4 0 0 0 4 0  carpet polygon b 0 0 9 4 0 0 0 4 0 4 4 0\n"
      "carpet polygon c 0 0 9 4 0 0 8 0 0 4 2 0  wood polygon top 0 0 9 0 0 1 4 0 1 0 4 1\n";
  const Area area = areaOf(triangles, "carpet");
  double length = 0;
  for (const Edge& edge : area.edges()) length += (edge.to - edge.from).length();
  EXPECT_NEAR(length, 4 + 4 + 4 + 2 + std::hypot(4, 2) + 4, 1e-9);
}

TEST(GridArea, CopiesOfXformHaveNamesOfTheirOwn) {
  const rsphere::SceneFolder folder;
  const std::string file = folder.write("l.rad", kMaterials + kL);
  const std::string scene =
      "!xform -n north -t 0 0 2 " + file + "\n!xform -n south -rz 90 -t 10 0 5 " + file + "\n";
  const Area south = areaOf(scene, "south.L");
  EXPECT_DOUBLE_EQ(south.plane().at(V2d(0, 0)).z, 5);
  EXPECT_TRUE(south.contains(V2d(9, 5)));  // (5,1) of the original
  EXPECT_FALSE(south.contains(V2d(7, 5)));
  EXPECT_NE(messageOf(scene, "L").find("north.L, south.L"), std::string::npos);
}

TEST(GridArea, AliasIsAModifierToo) {
  const std::string rug = "void alias rug carpet  rug polygon r 0 0 9 0 0 1 1 0 1 0 1 1\n";
  EXPECT_DOUBLE_EQ(areaOf(rug, "rug").plane().at(V2d(0, 0)).z, 1);
  EXPECT_DOUBLE_EQ(areaOf(rug, "carpet").plane().at(V2d(0, 0)).z, 1);
}

TEST(GridArea, WallIsSeenFromItsFront) {
  // Faces -y: seen from there, x runs to the right and z upwards.
  const Area wall = areaOf("carpet polygon wall 0 0 12 1 5 2 4 5 2 4 5 4 1 5 4\n", "wall");
  EXPECT_FALSE(wall.plane().horizontal());
  EXPECT_NEAR((wall.plane().at(V2d(1, .5), .25) - V3d(2, 4.75, 2.5)).length(), 0, 1e-12);
  const Area back = areaOf("carpet polygon wall 0 0 12 1 5 2 4 5 2 4 5 4 1 5 4\n", "wall", true);
  EXPECT_NEAR((back.plane().at(V2d(1, .5), .25) - V3d(2, 5.25, 2.5)).length(), 0, 1e-12);
}

TEST(GridArea, SlopeIsFollowed) {
  // A ramp of 45 degrees.
  const Plane plane = areaOf("carpet polygon ramp 0 0 12 0 0 0 2 0 0 2 2 2 0 2 2\n", "ramp").plane();
  EXPECT_NEAR((plane.normal - V3d(0, -1, 1).normalized()).length(), 0, 1e-12);
  const V3d p = plane.at(V2d(1, 1));
  EXPECT_NEAR(p.z, p.y, 1e-12);
}

TEST(GridArea, MessagesNameTheRemedy) {
  EXPECT_EQ(messageOf("wood polygon floor 0 0 9 0 0 0 1 0 0 0 1 0\n", "flor"),
            "no polygon and no modifier of a polygon is named \"flor\"; similar names are: floor");
  EXPECT_EQ(
      messageOf("wood polygon floor 0 0 9 0 0 0 1 0 0 0 1 0\n", "ceiling"),
      "no polygon and no modifier of a polygon is named \"ceiling\"; the largest horizontal polygons are: "
      "floor");
  EXPECT_EQ(messageOf("wood sphere ball 0 0 4 0 0 0 1\n", "ball"),
            "\"ball\" is a sphere; only polygons can have a grid");
  EXPECT_NE(
      messageOf(kL + "carpet polygon up 0 0 9 0 0 1 1 0 1 0 1 1\n", "carpet").find("not all in one plane"),
      std::string::npos);
}

TEST(GridArea, BoxesHaveTops) {
  const std::string box =
      "wood polygon b.top 0 0 12 0 0 1 1 0 1 1 1 1 0 1 1\n"
      "wood polygon b.bottom 0 0 12 0 0 0 0 1 0 1 1 0 1 0 0\n"
      "wood polygon b.side 0 0 12 0 0 0 1 0 0 1 0 1 0 0 1\n";
  const std::string message = messageOf(box, "wood");
  EXPECT_TRUE(message.ends_with("; -u takes the one that faces up")) << message;
  const Area top = areaOf(box, "wood", false, true);
  EXPECT_EQ(top.plane().at(V2d(0, 0)).z, 1);
  EXPECT_EQ(top.plane().normal.z, 1);
  EXPECT_THROW(areaOf("wood polygon b.bottom 0 0 12 0 0 0 0 1 0 1 1 0 1 0 0\n", "wood", false, true),
               rad::Error);
}

TEST(GridLayout, SpacingOfTheStandard) {
  EXPECT_NEAR(standardSpacing(10, 8), 1, 1e-12);
  EXPECT_NEAR(standardSpacing(8, 10), 1, 1e-12);
  EXPECT_NEAR(standardSpacing(5, 4), .2 * std::pow(5, std::log10(5)), 1e-12);
  EXPECT_NEAR(standardSpacing(100, 60), 5, 1e-12);
  EXPECT_NEAR(standardSpacing(30, 10), 1, 1e-12);  // three times as long as wide: the width decides
  EXPECT_NEAR(standardSpacing(1e4, 1e4), 10, 1e-12);
}

TEST(GridLayout, RectangleIsFilled) {
  const Grid grid = layGrid(areaOf("carpet polygon f 0 0 12 0 0 0 8 0 0 8 6 0 0 6 0\n", "f"), .5, 0);
  EXPECT_EQ(grid.columns, 16);
  EXPECT_EQ(grid.rows, 12);
  ASSERT_EQ(grid.points.size(), 192u);
  EXPECT_NEAR((grid.points[0] - V2d(.25, .25)).length(), 0, 1e-12);
  EXPECT_NEAR((grid.points[17] - V2d(.75, .75)).length(), 0, 1e-12);
}

TEST(GridLayout, MarginIsABandWithoutCells) {
  const Grid grid = layGrid(areaOf("carpet polygon f 0 0 12 0 0 0 8 0 0 8 6 0 0 6 0\n", "f"), .5, .5);
  EXPECT_EQ(grid.points.size(), 14u * 10u);
  EXPECT_NEAR((grid.points[0] - V2d(.75, .75)).length(), 0, 1e-12);
}

// Each cell that lies in the area is there, and no other.
TEST(GridLayout, LAndHoleAreExact) {
  const Area l = areaOf(kL, "L");
  const Grid ofL = layGrid(l, .25, 0);
  EXPECT_EQ(ofL.points.size(), 18u * 16u);  // 18 square units
  for (const V2d& p : ofL.points) EXPECT_TRUE(p.x < 3 || p.y < 2) << p.x << ' ' << p.y;

  const Grid ofHole = layGrid(areaOf(kHole, "holed"), .25, 0);
  EXPECT_EQ(ofHole.points.size(), 32u * 16u);
  for (const V2d& p : ofHole.points)
    EXPECT_TRUE(std::max(std::abs(p.x - 3), std::abs(p.y - 3)) > 1) << p.x << ' ' << p.y;
}

TEST(GridLayout, PointsKeepTheirDistance) {
  for (const std::string& shape : {kL, kHole}) {
    const Area area = areaOf(shape, &shape == &kL ? "L" : "carpet");
    for (const double margin : {0., .1, .3}) {
      const Grid grid = layGrid(area, .37, margin);
      const double half = std::min(grid.across.length(), grid.upwards.length()) / 2;
      for (const V2d& p : grid.points) {
        EXPECT_TRUE(area.contains(p));
        EXPECT_GE(area.distanceToEdge(p), (margin + half) * (1 - 1e-3));
      }
    }
  }
}

TEST(GridLayout, RotatedRoomHasARotatedGrid) {
  const double c = std::cos(.5), s = std::sin(.5);
  std::string text = "carpet polygon f 0 0 12";
  for (const V2d& p : {V2d(0, 0), V2d(8, 0), V2d(8, 6), V2d(0, 6)})
    text += " " + std::to_string(p.x * c - p.y * s) + " " + std::to_string(p.x * s + p.y * c) + " 0";
  const Grid grid = layGrid(areaOf(text + "\n", "f"), .5, 0);
  EXPECT_EQ(grid.points.size(), 192u);
  EXPECT_NEAR(std::atan2(grid.across.y, grid.across.x), .5, 1e-5);
}

TEST(GridLayout, RefusesWhatHasNoPointOrTooMany) {
  const Area area = areaOf("carpet polygon f 0 0 12 0 0 0 8 0 0 8 6 0 0 6 0\n", "f");
  EXPECT_THROW(layGrid(area, .5, 3), rad::Error);
  EXPECT_THROW(layGrid(area, .001, 0), rad::Error);
}

// The lines of a linear field are straight, where it is not extrapolated; the grid is a rotated L.
TEST(GridIsolines, LinearFieldHasItsValueOnThem) {
  const Area area =
      areaOf("carpet polygon L 0 0 18 0 0 0 6 1 0 5.6667 3 0 2.6667 2.5 0 2.3333 4.5 0 -.6667 4 0\n", "L");
  const Grid grid = layGrid(area, .3, 0);
  const std::vector<double> values = linear(grid);
  const Field field(grid, values);
  int tested = 0;
  for (const double level : {150., 200., 250., 300.})
    for (const auto& line : field.isolines(level))
      for (const V2d& p : line)
        if (area.distanceToEdge(p) > .6) {
          EXPECT_NEAR(linear(p), level, 1e-9);
          ++tested;
        }
  EXPECT_GT(tested, 40);
}

double areaWithin(const std::vector<std::vector<V2d>>& lines) {
  double sum = 0;
  for (const auto& line : lines)
    for (size_t i = 0; i < line.size(); ++i) {
      const V2d &a = line[i], &b = line[(i + 1) % line.size()];
      sum += (a.x * b.y - a.y * b.x) / 2;
    }
  return sum;
}

TEST(GridIsolines, RegionOfAllValuesIsTheAreaOfItsCells) {
  const Grid grid = layGrid(areaOf(kHole, "holed"), .5, 0);
  const std::vector<double> values = linear(grid);
  const Field field(grid, values);
  EXPECT_NEAR(areaWithin(field.region(0)), 32, 1e-9);
  EXPECT_EQ(field.region(0).size(), 2u);  // the outline and the hole
  EXPECT_TRUE(field.region(1e6).empty());
  EXPECT_TRUE(field.isolines(0).empty());
}

TEST(GridIsolines, ConeHasACircle) {
  const Grid grid = layGrid(areaOf("carpet polygon f 0 0 12 0 0 0 8 0 0 8 8 0 0 8 0\n", "f"), .1, 0);
  std::vector<double> values;
  for (const V2d& p : grid.points) values.push_back(1000 - 100 * (p - V2d(4, 4)).length());
  const Field field(grid, values);
  const auto lines = field.isolines(700);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  for (const V2d& p : lines[0]) EXPECT_NEAR((p - V2d(4, 4)).length(), 3, .001);
  EXPECT_NEAR(areaWithin(field.region(700)), 9 * std::numbers::pi, .02);
}

TEST(GridIsolines, RoundLevels) {
  const double wide[] = {80, 1200}, narrow[] = {410, 590}, equal[] = {5, 5}, dark[] = {0, 40};
  EXPECT_EQ(roundLevels(wide), (std::vector<double>{100, 150, 200, 300, 500, 750, 1000}));
  EXPECT_EQ(roundLevels(narrow), (std::vector<double>{450, 500, 550}));
  EXPECT_TRUE(roundLevels(equal).empty());
  EXPECT_FALSE(roundLevels(dark).empty());
}

// One point of 0 lx among a hundred took six of the eight levels.
TEST(GridIsolines, OnePointOfNothingHasNoLevels) {
  std::vector<double> values;
  for (int i = 0; i < 99; ++i) values.push_back(300 + 3 * i);
  const std::vector<double> levels = roundLevels(values);
  values.push_back(0);
  EXPECT_EQ(roundLevels(values), levels);
  EXPECT_GE(levels.front(), 300);
}

// A shaded corner of 4% of the floor had six lines, one on the other.
TEST(GridIsolines, DarkCornersHaveTwoLevels) {
  std::vector<double> values;
  for (int i = 0; i < 96; ++i) values.push_back(20 + 10 * i);
  for (const double dark : {0., .3, 2., 6.}) values.push_back(dark);
  EXPECT_EQ(roundLevels(values), (std::vector<double>{15, 20, 30, 50, 75, 100, 150, 200, 300, 500, 750}));
}

TEST(GridSummary, ByTheNamesOfTheStandard) {
  const double values[] = {100, 200, 300, 400};
  const Summary summary(values);
  EXPECT_DOUBLE_EQ(summary.average, 250);
  EXPECT_DOUBLE_EQ(summary.overallUniformity(), .4);
  EXPECT_DOUBLE_EQ(summary.diversity(), .25);
}

TEST(GridDrawing, LuxText) {
  EXPECT_EQ(luxText(0), "0");
  EXPECT_EQ(luxText(.5), "0.5");
  EXPECT_EQ(luxText(7.5), "7.5");
  EXPECT_EQ(luxText(99.96), "100");
  EXPECT_EQ(luxText(1250), "1250");
}

TEST(GridDrawing, PictureIsWellFormed) {
  const Area area = areaOf(kHole, "holed");
  const Grid grid = layGrid(area, .5, 0);
  const std::vector<double> values = linear(grid);
  const Drawing drawing{"R&D <\"room\"> \xff", {"a < b"}, {200, 300}, {{{0, 0}, {1, 0}, {1, 1}}}, true};
  const std::string svg = planAsSvg(area, grid, values, drawing);
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(svg.c_str());
  ASSERT_TRUE(result) << result.description();
  const pugi::xml_node root = document.child("svg");
  EXPECT_STREQ(root.child("text").text().get(), "R&D <\"room\"> \xef\xbf\xbd");
  size_t isolines = 0, numbers = 0;
  for (const pugi::xml_node& path : root.children("path"))
    isolines += std::string(path.attribute("class").value()) == "isoline";
  for (const pugi::xml_node& text : root.children("text"))
    numbers += std::string(text.text().get()) == luxText(values[7]);
  EXPECT_EQ(isolines, 2u);
  EXPECT_GE(numbers, 1u);
}

// The legend said "max 49.6" above a band from 90 on.
TEST(GridDrawing, TheLegendEndsWhereValuesDo) {
  const Area area = areaOf("carpet polygon road 0 0 12 0 0 0 8 0 0 8 6 0 0 6 0\n", "road");
  const Grid grid = layGrid(area, 2, 0);
  std::vector<double> values(grid.points.size(), 35);
  values[0] = 14;
  const std::string svg =
      planAsSvg(area, grid, values, Drawing{"", {}, {10, 20, 30, 40, 50}, {{{-3, 0}, {8, 0}, {8, 6}}}, true});
  EXPECT_NE(svg.find(">max 35<"), std::string::npos);
  EXPECT_NE(svg.find(">20</text>"), std::string::npos);
  EXPECT_EQ(svg.find(">40</text>"), std::string::npos);
  EXPECT_EQ(svg.find(">10</text>"), std::string::npos);
  // The axes include outlines beside the area.
  EXPECT_NE(svg.find(">-2</text>"), std::string::npos);
}

// Numbers of 3.5 pixels could not be read.
TEST(GridDrawing, InADenseGridFewerNumbersAreWritten) {
  const Area area = areaOf("carpet polygon road 0 0 12 0 0 0 100 0 0 100 7 0 0 7 0\n", "road");
  const Grid grid = layGrid(area, .8, 0);
  const std::string svg = planAsSvg(area, grid, linear(grid), Drawing{"", {}, {}, {}, true});
  size_t numbers = 0;
  for (size_t at = svg.find("paint-order"); at != std::string::npos; at = svg.find("paint-order", at + 1))
    ++numbers;
  EXPECT_GT(numbers, 20u);
  EXPECT_LT(numbers, grid.points.size() / 9);
  EXPECT_EQ(svg.find("font-size=\"3"), std::string::npos);
}

// It had one tick at the side, and a gap as high as the legend above the remarks.
TEST(GridDrawing, AStreetHasTicksAlongBothSidesAndItsRemarksBelowIt) {
  const Area area = areaOf("carpet polygon road 0 0 12 0 0 0 100 0 0 100 7 0 0 7 0\n", "road");
  const Grid grid = layGrid(area, 2, 0);
  const std::vector<double> levels{200, 500, 1000, 2000, 3000};
  const std::string svg =
      planAsSvg(area, grid, linear(grid), Drawing{"Street", {"remark"}, levels, {}, false});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  size_t besides = 0;
  double below = 0, remark = 0;
  for (const pugi::xml_node& text : document.child("svg").children("text")) {
    const std::string anchor = text.attribute("text-anchor").value();
    besides += anchor == "end";
    if (anchor == "middle" && !text.attribute("font-weight")) below = text.attribute("y").as_double();
    if (std::string(text.text().get()) == "remark") remark = text.attribute("y").as_double();
  }
  EXPECT_GE(besides, 2u);
  EXPECT_GT(remark, below);
  EXPECT_LT(remark, below + 40);
}

}  // namespace
}  // namespace grid
