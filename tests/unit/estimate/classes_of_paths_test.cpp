// Classes of light paths, each in a short scene: whatever light meets on its way, every method finds all of
// it, and nothing twice. The reference is the mean over paths from the eye that aim at nothing but light
// sources (-Sw h -aa 0). Its spoiled twin lacks a class: what the light meets is missing, black or darker, or
// there is one bounce less.
//
// By default, each scene has one of the numbers of bounces from 0 to 4. With the environment variable
// RSPHERE_WAYS=N there are all of them, and N times as many samples: RSPHERE_WAYS=20 takes an hour.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>

#include "contrib/tracked.h"
#include "sphere/directions.h"
#include "tests/unit/support/scene_of.h"
#include "tests/unit/support/sphere_setting.h"
#include "tests/unit/support/statistics.h"

namespace rsphere::classes_of_paths_test {
namespace {

std::string box(const char* modifier, const V3d& a, const V3d& b) {
  return fmt::format(
      "{0} polygon low 0 0 12 {1} {2} {3} {1} {5} {3} {4} {5} {3} {4} {2} {3}\n"
      "{0} polygon high 0 0 12 {1} {2} {6} {4} {2} {6} {4} {5} {6} {1} {5} {6}\n"
      "{0} polygon south 0 0 12 {1} {2} {3} {4} {2} {3} {4} {2} {6} {1} {2} {6}\n"
      "{0} polygon north 0 0 12 {1} {5} {3} {1} {5} {6} {4} {5} {6} {4} {5} {3}\n"
      "{0} polygon west 0 0 12 {1} {2} {3} {1} {2} {6} {1} {5} {6} {1} {5} {3}\n"
      "{0} polygon east 0 0 12 {4} {2} {3} {4} {5} {3} {4} {5} {6} {4} {2} {6}\n",
      modifier, a.x, a.y, a.z, b.x, b.y, b.z);
}

// A room from the origin to 3 3 2.5 without its south wall.
const char* const kRoom =
    "void plastic white 0 0 5 .75 .7 .65 0 0\nvoid plastic soil 0 0 5 .4 .4 .3 0 0\n"
    "void plastic black 0 0 5 0 0 0 0 0\n"
    "white polygon floor 0 0 12 0 0 0 3 0 0 3 3 0 0 3 0\n"
    "white polygon ceiling 0 0 12 0 0 2.5 0 3 2.5 3 3 2.5 3 0 2.5\n"
    "white polygon west 0 0 12 0 0 0 0 3 0 0 3 2.5 0 0 2.5\n"
    "white polygon east 0 0 12 3 0 0 3 0 2.5 3 3 2.5 3 3 0\n"
    "white polygon north 0 0 12 0 3 0 3 3 0 3 3 2.5 0 3 2.5\n"
    "soil polygon ground 0 0 12 -20 -30 -.05 20 -30 -.05 20 20 -.05 -20 20 -.05\n";
std::string wall(double y, double x0, double x1, double z0, double z1) {
  return fmt::format(
      "white polygon wall 0 0 30 0 {0} 0 3 {0} 0 3 {0} 2.5 0 {0} 2.5 0 {0} 0 "
      "{1} {0} {3} {1} {0} {4} {2} {0} {4} {2} {0} {3} {1} {0} {3}\n",
      y, x0, x1, z0, z1);
}
// Before the room, from y = -1.5.
std::string lobby(double x0, double x1, double z0, double z1) {
  return wall(-1.5, x0, x1, z0, z1) +
         "white polygon below 0 0 12 0 -1.5 0 3 -1.5 0 3 0 0 0 0 0\n"
         "white polygon above 0 0 12 0 -1.5 2.5 0 0 2.5 3 0 2.5 3 -1.5 2.5\n"
         "white polygon left 0 0 12 0 -1.5 0 0 0 0 0 0 2.5 0 -1.5 2.5\n"
         "white polygon right 0 0 12 3 -1.5 0 3 -1.5 2.5 3 0 2.5 3 0 0\n";
}
const std::string kHole = wall(0, .5, 2.5, .8, 2.2);
const std::string kInWindow = " polygon pane 0 0 12 .5 0 .8 2.5 0 .8 2.5 0 2.2 .5 0 2.2\n";
const std::string kOnWall = " polygon panel 0 0 12 2.95 .5 .3 2.95 .5 2.3 2.95 2.7 2.3 2.95 2.7 .3\n";
const std::string kPane = "void glass clear 0 0 3 .9 .92 .9\nclear" + kInWindow;
std::string slats() {
  std::string text;
  for (int i = 0; i < 7; ++i)
    text += fmt::format("white polygon slat 0 0 12 .5 .04 {0} 2.5 .04 {0} 2.5 .18 {1} .5 .18 {1}\n",
                        .85 + .2 * i, .95 + .2 * i);
  return text;
}

struct Meets {
  const char* name;
  std::string surfaces;
  std::string spoiled = {};  // empty: a bounce less
};
const std::vector<Meets> kMeets{
    {"OpenHole", kHole},
    {"Pane", kHole + kPane, kHole + "void glass dark 0 0 3 .7 .7 .7\ndark" + kInWindow},
    {"FrostedPane", kHole + "void trans frost 0 0 7 .9 .9 .9 0 0 .9 .3\nfrost" + kInWindow,
     kHole + "void trans frost 0 0 7 .9 .9 .9 0 0 .7 .3\nfrost" + kInWindow},
    {"HoleBehindAHole", kHole + lobby(.2, 2.4, .5, 2.3)},
    {"Mirror", kHole + kPane + "void mirror silver 0 0 3 .9 .9 .9\nsilver" + kOnWall,
     kHole + kPane + "black" + kOnWall},
    {"MetalMirror", kHole + kPane + "void metal chrome 0 0 5 .9 .9 .9 1 0\nchrome" + kOnWall,
     kHole + kPane + "black" + kOnWall},
    {"RoughMetal", kHole + kPane + "void metal steel 0 0 5 .8 .8 .8 .9 .15\nsteel" + kOnWall,
     kHole + kPane + "black" + kOnWall},
    {"Overhang", kHole + kPane + box("white", V3d(.2, -.8, 2.25), V3d(2.8, -.01, 2.3)), kHole + kPane},
    {"LightShelf",
     kHole + kPane + "void metal chrome 0 0 5 .9 .9 .9 1 0\n" +
         box("chrome", V3d(.5, .02, 1.5), V3d(2.5, .9, 1.52)),
     kHole + kPane + box("black", V3d(.5, .02, 1.5), V3d(2.5, .9, 1.52))},
    {"Blinds", kHole + kPane + slats()},
    {"Door", wall(0, .9, 2.1, .001, 2.1) + lobby(.3, 2.5, .4, 2.3) +
                 box("white", V3d(.84, .02, .01), V3d(.88, 1.2, 2.1))},
};

struct Light {
  const char* name;
  const char* sources;
};
const std::vector<Light> kLights{
    {"Sky",
     "void glow above 0 0 4 3 4 6 0\nabove source sky 0 0 4 0 0 1 180\n"
     "void glow below 0 0 4 1 .8 .6 0\nbelow source earth 0 0 4 0 0 -1 180\n"},
    {"Sun",
     "void light solar 0 0 3 4e5 4e5 4e5\nsolar source sun 0 0 4 -.5 -.7 .6 .5\n"
     "void glow above 0 0 4 3 4 6 0\nabove source sky 0 0 4 0 0 1 180\n"},
    // Outdoors, below the window sill.
    {"Lamp",
     "void light lamp 0 0 3 90 90 90\n"
     "lamp polygon p 0 0 12 2.45 -1.3 .3 2.95 -1.3 .3 2.95 -.4 .3 2.45 -.4 .3\n"},
};

const V3d kPoint(1.4, 2.1, .9);  // sees neither the sun nor the lamp

double times() {
  const char* const asked = std::getenv("RSPHERE_WAYS");
  return asked ? std::max(1., std::atof(asked)) : 0;
}
int repeats(int usual) { return static_cast<int>(usual * std::max(1., times())); }

SphereSetting settingOf(const std::string& text, int bounces, double accuracy) {
  return SphereSetting(sceneOf(text), [&](RayOptions& o) {
    o.ambientBounces = bounces;
    o.ambientAccuracy = accuracy;
    o.ambientDivisions = accuracy > 0 ? 64 : 1;
    o.sourceSubstructuring = .1;
  });
}

Sample meansOf(const SphereSetting& setting, Weights weights, int directions, int sets) {
  Sample sample;
  for (int k = 0; k < repeats(sets); ++k) {
    SphereOptions o = setting.options.sphere;
    o.weights = weights;
    o.baseDirections = directions;
    o.mostDirections = 2 * directions;
    o.rotation = static_cast<uint64_t>(k);
    const SphereEstimator estimator(*setting.transport, o);
    SphereEstimator::Workspace workspace(estimator);
    sample.add(brightness(estimator.estimate(kPoint, workspace).mean));
  }
  return sample;
}
Sample byPathsFromTheEye(const std::string& text, int bounces) {
  return meansOf(settingOf(text, bounces, 0), Weights::homogeneous, 1500, 8);
}

// The means of rays in ray mode. With -aa 0 their contributions add up to them, ray by ray.
Sample byRays(const SphereSetting& setting, int directions, int sets) {
  const PreparedScene& prepared = setting.transport->prepared();
  std::vector<TrackedModifier> emitters;
  for (const char* name : {"above", "below", "solar", "lamp"}) emitters.push_back({name, 1, std::nullopt});
  const Tracked tracked(prepared, std::move(emitters), Contributed::values);
  const bool interpolated = prepared.options().ambientAccuracy > 0;
  Sample sample;
  PathTracer tracer = setting.transport->pathTracer();
  ContributionTracer contributions(setting.transport->pathTracer(), tracked);
  for (int k = 0; k < repeats(sets); ++k) {
    const auto set = rotatedDirections(baseDirections(static_cast<size_t>(directions)), 1000 + k);
    double sum = 0;
    for (size_t i = 0; i < set.size(); ++i) {
      const uint64_t seed = mixBits(k * set.size() + i);
      const Color answer = tracer.trace(kPoint, set[i], 0, seed).value.color;
      sum += brightness(answer);
      if (interpolated) continue;
      const auto values = contributions.trace(kPoint, set[i], 0, seed).values();
      EXPECT_NEAR(std::accumulate(values.begin(), values.end(), 0.), answer.x + answer.y + answer.z,
                  1e-9 * (answer.x + answer.y + answer.z));
    }
    sample.add(sum / directions);
  }
  return sample;
}

// allowed: relative, beyond the standard errors.
void expectEqual(const Sample& a, const Sample& b, double allowed = 0) {
  const double error = std::hypot(a.standardError(), b.standardError());
  EXPECT_LT(std::abs(a.mean() - b.mean()), kMostSigmas * error + allowed * b.mean())
      << a.mean() << " +- " << a.standardError() << " and " << b.mean() << " +- " << b.standardError();
}

using Case = std::tuple<size_t, size_t>;
class ClassesOfPaths : public ::testing::TestWithParam<Case> {};

TEST_P(ClassesOfPaths, AreFoundOnceByEachMethod) {
  const auto [what, by] = GetParam();
  const Meets& meets = kMeets[what];
  const std::string room = std::string(kRoom) + kLights[by].sources;
  const bool lacksBounce = meets.spoiled.empty();
  const size_t usual = lacksBounce ? 1 + (what + by) % 2 : (2 * what + by + 3) % 5;
  for (int bounces = 0; bounces <= 4; ++bounces) {
    if (times() == 0 && static_cast<size_t>(bounces) != usual) continue;
    SCOPED_TRACE(fmt::format("-ab {}", bounces));
    const std::string text = room + meets.surfaces;
    const Sample eye = byPathsFromTheEye(text, bounces);
    const SphereSetting plain = settingOf(text, bounces, 0);
    {
      SCOPED_TRACE("sphere mode");
      const Sample both = meansOf(plain, Weights::silhouettes, 256, 8);
      expectEqual(both, eye);
      if (bounces == 0 && lacksBounce) continue;
      const Sample spoiled = lacksBounce ? byPathsFromTheEye(text, bounces - 1)
                                         : byPathsFromTheEye(room + meets.spoiled, bounces);
      EXPECT_GT(std::abs(both.mean() - spoiled.mean()),
                kMostSigmas * std::hypot(both.standardError(), spoiled.standardError()))
          << "would not see that a class is lost: " << both.mean() << " +- " << both.standardError()
          << " and " << spoiled.mean() << " +- " << spoiled.standardError();
    }
    {
      SCOPED_TRACE("rays, contributions");
      expectEqual(byRays(plain, 300, 6), eye);
    }
    // The light of patches varies by less than what is allowed for their bias.
    const SphereSetting cached = settingOf(text, bounces, .1);
    {
      SCOPED_TRACE("sphere mode, -aa .1");
      expectEqual(meansOf(cached, Weights::silhouettes, 256, 4), eye, .02);
    }
    {
      SCOPED_TRACE("rays, -aa .1");
      expectEqual(byRays(cached, 300, 4), eye, .02);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Light, ClassesOfPaths,
                         ::testing::Combine(::testing::Range(size_t{0}, kMeets.size()),
                                            ::testing::Range(size_t{0}, kLights.size())),
                         [](const auto& info) {
                           return std::string(kMeets[std::get<0>(info.param)].name) +
                                  kLights[std::get<1>(info.param)].name;
                         });

}  // namespace
}  // namespace rsphere::classes_of_paths_test
