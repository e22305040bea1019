// Light reflected by mirrors: the image of a source lies where plane mirrors show it (Euclid), and its
// radiance is reduced by their reflectance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/constants.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere::virtual_sources_test {
namespace {

constexpr double kRadius = .01, kRadiance = 1e5;

std::string lamp(const V3d& at) {
  return fmt::format("void light bright 0 0 3 {0} {0} {0}\nbright sphere lamp 0 0 4 {1} {2} {3} {4}\n",
                     kRadiance, at.x, at.y, at.z, kRadius);
}
// A mirror of 40 x 40 at x, that faces the side of `faces` (1 or -1).
std::string mirror(double x, double faces, double reflectance = .9, const char* name = "silver") {
  return fmt::format(
      "void mirror {0} 0 0 3 {1} {1} {1}\n{0} polygon {0}_plane 0 0 12 {2} {3} -20 {2} {4} -20 {2} {4} 20 "
      "{2} "
      "{3} 20\n",
      name, reflectance, x, -20 * faces, 20 * faces);
}

// The irradiance by a small ball on a surface with this normal.
double irradianceBy(const V3d& lamp, const V3d& point, const V3d& normal = V3d(0, 0, 1)) {
  const V3d to = lamp - point;
  return kRadiance * kPi * kRadius * kRadius * std::max(0., to.dot(normal)) / std::pow(to.length(), 3);
}
double irradianceAt(Traced& traced, const V3d& point, const V3d& normal = V3d(0, 0, 1)) {
  return traced.value(point + 1.1e-4 * normal, -normal);
}
RayOptions relaying(int relays) {
  RayOptions o;
  o.directThreshold = 0;
  o.directRelays = relays;
  return o;
}
Traced meters(const std::string& scene, int relays) {
  return Traced(scene, relaying(relays), IrradianceAt::point);
}

const V3d kLamp(1, .3, 2), kPoint(2, -.5, 0);

TEST(VirtualSource, AMirrorShowsASecondLamp) {
  const double direct = irradianceBy(kLamp, kPoint), image = irradianceBy(V3d(-1, .3, 2), kPoint);
  Traced lit = meters(lamp(kLamp) + mirror(0, 1), 1);
  EXPECT_NEAR(irradianceAt(lit, kPoint), direct + .9 * image, 1e-4 * direct);
  Traced without = meters(lamp(kLamp) + mirror(0, 1), 0);
  EXPECT_NEAR(irradianceAt(without, kPoint), direct, 1e-4 * direct);
  Traced fromBehind = meters(lamp(kLamp) + mirror(0, -1), 2);
  EXPECT_NEAR(irradianceAt(fromBehind, kPoint), direct, 1e-4 * direct);
}

// Between mirrors at 0 and 4 the images of x lie at -x and 8 - x, of those at -8 + x and 8 + x, and so on.
TEST(VirtualSource, MirrorsShowImagesOfImages) {
  const std::string scene = lamp(kLamp) + mirror(0, 1, .9) + mirror(4, -1, .7, "other");
  const std::vector<std::vector<double>> images{{-1, 8 - 1}, {-8 + 1, 8 + 1}, {-8 - 1, 16 - 1}};
  const double left[] = {.9, .9 * .7, .9 * .7 * .9}, right[] = {.7, .7 * .9, .7 * .9 * .7};
  double expected = irradianceBy(kLamp, kPoint);
  for (int relays = 1; relays <= 3; ++relays) {
    expected += left[relays - 1] * irradianceBy(V3d(images[relays - 1][0], .3, 2), kPoint) +
                right[relays - 1] * irradianceBy(V3d(images[relays - 1][1], .3, 2), kPoint);
    Traced lit = meters(scene, relays);
    EXPECT_NEAR(irradianceAt(lit, kPoint), expected, 1e-4 * expected) << relays;
    Traced fewer = meters(scene, relays - 1);
    EXPECT_LT(irradianceAt(fewer, kPoint), .999 * expected);
  }
}

// Between parallel mirrors, as many images as it takes are those by eight reflections; of many lamps in a
// room of mirrors fewer, and a warning says so. Never fewer than by rtrace's default.
TEST(VirtualSource, MirrorsShowAsManyImagesAsItTakes) {
  const std::string two = mirror(0, 1, .9) + mirror(4, -1, .9, "other");
  Traced needed = meters(lamp(kLamp) + two, RayOptions::kAllBounces), eight = meters(lamp(kLamp) + two, 8),
         seven = meters(lamp(kLamp) + two, 7);
  EXPECT_EQ(irradianceAt(needed, kPoint), irradianceAt(eight, kPoint));
  EXPECT_GT(irradianceAt(eight, kPoint), irradianceAt(seven, kPoint));
  const std::string four = two +
                           "silver polygon near 0 0 12 0 -20 -20 0 -20 20 4 -20 20 4 -20 -20\n"
                           "silver polygon far 0 0 12 0 20 -20 4 20 -20 4 20 20 0 20 20\n"
                           "silver polygon floor 0 0 12 0 -20 -20 4 -20 -20 4 20 -20 0 20 -20\n"
                           "silver polygon ceiling 0 0 12 0 -20 20 0 20 20 4 20 20 4 -20 20\n";
  const Scene scene = sceneOf(lamp(kLamp) + four);
  std::vector<std::string> said;
  const auto warn = [&](std::string_view warning) { said.emplace_back(warning); };
  const PreparedScene prepared(scene, relaying(RayOptions::kAllBounces), IrradianceAt::point, false, warn);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(said[0].starts_with("light of sources by more than ")) << said[0];
  const size_t images = prepared.lights().all().size() - 1;
  EXPECT_LE(images, 80U);
  EXPECT_GE(images, PreparedScene(scene, relaying(2), IrradianceAt::point).lights().all().size() - 1);
}

// The mirror acts as a window: the image illuminates only places that see it through the mirror.
TEST(VirtualSource, IsSeenThroughTheMirrorAlone) {
  const std::string pane =
      "void mirror silver 0 0 3 1 1 1\nsilver polygon pane 0 0 12 0 -.2 .5 0 .2 .5 0 .2 .9 0 -.2 .9\n";
  for (const std::string& shape : {pane, std::string("void mirror silver 0 0 3 1 1 1\n"
                                                     "silver ring pane 0 0 8 0 0 .7 1 0 0 .1 .3\n")}) {
    Traced lit = meters(lamp(kLamp) + shape, 1);
    const bool ring = shape.find("ring") != std::string::npos;
    Random random(3);
    int inside = 0;
    for (int i = 0; i < 400; ++i) {
      const V3d at(.2 + .9 * random.uniform(), -.6 + random.uniform(), 0);
      const V3d image(-1, .3, 2), toImage = image - at;
      const V3d through = at - at.x / toImage.x * toImage;
      const double radius = std::hypot(through.y, through.z - .7);
      const bool seen =
          ring ? radius > .1 && radius < .3 : std::abs(through.y) < .2 && through.z > .5 && through.z < .9;
      inside += seen;
      const double expected = irradianceBy(kLamp, at) + (seen ? irradianceBy(image, at) : 0);
      EXPECT_NEAR(irradianceAt(lit, at), expected, 2e-4 * expected) << at;
    }
    EXPECT_GT(inside, 20);
    EXPECT_LT(inside, 380);
  }
}

// If a ceiling light extends behind the plane of the mirror, the part in front of it is mirrored. RADIANCE
// 6.1a leaves such images out if the plane of the mirror is not near the origin, because it tests the wrong
// end of the light.
TEST(VirtualSource, OfASourcePartlyBehindTheMirrorIsThatOfTheRest) {
  constexpr double kWall = 4, kHeight = 3;
  const std::string scene = fmt::format(
                                "void light bright 0 0 3 1 1 1\nbright polygon lamp 0 0 12 {0} -1 {2} {0} 1 "
                                "{2} {1} 1 {2} {1} -1 {2}\n",
                                kWall - 1, kWall + 2, kHeight) +
                            mirror(kWall, 1);
  const V3d point(kWall + 1.5, .3, 0);
  // Irradiance on a level surface by the light between two places in x, by quadrature.
  const auto rectangle = [&](double from, double to) {
    constexpr int kSteps = 200;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < kSteps; ++k) {
        const V3d at(from + (to - from) * (i + .5) / kSteps, -1 + 2 * (k + .5) / kSteps, kHeight);
        sum += kHeight * kHeight / std::pow((at - point).length2(), 2);
      }
    return sum * (to - from) * 2 / (kSteps * kSteps);
  };
  RayOptions o = unbiased();
  o.directRelays = 1;
  Traced lit(scene, o, IrradianceAt::point);
  const double expected = rectangle(kWall, kWall + 2) + .9 * rectangle(kWall - 2, kWall);
  expectMean(lit.mean(point + V3d(0, 0, 1.1e-4), V3d(0, 0, -1), 2000), expected, 1.01);
}

TEST(VirtualSource, OfTheSunComesFromTheMirroredDirection) {
  Traced lit =
      meters("void light bright 0 0 3 1e5 1e5 1e5\nbright source sun 0 0 4 3 1 4 .5\n" + mirror(0, 1), 1);
  const double sine = std::sin(.25 * kPi / 180), e = 1e5 * kPi * sine * sine * 4 / std::sqrt(26.);
  EXPECT_NEAR(irradianceAt(lit, V3d(2, 0, 0)), e * 1.9, 1e-4 * e);
  // The height of the mirror limits how far its light reaches.
  EXPECT_NEAR(irradianceAt(lit, V3d(17, 0, 0)), e, 1e-4 * e);
}

// Light that next-event estimation includes via the mirror is black to rays that gather indirect light, and
// to samples of rough reflections.
TEST(VirtualSource, IsNotCountedTwice) {
  RayOptions gathering = unbiased(2);
  gathering.directJitter = 0;
  gathering.ambientDivisions = 4096;
  const std::string scene =
      "void light bright 0 0 3 20 20 20\nbright sphere lamp 0 0 4 1 .3 2 .4\n" + mirror(0, 1);
  const auto by = [](const V3d& ball) {
    const V3d to = ball - kPoint;
    return 20 * kPi * .16 * to.z / std::pow(to.length(), 3);
  };
  Traced lit(scene, gathering, IrradianceAt::point);
  const double expected = by(kLamp) + .9 * by(V3d(-1, .3, 2));
  EXPECT_NEAR(irradianceAt(lit, kPoint), expected, 1e-4 * expected);
}

// An occluder between the lamp and the mirror, and between the mirror and the place.
TEST(VirtualSource, IsHiddenByWhatStandsInTheWay) {
  const double direct = irradianceBy(kLamp, kPoint), image = irradianceBy(V3d(-1, .3, 2), kPoint);
  const V3d onMirror = V3d(0, kPoint.y + 2. / 3 * (.3 - kPoint.y), 2. / 3 * 2);
  const std::string black = "void plastic black 0 0 5 0 0 0 0 0\n";
  for (const V3d& at : {(kPoint + onMirror) * .5, (kLamp + onMirror) * .5}) {
    const std::string ball = fmt::format("sphere ball 0 0 4 {} {} {} .05\n", at.x, at.y, at.z);
    Traced hidden = meters(lamp(kLamp) + mirror(0, 1) + black + "black " + ball, 1);
    EXPECT_NEAR(irradianceAt(hidden, kPoint), direct, 1e-4 * direct) << at;
  }
  // A pane in front of the mirror, which the light passes twice, with a path length of thickness / cosine.
  const V3d way = V3d(-1, .3, 2) - kPoint;
  const double passed = std::pow(.5, 2 * way.length() / std::abs(way.x));
  Traced dimmed = meters(lamp(kLamp) + mirror(0, 1) +
                             "void glass clear 0 0 4 .5 .5 .5 1\n"
                             "clear polygon pane 0 0 9 .9 -19 -19 .9 19 -19 .9 0 19\n",
                         1);
  EXPECT_NEAR(irradianceAt(dimmed, kPoint), direct + .9 * passed * image, 1e-4 * direct);
}

TEST(VirtualSource, MirrorsThatAreNotPlaneAreWarnedOf) {
  const Scene scene =
      sceneOf(lamp(kLamp) + "void mirror silver 0 0 3 1 1 1\nsilver sphere ball 0 0 4 0 0 0 .1\n");
  std::vector<std::string> warnings;
  const rad::Warn warn = [&](std::string_view text) { warnings.emplace_back(text); };
  const Transport none(scene, relaying(0), IrradianceAt::none, false, warn);
  EXPECT_TRUE(warnings.empty());
  const Transport relays(scene, relaying(1), IrradianceAt::none, false, warn);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("sphere \"ball\": only plane surfaces make virtual sources"), std::string::npos)
      << warnings[0];
}

// The number of sources in a scene: virtual sources that cannot illuminate anything are left out.
TEST(VirtualSource, IsLeftOutWhereGeometryShowsItNeverLights) {
  const auto count = [](const std::string& text, int relays) {
    const Scene scene = sceneOf(text);
    const Transport transport(scene, relaying(relays), IrradianceAt::none);
    return transport.prepared().lights().all().size();
  };
  EXPECT_EQ(count(lamp(kLamp) + mirror(0, 1), 1), 2u);
  EXPECT_EQ(count(lamp(kLamp) + mirror(0, 1), 9), 2u);
  EXPECT_EQ(count(lamp(kLamp) + mirror(0, -1), 1), 1u);
  EXPECT_EQ(count(lamp(kLamp) + mirror(0, 1) + mirror(4, -1, 1, "other"), 3), 1 + 2 + 2 + 2u);
  // The second mirror faces away from the first one's light, or lies behind it.
  EXPECT_EQ(count(lamp(kLamp) + mirror(0, 1) + mirror(4, 1, 1, "other"), 3), 2u);
  EXPECT_EQ(count(lamp(kLamp) + mirror(0, 1) + mirror(-2, -1, 1, "other"), 3), 2u);
  // A panel that emits upwards illuminates no mirror below it.
  const std::string panel =
      "void light bright 0 0 3 1 1 1\nbright polygon panel 0 0 12 1 0 2 2 0 2 2 1 2 1 1 2\n";
  const std::string low =
      "void mirror silver 0 0 3 1 1 1\nsilver polygon low 0 0 12 0 -1 0 0 1 0 0 1 1 0 -1 1\n";
  EXPECT_EQ(count(panel + low, 1), 1u);
  EXPECT_EQ(count(panel + mirror(0, 1), 1), 2u);
  // A spotlight that points elsewhere.
  const std::string spot =
      "void spotlight beam 0 0 7 1 1 1 40 1 0 0\nbeam ring spot 0 0 8 1 0 1 1 0 0 0 .05\n";
  EXPECT_EQ(count(spot + low, 1), 1u);
  // Two small mirrors side by side: the second lies outside the beam of the first.
  const std::string small =
      "void mirror silver 0 0 3 1 1 1\n"
      "silver polygon first 0 0 12 0 -.1 0 0 .1 0 0 .1 .2 0 -.1 .2\n"
      "silver polygon second 0 0 12 3 5.1 0 3 4.9 0 3 4.9 .2 3 5.1 .2\n";
  EXPECT_EQ(count(lamp(V3d(1, 0, .1)) + small, 2), 3u);
}

// Mirrors that stand in a ring of radius 1 and face inward.
std::string ringOfMirrors(int count) {
  std::string text = "void mirror silver 0 0 3 .9 .9 .9\n";
  const auto corner = [&](int i, double z) {
    return fmt::format(" {} {} {}", std::cos(2 * kPi * i / count), std::sin(2 * kPi * i / count), z);
  };
  for (int i = 0; i < count; ++i)
    text += fmt::format("silver polygon pane_{} 0 0 12{}{}{}{}\n", i, corner(i, 0), corner(i, .5),
                        corner(i + 1, .5), corner(i + 1, 0));
  return text;
}

// Light is followed from points of a lamp by way of up to four mirrors. Wherever it arrives, there is an
// image in these mirrors, whose beam holds the place.
TEST(VirtualSource, BeamsHoldAllThatTheyLight) {
  const int mirrors = 24;
  for (const char* source : {"bright sphere lamp 0 0 4 .1 .2 .6 .1",
                             "bright polygon lamp 0 0 12 -.2 -.2 .8 "
                             "-.2 .2 .8 .2 .2 .8 .2 -.2 .8",
                             "bright source sun 0 0 4 .3 -.2 1 20"}) {
    const Scene scene =
        sceneOf("void light bright 0 0 3 1 1 1\n" + std::string(source) + "\n" + ringOfMirrors(mirrors));
    const Transport transport(scene, relaying(4), IrradianceAt::none);
    const auto& lights = transport.prepared().lights().all();
    std::map<std::vector<SurfaceId>, LightId> imageIn;  // by the mirrors from the lamp on
    for (const LightId id : lights.ids()) {
      std::vector<SurfaceId> way;
      for (LightId at = id; lights[at].isVirtual(); at = lights[at].relayed)
        way.insert(way.begin(), lights[at].surface);
      imageIn[way] = id;
    }
    const LightSource& lamp = lights[imageIn.at({})];
    Random random(5);
    size_t arrivals = 0;
    for (int i = 0; i < 20000; ++i) {
      const auto signedUniform = [&] { return 2 * random.uniform() - 1; };
      const double around = 2 * kPi * random.uniform();
      V3d at(std::cos(around), std::sin(around), .5 * random.uniform()), way;  // about on a mirror
      const auto* const plane = lamp.as<PlaneLight>();
      if (const auto* cone = lamp.as<DistantLight>()) {
        const auto [x, y] = frame(lamp.center);
        const double off = cone->sinHalfAngle * std::sqrt(random.uniform()),
                     turn = 2 * kPi * random.uniform();
        way = -(std::sqrt(1 - off * off) * lamp.center + off * std::cos(turn) * x + off * std::sin(turn) * y);
        at -= way;
      } else {
        const V3d start =
            plane ? lamp.center + signedUniform() * plane->u + signedUniform() * plane->v
                  : lamp.center + .999 * lamp.radius * std::cbrt(random.uniform()) *
                                      V3d(signedUniform(), signedUniform(), signedUniform()).normalized();
        way = (at - start).normalized();
        at = start;
      }
      std::vector<SurfaceId> mirrorsHit;
      while (mirrorsHit.size() < 4) {
        // The nearest mirror whose front the light meets.
        double nearest = 1e9;
        SurfaceId hit = kNone;
        V3d normal;
        for (const SurfaceId s : scene.outermostIds()) {
          const V3d* n = planeNormal(scene.surfaces[s].shape);
          ShapeHit found;
          if (s == lamp.surface || way.dot(*n) >= 0 ||
              !intersect(scene.surfaces[s].shape, scene.vertices, at + 1e-6 * way, way, nearest, found))
            continue;
          nearest = found.distance;
          hit = s;
          normal = *n;
        }
        if (hit == kNone) break;
        at += (nearest + 1e-6) * way;
        way -= 2 * way.dot(normal) * normal;
        mirrorsHit.push_back(hit);
        ASSERT_TRUE(imageIn.contains(mirrorsHit)) << source << ": an image in a mirror is missing";
        const LightSource& image = lights[imageIn.at(mirrorsHit)];
        for (const double distance : {0., .5, 100.}) {
          if (image.isDistant()) continue;
          const V3d from = at + distance * way - image.center;
          EXPECT_GE(from.dot(image.beam.axis), image.beam.cosine * from.length() - 1e-9) << source;
        }
        ++arrivals;
      }
    }
    EXPECT_GT(arrivals, 9000u) << source;
  }
}

size_t sourcesOf(const std::string& text, int relays) {
  const Scene scene = sceneOf(text);
  return Transport(scene, relaying(relays), IrradianceAt::none).prepared().lights().all().size();
}

// Light is narrowed by the exact corners of every mirror on its way, not by the last alone, nor by the
// spheres around them.
TEST(VirtualSource, ImagesAreAsFewAsAllTheirMirrorsLeave) {
  const auto images = [](const std::string& source, int relays) {
    return sourcesOf("void light bright 0 0 3 1 1 1\n" + source + "\n" + ringOfMirrors(60), relays);
  };
  // By spheres, there would be thousands.
  EXPECT_LT(images("bright polygon lamp 0 0 12 -.3 -.3 2 -.3 .3 2 .3 .3 2 .3 -.3 2", 3), 100u);
  EXPECT_LT(images("bright sphere lamp 0 0 4 .1 .2 .6 .05", 3), 2500u);
  // Light of a wide lamp above the ring soon leaves it below. By spheres, there would be millions of images
  // in five mirrors, of some 400 bytes each.
  EXPECT_LT(images("bright polygon lamp 0 0 12 -1 -1 2 -1 1 2 1 1 2 1 -1 2", 5), 1500u);
  EXPECT_LT(images("bright polygon lamp 0 0 12 -1 -1 2 -1 1 2 1 1 2 1 -1 2", 7), 2000u);
}

// Two facing mirrors make two images with each further mirror.
TEST(VirtualSource, LongChainsOfImagesAreComplete) {
  EXPECT_EQ(sourcesOf(lamp(kLamp) + mirror(0, 1) + mirror(4, -1, 1, "other"), 300), 1 + 2 * 300u);
}

}  // namespace
}  // namespace rsphere::virtual_sources_test
