#include "pictures/point_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/constants.h"
#include "pictures/draw_point.h"
#include "pictures/smooth_light.h"
#include "pictures/tuning.h"
#include "rad_parser/error.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::point_picture_test {
namespace {

// ---- where directions lie

TEST(PixelMap, LatitudesAndLongitudes) {
  const PixelMap map(Projection::latitudeLongitude);
  ASSERT_EQ(map.width(), 1024);
  ASSERT_EQ(map.height(), 512);
  const auto at = [&](double x, double y) { return *map.direction(x, y); };
  EXPECT_LT((at(512, 256) - V3d(0, 1, 0)).length(), 1e-12);
  EXPECT_LT((at(768, 256) - V3d(1, 0, 0)).length(), 1e-12);  // who looks along +y has +x on the right
  EXPECT_LT((at(256, 256) - V3d(-1, 0, 0)).length(), 1e-12);
  EXPECT_LT((at(0, 256) - V3d(0, -1, 0)).length(), 1e-12);
  EXPECT_LT((at(300, 0) - V3d(0, 0, 1)).length(), 1e-12);
  EXPECT_LT((at(300, 512) - V3d(0, 0, -1)).length(), 1e-12);
}

// What vwrays(1) gives for -vta -vh 360 -vv 360 -vd 0 1 0 -vu 0 0 1.
TEST(PixelMap, AngularFisheyeIsRadiancesView) {
  const PixelMap map(Projection::angularFisheye);
  ASSERT_EQ(map.width(), map.height());
  const double w = map.width();
  EXPECT_LT((*map.direction(w / 2, w / 2) - V3d(0, 1, 0)).length(), 1e-12);
  EXPECT_LT((*map.direction(.75 * w, w / 2) - V3d(1, 0, 0)).length(), 1e-12);
  EXPECT_LT((*map.direction(w / 2, .25 * w) - V3d(0, 0, 1)).length(), 1e-12);
  EXPECT_LT((*map.direction(w, w / 2) - V3d(0, -1, 0)).length(), 1e-12);
  EXPECT_LT((*map.direction(.5 * w + .125 * w, w / 2) - V3d(1, 1, 0).normalized()).length(), 1e-12);
  EXPECT_FALSE(map.direction(.1 * w, .1 * w));
  EXPECT_EQ(map.viewLine(V3d(1, -2.5, 1e-3)).find("VIEW= -vta -vp 1 -2.5 0.001 -vd 0 1 0 -vu 0 0 1 -vh 360"),
            0u);
}

TEST(PixelMap, TheHeadingIsInTheMiddle) {
  for (const Projection projection : {Projection::latitudeLongitude, Projection::angularFisheye}) {
    const PixelMap map(projection, {.width = 10, .heading = 30});
    EXPECT_LT((*map.direction(5, map.height() / 2.) - V3d(std::sqrt(3) / 2, .5, 0)).length(), 1e-12);
    EXPECT_LT((*map.direction(7.5, map.height() / 2.) - V3d(.5, -std::sqrt(3) / 2, 0)).length(), 1e-12);
  }
  const PixelMap map(Projection::angularFisheye, {.heading = 30});
  EXPECT_NE(map.viewLine(V3d(0, 0, 0)).find(" -vd 0.866025404 0.5 0 "), std::string::npos);
}

// What vwrays(1) gives for -vtv -vh 90 -vv 73.739795, towards +x.
TEST(PixelMap, PerspectiveIsRadiancesView) {
  const PixelMap map(Projection::perspective, {.width = 80, .viewAngle = 90, .heading = 0});
  ASSERT_EQ(map.width(), 80);
  ASSERT_EQ(map.height(), 60);
  EXPECT_LT((*map.direction(40, 30) - V3d(1, 0, 0)).length(), 1e-12);
  EXPECT_LT((*map.direction(80, 30) - V3d(1, -1, 0).normalized()).length(), 1e-12);
  EXPECT_LT((*map.direction(40, 0) - V3d(1, 0, .75).normalized()).length(), 1e-12);
  EXPECT_LT((*map.direction(0, 60) - V3d(1, 1, -.75).normalized()).length(), 1e-12);
  double sum = 0;
  for (size_t pixel = 0; pixel < map.count(); ++pixel) {
    sum += map.solidAngle(pixel);
    ASSERT_EQ(map.pixelOf(*map.direction(.5 + pixel % 80, .5 + pixel / 80)), pixel);
  }
  // Of a rectangle of 2 x 1.5 at distance 1 before its middle.
  EXPECT_NEAR(sum / (4 * std::asin(std::sin(kPi / 4) * .75 / std::hypot(1, .75))), 1, 1e-3);
  for (const V3d& outside : {V3d(-1, 0, 0), V3d(1, 1.01, 0), V3d(1, 0, -.76), V3d(0, 1, 0)})
    EXPECT_FALSE(map.pixelOf(outside.normalized()));
  EXPECT_EQ(map.viewLine(V3d(1, 2, 3)),
            "VIEW= -vtv -vp 1 2 3 -vd 1 0 0 -vu 0 0 1 -vh 90 -vv 73.739795292 -vo 0 -va 0 -vs 0 -vl 0\n");
}

TEST(PixelMap, PixelsShowTheirDirectionsAndCoverTheSphere) {
  for (const Projection projection : {Projection::latitudeLongitude, Projection::angularFisheye}) {
    const PixelMap map(projection, {.width = 100, .heading = 25});
    double sum = 0;
    for (size_t pixel = 0; pixel < map.count(); ++pixel) {
      sum += map.solidAngle(pixel);
      const auto direction = map.direction(.5 + pixel % 100, .5 + pixel / 100);
      EXPECT_EQ(direction.has_value(), map.solidAngle(pixel) > 0);
      if (direction) {
        EXPECT_NEAR(direction->length(), 1, 1e-12);
        ASSERT_EQ(map.pixelOf(*direction), pixel);
      }
    }
    EXPECT_NEAR(sum / (4 * kPi), 1, projection == Projection::angularFisheye ? 1e-3 : 1e-12);
  }
}

// ---- what arrives

RayOptions picturesWith(int bounces) {
  RayOptions ray = pictureDefaults();
  ray.ambientBounces = bounces;
  return ray;
}

struct Drawn : SphereSetting {
  Transport pictures;
  SeenSources sources;
  PixelMap map;
  Raster raster;
  double mean = 0;  // by the estimator, brightness
  Drawn(const std::string& text, const V3d& point, int bounces, Projection projection, int width,
        uint64_t seed = 1)
      : SphereSetting(sceneOf(text), [&](RayOptions& o) { o.ambientBounces = bounces; }),
        pictures(*transport, picturesWith(bounces)),
        sources(pictures.prepared()),
        map(projection, {.width = width, .viewAngle = 80}) {
    SphereOptions o = options.sphere;
    o.baseDirections = 4096;
    o.mostDirections = 8192;
    o.rotation = seed;
    const SphereEstimator estimator(*transport, o);
    SphereEstimator::Workspace workspace(estimator);
    mean = brightness(estimator.estimate(point, workspace).mean);
    raster = again(point, seed);
  }
  Raster again(const V3d& point, uint64_t seed, const DrawingProgress& progress = {}) const {
    return drawPoint(point, map, pictures, sources, seed, false, 0, progress);
  }
  double at(size_t pixel) const { return raster.pixels[3 * pixel + 1]; }
  double towards(const V3d& direction) const { return at(*map.pixelOf(direction.normalized())); }
  double integral() const {
    double sum = 0;
    for (size_t pixel = 0; pixel < map.count(); ++pixel) sum += at(pixel) * map.solidAngle(pixel);
    return sum;
  }
};

std::string room(const std::string& more) {
  return "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 40 40 40\n"
         "void glow window 0 0 4 30 30 30 0\n"
         "wall bubble room 0 0 4 0 0 0 3\n" +
         more;
}

// In sphere mode few indirect rays from each direction find the window: most pixels used to be black, and the
// lamp was full of holes.
TEST(PointPicture, WallsAndLuminairesAreAsBrightAsTheyAre) {
  const std::string text =
      room("lamp ring l 0 0 8 0 0 2 0 0 -1 0 .6\nwindow ring w 0 0 8 2.8 0 0 -1 0 0 0 .6\n");
  for (const Projection projection : {Projection::latitudeLongitude, Projection::angularFisheye}) {
    const V3d point(.2, -.3, .1);
    // Indirect light from the window is noisy: by 1% in a picture, and as much in a mean.
    Sample ratio;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      const Drawn another(text, point, 2, projection, 120, seed);
      ratio.add(another.integral() / (4 * kPi * another.mean));
    }
    EXPECT_NEAR(ratio.mean(), 1, .02) << "+- " << ratio.standardError();
    const Drawn drawn(text, point, 2, projection, 120);
    double least = 1e9;
    size_t lamp = 0, window = 0, edge = 0, other = 0;
    for (size_t pixel = 0; pixel < drawn.map.count(); ++pixel) {
      if (!(drawn.map.solidAngle(pixel) > 0)) continue;
      const double value = drawn.at(pixel);
      least = std::min(least, value);
      if (value == 40) {
        ++lamp;
      } else if (value == 30) {
        ++window;
      } else if (value > 12) {
        ++edge;
        EXPECT_LT(value, 40);
      } else {
        ++other;
      }
    }
    EXPECT_GT(lamp, 70u);
    EXPECT_GT(window, 35u);
    EXPECT_LT(edge, lamp + window);
    EXPECT_GT(other, 8 * (lamp + window));
    EXPECT_GT(least, .1) << "walls are black";
    EXPECT_EQ(drawn.towards(V3d(-.2, .3, 1.9)), 40);
    EXPECT_EQ(drawn.towards(V3d(2.6, .3, -.1)), 30);
    PathTracer tracer = drawn.transport->pathTracer();
    int black = 0;
    for (uint64_t seed = 0; seed < 100; ++seed)
      black += tracer.trace(V3d(.2, -.3, .1), V3d(-.6, 0, .8), 0, seed).value.color.y < .1 ? 1 : 0;
    EXPECT_GT(black, 0) << "single rays would pass";
  }
}

// A lamp of a hundredth of a pixel: no ray through a pixel's middle would meet it.
TEST(PointPicture, SmallSourcesAreNeitherLostNorPaintedTooLarge) {
  for (const double radius : {.001, .01, .05}) {
    const std::string lamp =
        fmt::format("void light lamp 0 0 3 1e4 1e4 1e4\nlamp sphere l 0 0 4 1 2 .5 {}\n", radius);
    const double exact = 1e4 * kPi * radius * radius / V3d(1, 2, .5).length2();
    for (const Projection projection :
         {Projection::latitudeLongitude, Projection::angularFisheye, Projection::perspective}) {
      const int width = projection == Projection::perspective ? 32 : 128;  // pixels of equal size
      const Drawn drawn(lamp, V3d(0, 0, 0), 0, projection, width);
      EXPECT_NEAR(drawn.integral() / exact, 1, .01) << radius;
      const double there = drawn.map.solidAngle(*drawn.map.pixelOf(V3d(1, 2, .5).normalized()));
      EXPECT_NEAR(drawn.towards(V3d(1, 2, .5)) / std::min(1e4, exact / there), 1, .3) << radius;
    }
    const Drawn hidden(lamp + "void plastic black 0 0 5 0 0 0 0 0\nblack ring r 0 0 8 .5 1 .25 1 2 .5 0 .3\n",
                       V3d(0, 0, 0), 0, Projection::latitudeLongitude, 128);
    EXPECT_EQ(hidden.integral(), 0);
    const std::string behind =
        fmt::format("void light lamp 0 0 3 1e4 1e4 1e4\nlamp sphere l 0 0 4 1 -2 .5 {}\n", radius);
    EXPECT_EQ(Drawn(behind, V3d(0, 0, 0), 0, Projection::perspective, 32).integral(), 0);
  }
}

// The total light of a lamp of six pixels, and that of a minute one, half of which is hidden.
TEST(PointPicture, SmallSourcesHaveTheirLightWithLittleNoise) {
  const double radius = .15;
  const std::string lamp =
      fmt::format("void light lamp 0 0 3 1e4 1e4 1e4\nlamp sphere l 0 0 4 1 2 .5 {}\n", radius);
  Sample whole, half;
  for (int k = 0; k < 12; ++k) {
    const V3d point(.01 * k, .007 * k, -.009 * k);
    const double sine = radius / (V3d(1, 2, .5) - point).length();
    const double exact = 1e4 * 2 * kPi * (1 - std::sqrt(1 - sine * sine));
    whole.add(Drawn(lamp, point, 0, Projection::angularFisheye, 128).integral() / exact);
  }
  EXPECT_NEAR(whole.mean(), 1, .03) << "a quarter of the samples: .95";
  EXPECT_LT(std::sqrt(whole.variance()), .03);
  const std::string hidden =
      "void plastic black 0 0 5 0 0 0 0 0\nvoid light lamp 0 0 3 1e6 1e6 1e6\n"
      "lamp sphere l 0 0 4 0 2 0 .002\nblack polygon o 0 0 12 0 1 -9 9 1 -9 9 1 9 0 1 9\n";
  Drawn drawn(hidden, V3d(0, 0, 0), 0, Projection::angularFisheye, 32);
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    drawn.raster = drawn.again(V3d(0, 0, 0), seed);
    half.add(drawn.integral());
  }
  EXPECT_LT(std::sqrt(half.variance()) / half.mean(), .2) << "one sample: over .3";
}

TEST(PointPicture, DoesNotDependOnThePicturesBefore) {
  const std::string text = room("lamp ring l 0 0 8 0 0 2 0 0 -1 0 .1\n");
  const Drawn drawn(text, V3d(.2, -.3, .1), 2, Projection::latitudeLongitude, 64);
  const SphereEstimator estimator(*drawn.transport, drawn.options.sphere);
  SphereEstimator::Workspace workspace(estimator);
  for (const V3d& point : {V3d(1, 1, 1), V3d(.2, -.3, .1)}) {
    estimator.estimate(point, workspace);
    EXPECT_EQ(drawn.again(point, 1).pixels == drawn.raster.pixels, point.x == .2);
  }
}

TEST(PointPicture, CanBeGivenUp) {
  const Drawn drawn(room(""), V3d(0, 0, 0), 0, Projection::latitudeLongitude, 16);
  int rows = 0;
  const auto stop = [&](double) {
    if (++rows == 3) throw rad::Error("Terminate", rad::Status::signal);
  };
  EXPECT_THROW(drawn.again(V3d(0, 0, 0), 1, stop), rad::Error);
  EXPECT_EQ(rows, 3);
}

// Rays that find a bright window by chance made one pixel in a hundred white.
TEST(PointPicture, GlossyDesksHaveNoSpeckles) {
  const std::string text =
      "void plastic beech 0 0 5 .5 .4 .28 .02 .1\nvoid plastic wall 0 0 5 .5 .5 .5 0 0\n"
      "void glow sky 0 0 4 2000 2000 2000 0\nwall bubble room 0 0 4 0 0 0 3\n"
      "sky polygon window 0 0 12 2.5 -.4 .5 2.5 -.4 1 2.5 .4 1 2.5 .4 .5\n"
      "beech polygon desk 0 0 12 -2 -2 -1 2 -2 -1 2 2 -1 -2 2 -1\n";
  const Drawn drawn(text, V3d(0, 0, 0), 1, Projection::latitudeLongitude, 256);
  double roughest = 0;
  for (int row = 96; row < 120; ++row)
    for (int column = 0; column < 255; ++column) {
      const size_t pixel = static_cast<size_t>(256 * row + column);
      roughest = std::max(roughest, std::abs(drawn.at(pixel) / drawn.at(pixel + 1) - 1));
    }
  EXPECT_LT(roughest, .2);
}

// The rms of what pixels differ by from the mean of their neighbors, as a share of the mean of all.
double grainOf(const std::function<double(int column, int row)>& at, int firstRow, int lastRow,
               int firstColumn = 1, int lastColumn = 255) {
  double squares = 0, sum = 0, count = 0;
  for (int row = firstRow; row < lastRow; ++row)
    for (int column = firstColumn; column < lastColumn; ++column) {
      const double around =
          (at(column - 1, row) + at(column + 1, row) + at(column, row - 1) + at(column, row + 1)) / 4;
      squares += (at(column, row) - around) * (at(column, row) - around);
      sum += around;
      ++count;
    }
  return std::sqrt(squares / count) / (sum / count);
}

// From pixel to pixel, the normals of a small ball differ by more than two degrees, and none shared gloss.
TEST(PointPicture, SmallRoughBallsHaveNoGrain) {
  const Drawn drawn(room("window ring w 0 0 8 0 0 2 0 0 -1 0 1.5\nvoid metal bronze 0 0 5 .6 .6 .6 1 .12\n"
                         "bronze sphere vase 0 0 4 .8 0 0 .25\n"),
                    V3d(0, 0, 0), 1, Projection::latitudeLongitude, 512);
  const auto at = [&](int column, int row) { return drawn.at(static_cast<size_t>(512 * row + column)); };
  // The ball covers 52 pixels around the middle of the right half. Without sharing: .26.
  EXPECT_LT(grainOf(at, 118, 138, 374, 394), .08);
}

// Behind glass no pixel shared the indirect light of the wall with its neighbors. The glass reflects nothing.
TEST(PointPicture, WallsBehindGlassHaveNoGrain) {
  const Drawn drawn(room("window ring w 0 0 8 2.8 0 0 -1 0 0 0 .6\nvoid glass pane 0 0 4 .9 .9 .9 1\n"
                         "pane bubble case 0 0 4 0 0 0 1\n"),
                    V3d(.2, -.3, .1), 1, Projection::latitudeLongitude, 256);
  const auto at = [&](int column, int row) { return drawn.at(static_cast<size_t>(256 * row + column)); };
  EXPECT_LT(grainOf(at, 10, 45), .02);
}

// The wall that a pane or a mirror shows was gathered with few rays at each pixel, and not shared.
TEST(PointPicture, ImagesInPanesAndMirrorsHaveNoGrain) {
  for (const char* const mirror :
       {"void glass pane 0 0 3 .9 .9 .9\n", "void metal pane 0 0 5 .6 .6 .6 1 0\n"}) {
    const Drawn drawn(room(std::string("window ring w 0 0 8 -2.5 0 0 1 0 0 0 1.2\n") + mirror +
                           "pane polygon p 0 0 12 1 -2 -2 1 2 -2 1 2 2 1 -2 2\n"),
                      V3d(.2, -.3, .1), 1, Projection::latitudeLongitude, 256);
    PathTracer rays = drawn.pictures.pathTracer({FirstBounce::gathered});
    const auto at = [&](int column, int row) { return drawn.at(static_cast<size_t>(256 * row + column)); };
    const auto ofRays = [&](int column, int row) {
      const auto direction = drawn.map.direction(column + .5, row + .5);
      const auto seed = mixBits(static_cast<uint64_t>(256 * row + column));
      return rays.trace(V3d(.2, -.3, .1), *direction, 0, seed).value.color.y;
    };
    // Above the window's image.
    EXPECT_LT(grainOf(at, 30, 44, 176, 208), .01) << mirror;
    EXPECT_GT(grainOf(ofRays, 30, 44, 176, 208), .03) << "single rays would pass";
    double drawnSum = 0, raySum = 0;
    for (int row = 30; row < 44; ++row)
      for (int column = 176; column < 208; ++column) {
        drawnSum += at(column, row);
        raySum += ofRays(column, row);
      }
    EXPECT_NEAR(drawnSum / raySum, 1, .03) << mirror;
  }
}

// Shadow rays to random places of a lamp made every wall and every soft shadow grainy.
TEST(PointPicture, SoftShadowsHaveNoGrain) {
  std::string text =
      "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid light lamp 0 0 3 20 20 20\n"
      "wall polygon floor 0 0 12 -4 -4 -1 4 -4 -1 4 4 -1 -4 4 -1\n"
      "wall polygon board 0 0 12 -.5 -.5 .2 .5 -.5 .2 .5 .5 .2 -.5 .5 .2\n";
  for (int x = -3; x <= 3; x += 2)
    for (int y = -2; y <= 2; y += 2)
      text += fmt::format("lamp polygon lamp{0}{1} 0 0 12 {2} {3} 2 {2} {4} 2 {5} {4} 2 {5} {3} 2\n", x, y,
                          x - .6, y - .2, y + .2, x + .6);
  const Drawn drawn(text, V3d(0, 0, 0), 0, Projection::latitudeLongitude, 256);
  const auto pixel = [&](int column, int row) { return static_cast<size_t>(256 * row + column); };
  EXPECT_LT(grainOf([&](int column, int row) { return drawn.at(pixel(column, row)); }, 76, 124), .01);
  PathTracer rays = drawn.pictures.pathTracer({FirstBounce::gathered});
  const auto ofRays = [&](int column, int row) {
    const auto direction = drawn.map.direction(column + .5, row + .5);
    return rays.trace(V3d(0, 0, 0), *direction, 0, mixBits(pixel(column, row))).value.color.y;
  };
  EXPECT_GT(grainOf(ofRays, 76, 124), .03) << "single rays would pass";
}

// The dark edge of a wide penumbra had teeth: smoothing took the noise of few shadow rays for an edge.
TEST(PointPicture, SoftShadowsHaveNoTeeth) {
  const std::string text =
      "void plastic floor 0 0 5 .25 .25 .25 0 0\nvoid light lamp 0 0 3 20 20 20\n"
      "void light faint 0 0 3 .2 .2 .2\nfaint polygon sky 0 0 12 -9 -9 9 -9 9 9 9 9 9 9 -9 9\n"
      "floor polygon ground 0 0 12 -4 -4 -1.2 4 -4 -1.2 4 4 -1.2 -4 4 -1.2\n"
      "floor polygon desk 0 0 12 -.8 .4 -.5 .8 .4 -.5 .8 1.2 -.5 -.8 1.2 -.5\n"
      "lamp polygon lamp1 0 0 12 -1.2 -.2 1.4 -1.2 .4 1.4 -.6 .4 1.4 -.6 -.2 1.4\n"
      "lamp polygon lamp2 0 0 12 .6 -.2 1.4 .6 .4 1.4 1.2 .4 1.4 1.2 -.2 1.4\n";
  const Drawn drawn(text, V3d(0, 0, 0), 0, Projection::latitudeLongitude, 256);
  const Raster other = drawn.again(V3d(0, 0, 0), 2);
  double squares = 0, sum = 0;
  constexpr size_t kRows = 22, kColumns = 90;
  for (size_t row = 95; row < 95 + kRows; ++row)
    for (size_t pixel = 256 * row + 83; pixel < 256 * row + 83 + kColumns; ++pixel) {
      const double apart = drawn.at(pixel) - other.pixels[3 * pixel + 1];
      squares += apart * apart;
      sum += drawn.at(pixel);
    }
  constexpr double kPixels = kRows * kColumns;
  EXPECT_LT(std::sqrt(squares / 2 / kPixels) / (sum / kPixels), .025) << "without repeated shadow rays: .027";
}

// Averages over neighbors do not blur the edge of what the sun shines on.
TEST(PointPicture, SharpShadowsStaySharp) {
  const std::string text =
      "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid light sun 0 0 3 1e6 1e6 1e6\n"
      "sun source s 0 0 4 0 0 1 .5\n"
      "void glow dim 0 0 4 1 1 1 0\ndim source sky 0 0 4 0 0 1 360\n"
      "wall polygon floor 0 0 12 -40 -40 -1 40 -40 -1 40 40 -1 -40 40 -1\n"
      "wall polygon roof 0 0 12 -40 -40 1 -40 40 1 0 40 1 0 -40 1\n";
  const V3d point(0, 0, 0);
  const Drawn drawn(text, point, 1, Projection::latitudeLongitude, 256);
  double sunlit = 0, shaded = 1e9, between = 0;
  for (int column = 0; column < 256; ++column) {
    const double value = drawn.at(static_cast<size_t>(256 * 100 + column));
    sunlit = std::max(sunlit, value);
    shaded = std::min(shaded, value);
  }
  for (int column = 0; column < 256; ++column) {
    const double value = drawn.at(static_cast<size_t>(256 * 100 + column));
    between += value > 3 * shaded && value < .7 * sunlit ? 1 : 0;
  }
  EXPECT_GT(sunlit, 10 * shaded);
  EXPECT_LE(between, 4);
}

// The edge of a luminaire that is a thousand times as bright as the screen can show is as even as any other.
TEST(PointPicture, EdgesOfLuminairesAreEvenOnAScreen) {
  const Drawn drawn(room("void light bright 0 0 3 1e5 1e5 1e5\nbright ring l 0 0 8 .3 .2 2 0 0 -1 0 1\n"),
                    V3d(.2, -.3, .1), 1, Projection::latitudeLongitude, 128);
  const Raster screen = drawPoint(V3d(.2, -.3, .1), drawn.map, drawn.pictures, drawn.sources, 1, true);
  size_t between = 0, white = 0;
  for (size_t pixel = 0; pixel < drawn.map.count(); ++pixel) {
    const double value = screen.pixels[3 * pixel + 1];
    EXPECT_LE(value, 1);
    white += value == 1 ? 1 : 0;
    between += value > .65 && value < .98 ? 1 : 0;
  }
  EXPECT_GT(white, 100u);
  EXPECT_GT(between, 40u);
}

TEST(PointPicture, ReportsHowMuchIsDone) {
  const Drawn drawn(room(""), V3d(0, 0, 0), 0, Projection::latitudeLongitude, 16);
  std::vector<double> reports;
  drawn.again(V3d(0, 0, 0), 1, [&](double done) { reports.push_back(done); });
  EXPECT_EQ(reports.size(), 16u) << "two for each row";
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_EQ(reports.front(), 0);
  EXPECT_LT(reports.back(), 1);
}

// ---- averages of light

constexpr Smoothing kThreePasses{3, 0, 0, .875f, tuning::Pictures::kNear};

struct Plane {
  SeenSurfaces seen{64, 64, false, {}};
  PixelLight light;
  float at(size_t pixel) const { return light.light[pixel].x; }
};

// A plane of 64 by 64 pixels before the eye, with light that is noise of mean 1.
Plane plane(uint64_t seed) {
  Random random(seed);
  Plane picture;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      picture.light.light.emplace_back(random.uniform() < .1 ? 10.f : 0.f);
      picture.light.known.push_back(1);
      picture.seen.pixels.push_back(
          {ModifierId(0), Imath::V3f(.01f * (x - 32), 1, .01f * (y - 32)), Imath::V3f(0, -1, 0), 1});
    }
  return picture;
}

TEST(SmoothLight, ASixteenthOfTheNoiseIsLeft) {
  Plane picture = plane(1);
  smoothLight(picture.seen, kThreePasses, picture.light);
  Sample sample;
  for (size_t y = 15; y < 49; ++y)
    for (size_t x = 15; x < 49; ++x) sample.add(picture.at(64 * y + x));
  EXPECT_NEAR(sample.mean(), 1, .15);
  EXPECT_LT(std::sqrt(sample.variance()), 3 / 14.);
}

TEST(SmoothLight, EdgesAreNotCrossed) {
  const auto step = [](auto&& other) {
    Plane picture = plane(1);
    for (size_t i = 0; i < 64 * 64; ++i) {
      picture.light.light[i] = Imath::V3f(i % 64 < 32 ? 1.f : 0.f);
      if (i % 64 >= 32) other(picture.seen.pixels[i]);
    }
    smoothLight(picture.seen, kThreePasses, picture.light);
    double blurred = 0;
    for (size_t i = 0; i < 64 * 64; ++i) blurred += std::abs(picture.at(i) - (i % 64 < 32 ? 1.f : 0.f));
    return blurred / 64;
  };
  EXPECT_GT(step([](auto&) {}), 2) << "the same surface";
  EXPECT_LT(step([](auto& pixel) { pixel.material = ModifierId(1); }), 1e-5);
  EXPECT_LT(step([](auto& pixel) { pixel.material = kNone; }), 1e-5);
  EXPECT_LT(step([](auto& pixel) { pixel.normal = Imath::V3f(1, 0, 0); }), 1e-5);
  EXPECT_LT(step([](auto& pixel) { pixel.point *= 2; }), 1e-5) << "a parallel plane farther away";
}

TEST(SmoothLight, CarefulPassesBlurSmallDifferencesAlone) {
  const auto blurredBy = [](float difference) {
    Plane picture = plane(1);
    for (size_t i = 0; i < 64 * 64; ++i)
      picture.light.light[i] = Imath::V3f(i % 64 < 32 ? 1.f : 1 - difference);
    Smoothing careful = kThreePasses;
    careful.passes = 0;
    careful.careful = 3;
    careful.sameLight = .1f;
    smoothLight(picture.seen, careful, picture.light);
    return (1 - picture.at(64 * 32 + 31)) / difference;
  };
  EXPECT_GT(blurredBy(.02f), .3);
  EXPECT_LT(blurredBy(.5f), .01);
}

TEST(SmoothLight, PixelsWithoutLightHaveThatOfTheirNeighbors) {
  Plane picture = plane(1);
  for (size_t i = 0; i < 64 * 64; ++i) {
    picture.light.light[i] = Imath::V3f(2);
    picture.light.known[i] = i % 4 == 1 ? 1 : 0;
  }
  picture.seen.pixels[64 * 20 + 20].material = ModifierId(1);  // no other pixel shows its surface
  smoothLight(picture.seen, kThreePasses, picture.light);
  for (const size_t i : {64 * 10 + 10, 64 * 30 + 33}) {
    EXPECT_NEAR(picture.at(i), 2, 1e-5);
    EXPECT_NEAR(picture.light.known[i], .25, .1);
  }
  EXPECT_EQ(picture.light.known[64 * 20 + 20], 0);
}

TEST(SmoothLight, ColumnsWrapWhereTheyAreToldTo) {
  for (const bool wraps : {false, true}) {
    Plane picture = plane(1);
    picture.seen.wraps = wraps;
    for (size_t i = 0; i < 64 * 64; ++i) {
      picture.light.light[i] = Imath::V3f(i % 64 == 63 ? 1.f : 0.f);
      picture.seen.pixels[i].point = Imath::V3f(0, 1, 0);
    }
    smoothLight(picture.seen, kThreePasses, picture.light);
    EXPECT_EQ(picture.at(64 * 30) > .01f, wraps);
  }
}

// ---- exposure and names

TEST(ToneCurve, ShowsWhatLiesBehindBlindsAndCanBeInverted) {
  const PixelMap map(Projection::latitudeLongitude, {.width = 64});
  Raster raster{64, 32, {}};
  // A room of 1, a sky of 30 behind slats of 8: a linear exposure, .214 for the room, would cut off both.
  for (size_t pixel = 0; pixel < map.count(); ++pixel)
    raster.pixels.insert(raster.pixels.end(), 3, pixel % 64 < 60 ? 1 : pixel % 2 ? 30 : 8);
  for (const double white : {0., 2.}) {
    const ToneCurve curve(raster, map, white);
    const double contrast = curve.shown(V3d(30)).y - curve.shown(V3d(8)).y;
    if (white > 0)
      EXPECT_EQ(contrast, 0);
    else
      EXPECT_GT(contrast, .2);
    for (const double value : {.01, 1., 2.}) {
      const V3d color(value, .5 * value, .2 * value);
      EXPECT_LT((curve.radiance(curve.shown(color)) - color).length(), 1e-9 * value);
    }
  }
}

TEST(PointPicture, TheMedianOfWhatIsNotBlackIsMidBright) {
  const PixelMap map(Projection::latitudeLongitude, {.width = 64});
  Raster raster{64, 32, {}};
  // A fifth is black, two fifths are 1, a fifth 2; the rest has a million, which a mean would follow.
  for (size_t pixel = 0; pixel < map.count(); ++pixel) {
    const size_t k = pixel % 64 / 13;
    const float value = k == 0 ? 0 : k <= 2 ? 1 : k == 3 ? 2 : 1e6f;
    raster.pixels.insert(raster.pixels.end(), 3, value);
  }
  Raster linear = raster;
  toScreen(raster, ToneCurve(raster, map, 0));
  toScreen(linear, ToneCurve(linear, map, 4));
  const auto at = [&](size_t column) { return raster.pixels[3 * (64 * 16 + column)]; };
  // By the photographic operator, with .2723 / 1.2723 = .2140, which is .5 in sRGB.
  const auto screen = [](double x) { return 1.055 * std::pow(x, 1 / 2.4) - .055; };
  EXPECT_EQ(at(0), 0);
  EXPECT_NEAR(at(20), .5, 1e-3);
  EXPECT_NEAR(at(45), screen(2 * .2723 / (1 + 2 * .2723)), 1e-3);
  EXPECT_EQ(at(60), 1);
  // With a given white, in proportion.
  EXPECT_NEAR(linear.pixels[3 * (64 * 16 + 45)], screen(.5), 1e-3);
  Raster black{8, 4, std::vector<float>(96)};
  toScreen(black, ToneCurve(black, PixelMap(Projection::latitudeLongitude, {.width = 8}), 0));
  for (const float p : black.pixels) EXPECT_EQ(p, 0);
}

TEST(PointPicture, NamesCarryTheRecordNumber) {
  EXPECT_EQ(pictureName("a%d.png", 0), "a0.png");
  EXPECT_EQ(pictureName("a%04d.png", 12), "a0012.png");
  EXPECT_EQ(pictureName("a%4d.png", 12), "a  12.png");
  EXPECT_EQ(pictureName("a%2d.png", 1234), "a1234.png");
  EXPECT_EQ(pictureName("100%%/a%d", 5), "100%/a5");
  EXPECT_EQ(pictureName("a%d", 18446744073709551615u), "a18446744073709551615");
  EXPECT_EQ(pictureName("plain.hdr", 0), "plain.hdr");
}

TEST(PointPicture, WrongNamesAreErrors) {
  for (const char* pattern : {"a%s.png", "a%d%d.png", "a%", "a%5", "a%-4d.png", "a%n", "a%99999999999999d"})
    EXPECT_THROW(pictureName(pattern, 1), rad::Error) << pattern;
  EXPECT_THROW(pictureName("plain.hdr", 1), rad::Error);
}

}  // namespace
}  // namespace rsphere::point_picture_test
