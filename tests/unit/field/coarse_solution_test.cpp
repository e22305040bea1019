#include "field/coarse_solution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <span>
#include <string>

#include "base/even_sequence.h"
#include "field/tuning.h"
#include "shade/scattering.h"
#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

constexpr double kReflectance = .6, kAmbient = .3;

// A room, and a wall without thickness across it.
const std::string kBox = "void plastic gray 0 0 5 .6 .6 .6 0 0\n" + roomOf("gray", V3d(4, 3, 2.5));
constexpr const char* kAcross = "gray polygon across 0 0 12 1.03 0 0 1.03 3 0 1.03 3 2.5 1.03 0 2.5\n";

// Follows rays from surface to surface as the header requires. Every surface emits a radiance.
class FurnaceRays final : public FieldRays {
 public:
  using Shine = std::function<double(const SurfacePlace& place)>;
  FurnaceRays(const Tracer& tracer, int bounces, Shine shine)
      : tracer_(tracer), bounces_(bounces), shine_(std::move(shine)) {}
  void solve(CoarseSolution& solution) { solution_ = &solution; }

  // The hit of a ray from inside the box.
  SurfacePlace placeAlong(const V3d& from, const V3d& direction) const {
    const Hit hit = tracer_.nearest(from, direction);
    EXPECT_NE(hit.surface, kNone);
    return {from + hit.distance * direction, hit.normal.dot(direction) > 0 ? -hit.normal : hit.normal,
            hit.surface, nullptr, hit.distance};
  }

  PatchLinks link(std::span<const PatchSite> sites, int rays, uint64_t seed) override {
    PatchLinks links;
    ++linked;
    raysOfLast = rays;
    Random random(seed);
    for (int i = 0; i < rays; ++i) {
      double coefficient = 1. / rays;
      const auto& [site, weight] = sites[static_cast<size_t>(i) % sites.size()];
      links.weight = weight;
      V3d from = site.point, normal = site.normal;
      for (int beyond = 0; beyond < bounces_; ++beyond) {
        const double u1 = random.uniform(), u2 = random.uniform();
        const SurfacePlace place = placeAlong(from, diffuseDirection(normal, u1, u2));
        links.addLight(beyond, Radiance(coefficient * shine_(place)));
        coefficient *= reflectance;
        // Some paths are continued, as if there were no patch.
        const bool goesOn = random.uniform() < .3;
        const PatchPlace to = solution_->find(place, *this, CoarseSolution::Asker::patch);
        if (to.patch && !goesOn) {
          links.addLink(to, Coefficient(coefficient), beyond);
          ++served;
          break;
        }
        ++followed;
        links.addEnd(beyond, Coefficient(coefficient));
        from = place.point + 1e-5 * place.normal;
        normal = place.normal;
      }
    }
    return links;
  }
  GatheredLight gather(const GatherSite&, double, uint64_t) override { return {}; }
  double clearance(const GatherSite&, double farthest) override { return farthest; }
  bool smallObjectNear(const GatherSite&, double, double) override { return false; }
  Surroundings surroundings(const GatherSite& site) override {
    const double distance = placeAlong(site.point, site.normal).distance;
    return {distance, mean > 0 ? mean : distance, covered};
  }
  bool sees(const V3d& from, const V3d& to) override {
    const V3d way = to - from;
    return tracer_.nearest(from, way.normalized(), way.length()).surface == kNone;
  }

  int linked = 0, served = 0, followed = 0, raysOfLast = 0;
  double reflectance = kReflectance;
  double mean = 0;     // distance seen from all sites; 0: that along the normal
  double covered = 1;  // share of directions that hit something

 private:
  const Tracer& tracer_;
  int bounces_;
  Shine shine_;
  CoarseSolution* solution_ = nullptr;
};

RayOptions optionsOf(int bounces) {
  RayOptions o = unbiased(bounces);
  o.ambientAccuracy = .2;
  o.ambientDivisions = 256;
  o.ambientValue = Radiance(kAmbient);
  return o;
}

// If all surfaces emit radiance 1 and have the same reflectance r, the incident radiance is 1 + r + r^2 ...,
// ending with the ambient value, whatever the patches and their links are.
TEST(CoarseSolution, LightIsTheGeometricSeriesInAFurnace) {
  constexpr int kBounces = 4;
  const Traced box(kBox);
  FurnaceRays rays(box.prepared().tracer(), kBounces, [](const SurfacePlace&) { return 1; });
  CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(optionsOf(kBounces)),
                          1);
  rays.solve(solution);
  Random random(2);
  int found = 0;
  for (int i = 0; i < 12; ++i) {
    const V3d from(between(random, .5, 3.5), between(random, .5, 2.5), between(random, .5, 2));
    const SurfacePlace place = rays.placeAlong(from, randomDirection(random));
    const PatchPlace on = solution.find(place, rays);
    if (!on.patch) continue;
    ++found;
    EXPECT_EQ(solution.find(place, rays).patch, on.patch) << "the same again";
    for (int bounces = kBounces; bounces >= 0; --bounces) {
      double expected = std::pow(kReflectance, bounces) * kAmbient;
      for (int n = 0; n < bounces; ++n) expected += std::pow(kReflectance, n);
      EXPECT_NEAR(solution.light(on, bounces, rays).x, expected, 1e-4) << bounces;
      EXPECT_GT(std::abs(solution.light(on, bounces + 1, rays).x - expected), bounces < kBounces ? .05 : -1)
          << "one bounce more is another";
    }
  }
  EXPECT_GE(found, 4) << "or nothing is told";
  EXPECT_GT(rays.served, 0);
  EXPECT_GT(rays.followed, 0);
  EXPECT_LE(static_cast<size_t>(rays.linked), solution.patches()) << "a patch is linked once";
}

// A limit of 40 bounces is kept; a larger one means all, whose light is extrapolated.
TEST(CoarseSolution, LightOfManyBouncesIsASeriesToo) {
  const Traced box(kBox);
  for (const int limit : {30, 41, RayOptions::kAllBounces}) {
    FurnaceRays rays(box.prepared().tracer(), limit, [](const SurfacePlace&) { return 1; });
    RayOptions options = optionsOf(limit);
    options.ambientValue = Radiance(0);
    CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(options), 1);
    rays.solve(solution);
    Random random(2);
    int found = 0;
    for (int i = 0; i < 12; ++i) {
      const V3d from(between(random, .5, 3.5), between(random, .5, 2.5), between(random, .5, 2));
      const PatchPlace on = solution.find(rays.placeAlong(from, randomDirection(random)), rays);
      if (!on.patch) continue;
      ++found;
      const double all = 1 / (1 - kReflectance);
      const double expected = limit > 30 ? all : all * (1 - std::pow(kReflectance, limit));
      EXPECT_NEAR(solution.light(on, limit, rays).x, expected, 1e-5) << limit;
      EXPECT_LT(solution.light(on, 12, rays).x, all * (1 - std::pow(kReflectance, 12)) + 1e-4);
    }
    EXPECT_GE(found, 4);
  }
}

// The light of all bounces and of `bounces` bounces at a place, where some surfaces shine.
struct Compared {
  double all, some;
};
Compared compareBounces(const Traced& room, const std::function<double(const SurfacePlace&)>& shine,
                        const V3d& from, const V3d& to, int bounces, double reflectance) {
  FurnaceRays rays(room.prepared().tracer(), RayOptions::kAllBounces, shine);
  rays.reflectance = reflectance;
  RayOptions options = optionsOf(RayOptions::kAllBounces);
  options.ambientValue = Radiance(0);
  const auto light = [&](int limit) {
    options.ambientBounces = limit;
    CoarseSolution solution(room.scene(), room.prepared().tracer().bounds(), fieldOptions(options), 1);
    rays.solve(solution);
    SurfacePlace place = rays.placeAlong(from, to);
    place.distance = 20;  // so that a patch serves it
    const PatchPlace on = solution.find(place, rays);
    return on.patch ? solution.light(on, limit, rays).x : 0;
  };
  return {light(RayOptions::kAllBounces), light(bounces)};
}

// Also between parallel surfaces, as of louvers, where only one shines: each then receives the light of every
// other bounce alone.
TEST(CoarseSolution, LightOfManyBouncesMayAlternate) {
  constexpr int kBounces = 40;
  constexpr double kHeight = .01;
  const Traced gap("void plastic gray 0 0 5 .6 .6 .6 0 0\n" + roomOf("gray", V3d(4, 3, kHeight)));
  for (const double up : {-1., 1.}) {
    const Compared light = compareBounces(
        gap, [](const SurfacePlace& place) { return place.point.z < kHeight / 2 ? 1 : 0; },
        V3d(2.1, 1.6, kHeight / 2), V3d(0, 0, up), kBounces, kReflectance);
    EXPECT_NEAR(light.all, (up > 0 ? 1 : kReflectance) / (1 - kReflectance * kReflectance), .01) << up;
    EXPECT_NEAR(light.all, light.some, 1e-3) << up;
  }
}

// At the bottom of a white well, light still grows from bounce to bounce where it falls already at the top.
TEST(CoarseSolution, LightOfManyBouncesReachesTheBottomOfAWell) {
  constexpr double kDepth = 6;
  const Traced well("void plastic white 0 0 5 .8 .8 .8 0 0\n" + roomOf("white", V3d(1, 1, kDepth)));
  const auto shine = [](const SurfacePlace& place) { return place.point.z > kDepth - 1e-3 ? 1 : 0; };
  const V3d from(.4, .6, .5), down(0, 0, -1);
  const Compared light = compareBounces(well, shine, from, down, 40, .8);
  ASSERT_GT(light.some, 0);
  EXPECT_NEAR(light.all / light.some, 1, .015);
  EXPECT_LT(compareBounces(well, shine, from, down, 16, .8).some, .94 * light.some) << "or nothing is told";
}

// The rays that the patch of a place on the floor of the box has, for a room of this size.
int raysOfPatch(const Traced& box, const RayOptions& options, double room, double distance = 0,
                double covered = 1) {
  FurnaceRays rays(box.prepared().tracer(), 1, [](const SurfacePlace&) { return 1; });
  rays.mean = distance;
  rays.covered = covered;
  CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(options), room);
  rays.solve(solution);
  const SurfacePlace place = rays.placeAlong(V3d(2, 1.5, 2), V3d(0, 0, -1));
  const PatchPlace on = solution.find(place, rays, CoarseSolution::Asker::patch);
  if (on.patch) solution.light(on, 1, rays);
  return rays.raysOfLast;
}

// A patch has rays in proportion to its area over the square of the room's size, fewer outdoors, and more of
// them the smaller -aa is.
TEST(CoarseSolution, RaysGoWhereTheirNoiseMatters) {
  using Tuning = tuning::CoarseSolution;
  const Traced box(kBox);
  RayOptions options = optionsOf(1);
  options.ambientAccuracy = .1;
  options.ambientDivisions = 8192;
  const double usual = Tuning::kRays * 8192;
  EXPECT_EQ(raysOfPatch(box, options, 1e3), Tuning::kLeastRays);
  constexpr int kSites = 4;  // each has the same number of rays
  EXPECT_NEAR(raysOfPatch(box, options, .01, .01), usual * Tuning::kMoreRays, kSites);
  const int small = raysOfPatch(box, options, 3), large = raysOfPatch(box, options, 4);
  EXPECT_GT(large, Tuning::kLeastRays + 1);
  EXPECT_LT(small, usual * Tuning::kMoreRays - 1);
  EXPECT_NEAR(small, large * (16. / 9), 2 * kSites);
  EXPECT_EQ(raysOfPatch(box, options, 3, 4), large) << "what it sees is farther than the room is wide";
  EXPECT_NEAR(raysOfPatch(box, options, 3, 3, .5), .5 * small, kSites) << "it sees the sky";
  options.ambientAccuracy = .05;
  EXPECT_NEAR(raysOfPatch(box, options, 4), 2 * large, 2 * kSites);
  // Few directions at a point do not make patches noisy if more are asked for them.
  options.leastForPatches = 8192;
  const int atFirst = raysOfPatch(box, options, 4);
  EXPECT_GT(atFirst, Tuning::kLeastRays + 1);
  options.ambientDivisions = 4;
  EXPECT_EQ(raysOfPatch(box, options, 4), atFirst);
  options.leastForPatches = 1;
  EXPECT_EQ(raysOfPatch(box, options, 4), Tuning::kLeastRays);
}

// A wall of zero thickness with light on one side alone: the patches of places on the dark side are dark.
TEST(CoarseSolution, PatchesServeWhatTheySee) {
  constexpr int kBounces = 2;
  const Traced box(kBox + kAcross);
  FurnaceRays rays(box.prepared().tracer(), kBounces,
                   [](const SurfacePlace& p) { return (p.point + 1e-4 * p.normal).x < 1.03 ? 1 : 0; });
  RayOptions options = optionsOf(kBounces);
  options.ambientValue = Radiance(0);
  options.ambientDivisions = 64;
  CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(options), 1);
  rays.solve(solution);
  Random random(4);
  int found[2] = {0, 0};
  for (int i = 0; i < 200; ++i) {
    const bool dark = i % 2;
    const V3d from(dark ? 2 : .5, 1.5, 1.3);
    // Places near the wall, on the floor and on the ceiling.
    const V3d to(dark ? between(random, 1.031, 1.5) : between(random, .6, 1.029), between(random, .1, 2.9),
                 i % 3 ? 0 : 2.5);
    const SurfacePlace place = rays.placeAlong(from, (to - from).normalized());
    const PatchPlace on = solution.find(place, rays);
    if (!on.patch) continue;
    ++found[dark];
    const double light = solution.light(on, kBounces, rays).x;
    if (dark)
      EXPECT_EQ(light, 0) << place.point;
    else
      EXPECT_GE(light, 1 - 1e-4) << place.point;
  }
  EXPECT_GT(found[0], 10) << "or nothing is told";
  EXPECT_GT(found[1], 10) << "or nothing is told";
}

// Rays whose light is that of the sites of a patch.
struct SiteRays final : FieldRays {
  std::function<double(double)> at;  // light of a site, by its x
  double dark = 2;                   // what lies beyond is hidden
  size_t sitesOfLast = 0;

  PatchLinks link(std::span<const PatchSite> sites, int rays, uint64_t) override {
    PatchLinks links;
    sitesOfLast = sites.size();
    links.rays = rays;
    for (const auto& [site, weight] : sites) {
      links.weight = weight;
      links.addLight(0, Radiance(at(site.point.x) / static_cast<double>(sites.size())));
    }
    return links;
  }
  GatheredLight gather(const GatherSite&, double, uint64_t) override { return {}; }
  double clearance(const GatherSite&, double farthest) override { return farthest; }
  bool smallObjectNear(const GatherSite&, double, double) override { return false; }
  Surroundings surroundings(const GatherSite&) override { return {1, 1, 1}; }
  bool sees(const V3d&, const V3d& to) override { return to.x < dark; }
};

// What the patches of a square of side 1 send, by their function and by their means.
struct Sent {
  double byFunction = 0, byMeans = 0;
  size_t patches = 0;
};

// seen: the weight that places are seen with, by their x. end: places have x up to this. asked: the rays of a
// gather; with the default, patches have enough for slopes.
Sent sentFromSquare(SiteRays& rays, const std::function<double(double)>& seen, double end = 1,
                    int asked = 8192) {
  const Traced square(
      "void plastic gray 0 0 5 .6 .6 .6 0 0\ngray polygon p 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\n");
  RayOptions options = optionsOf(1);
  options.ambientDivisions = asked;
  options.ambientAccuracy = .1;
  CoarseSolution solution(square.scene(), square.prepared().tracer().bounds(), fieldOptions(options), 1);
  constexpr size_t kPlaces = 4000;
  Sent sent;
  std::set<const Patch*> patches;
  for (size_t i = 0; i < kPlaces; ++i) {
    const double x = end * (static_cast<double>(i) + .5) / kPlaces;
    const V3d place(x, evenly(i, 0, 0).y, 0);
    const PatchPlace on = solution.find({place, V3d(0, 0, 1), SurfaceId(0), nullptr, 20}, rays);
    EXPECT_TRUE(on.patch);
    if (!on.patch) continue;
    sent.byFunction += solution.light(on, 1, rays).x * seen(x) / kPlaces;
    sent.byMeans += solution.light({on.patch, V2f(0, 0)}, 1, rays).x * seen(x) / kPlaces;
    patches.insert(on.patch);
  }
  sent.patches = patches.size();
  return sent;
}

// The patches of a square below a ceiling whose light grows ever faster towards one side: the mean of what
// they send into the room is that of the square. With the light at their middles, it would be too dark.
TEST(CoarseSolution, PatchesSendTheLightOfTheirWholeArea) {
  SiteRays rays;
  rays.at = [](double x) { return std::exp(12 * x); };
  const auto evenly = [](double) { return 1.; };
  const Sent sent = sentFromSquare(rays, evenly);
  const double whole = (std::exp(12) - 1) / 12;
  EXPECT_NEAR(sent.byFunction, whole, .003 * whole);
  const auto across = static_cast<int>(std::lround(std::sqrt(static_cast<double>(sent.patches))));
  double atMiddles = 0;
  for (int i = 0; i < across; ++i) atMiddles += rays.at((i + .5) / across) / across;
  EXPECT_GT(whole - atMiddles, .01 * whole) << "or the middle would do";
  // What something hides on the square does not make the places beside it dark.
  rays.dark = .8;
  EXPECT_GT(sentFromSquare(rays, evenly, .1).byMeans, 1);
  EXPECT_GT(rays.sitesOfLast, 1u);
}

// The square is seen from a place near that side: light and solid angle grow together over each patch.
TEST(CoarseSolution, LightIsLinearOverAPatch) {
  SiteRays rays;
  rays.at = [](double x) { return 1 + 50 * x; };
  const Sent sent = sentFromSquare(rays, [](double x) { return std::exp(60 * (x - 1)); });
  // The integral of (1 + 50 x) exp(60 (x - 1)), without terms below 1e-20.
  const double whole = 51. / 60 - 50. / 3600;
  EXPECT_NEAR(sent.byFunction, whole, 1e-3 * whole);
  EXPECT_LT(sent.byMeans, whole * .99) << "or the means would do";
  const Sent byFew = sentFromSquare(
      rays, [](double x) { return x; }, 1, 4);
  EXPECT_EQ(byFew.byFunction, byFew.byMeans) << "few rays give no slopes";
}

// The rays of a gather that hit a patch share its noise. Where they are more than its own rays, paths are
// followed instead: a sensor is not noisier than without patches.
TEST(CoarseSolution, NoPatchServesMoreRaysThanItHas) {
  const Traced box(kBox);
  FurnaceRays rays(box.prepared().tracer(), 2, [](const SurfacePlace&) { return 1; });
  RayOptions options = optionsOf(2);
  options.ambientDivisions = 4096;
  const SurfacePlace place{V3d(2, 1.5, 0), V3d(0, 0, 1), SurfaceId(0), nullptr, .9};
  for (const double room : {1., 1e3}) {  // the patches of a large room have few rays
    CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(options), room);
    rays.solve(solution);
    EXPECT_EQ(solution.find(place, rays).patch != nullptr, room == 1) << room;
    EXPECT_TRUE(solution.find(place, rays, CoarseSolution::Asker::patch).patch) << "its noise averages out";
  }
}

// The path of a ray from nearby is followed instead, because patches would be visible there.
TEST(CoarseSolution, NoPatchServesWhatIsSeenFromNear) {
  const Traced box(kBox);
  FurnaceRays rays(box.prepared().tracer(), 2, [](const SurfacePlace&) { return 1; });
  CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(optionsOf(2)), 1);
  rays.solve(solution);
  SurfacePlace place{V3d(2, 1.5, 0), V3d(0, 0, 1), SurfaceId(0), nullptr, 2.5};
  EXPECT_TRUE(solution.find(place, rays).patch);
  place.distance = 1e-3;
  EXPECT_FALSE(solution.find(place, rays).patch);
}

// Otherwise patches would not follow the light in narrow gaps.
TEST(CoarseSolution, PatchesSeenFromNearbyAreNarrow) {
  const Traced box(kBox);
  FurnaceRays rays(box.prepared().tracer(), 2, [](const SurfacePlace&) { return 1; });
  RayOptions options = optionsOf(2);
  options.ambientAccuracy = 1.6;
  CoarseSolution solution(box.scene(), box.prepared().tracer().bounds(), fieldOptions(options), 1);
  rays.solve(solution);
  constexpr double kDistance = .8, kLength = 2;
  const auto patchesAlong = [&](double distance) {
    std::set<const Patch*> patches;
    for (double x = 0; x < kLength; x += .01)
      patches.insert(
          solution.find({V3d(1 + x, 1.5, 0), V3d(0, 0, 1), SurfaceId(0), nullptr, distance}, rays).patch);
    return patches.size();
  };
  const double least = kLength / (tuning::CoarseSolution::kNear * kDistance);
  EXPECT_GE(static_cast<double>(patchesAlong(kDistance)), least);
  EXPECT_LT(static_cast<double>(patchesAlong(2.5)), least) << "or the distance does not matter";
}

}  // namespace
}  // namespace rsphere
