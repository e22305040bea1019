#include "contrib/tracked.h"

#include <gtest/gtest.h>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

RayOptions rayOptions(int bounces) {
  RayOptions o;
  o.ambientBounces = bounces;
  o.ambientDivisions = 16;
  o.ambientSuperSamples = 0;
  o.ambientAccuracy = 0;
  o.directThreshold = 0;
  o.directJitter = 1;
  o.specularThreshold = 0;
  return o;
}

// Everything that emits: a lamp, a spotlight, a virtual source by the mirror, an illum, a glow with a reach,
// a sun and a sky through panes and a hole; on plastic, metal, trans and dielectric.
const std::string kRoom =
    "void plastic white 0 0 5 .6 .5 .4 .05 .1\nvoid metal shiny 0 0 5 .7 .6 .5 .9 .1\n"
    "void trans cloth 0 0 7 .5 .5 .5 .1 .1 .5 .5\nvoid glass clear 0 0 3 .9 .8 .7\n"
    "void dielectric ball 0 0 5 .9 .9 .9 1.5 0\nvoid mirror silver 0 0 3 .8 .8 .8\n"
    "void light lamp 0 0 3 5 4 3\nvoid spotlight spot 0 0 7 90 90 90 60 0 0 -1\n"
    "void illum sheet 0 0 3 1 2 3\nvoid glow near 0 0 4 2 2 2 .7\n"
    "void glow sky 0 0 4 1 1.5 2 0\nvoid light sunlight 0 0 3 1e4 1e4 1e4\n"
    "sky source heaven 0 0 4 0 0 1 180\nsunlight source sun 0 0 4 0 -1 1 .53\n"
    "white polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
    "white polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
    "silver polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\n"
    "shiny polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
    "white polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
    "white polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1.5 0 1 1.5 0 2 2.5 0 2 2.5 0 1 1.5 0 1\n"
    "clear polygon window 0 0 12 1.5 0 1 2.5 0 1 2.5 0 2 1.5 0 2\n"
    "lamp polygon panel 0 0 12 1 1 2.9 1 2 2.9 2 2 2.9 2 1 2.9\n"
    "spot ring can 0 0 8 3 3 2.8 0 0 -1 0 .1\nsheet polygon board 0 0 12 .5 3.9 1 1 3.9 1 1 3.9 2 .5 3.9 2\n"
    "near sphere bulb 0 0 4 3.4 1 1 .1\ncloth polygon curtain 0 0 12 2.6 1 0 3.4 1.4 0 3.4 1.4 2 2.6 1 2\n"
    "ball sphere drop 0 0 4 1.2 2.4 .6 .3\n";
const std::vector<std::string> kEmitters{"lamp", "spot", "sheet", "near", "sky", "sunlight"};

std::vector<TrackedModifier> tracked(const std::vector<std::string>& names) {
  std::vector<TrackedModifier> all;
  for (const std::string& name : names) all.push_back({name, 1, std::nullopt});
  return all;
}

Color sumOf(const ContributionList& list) {
  Color sum(0, 0, 0);
  for (size_t i = 0; i < list.columns().size(); ++i)
    sum += Color(list.values()[3 * i], list.values()[3 * i + 1], list.values()[3 * i + 2]);
  return sum;
}

void expectEqual(const Color& a, const Color& b, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance * std::abs(b[c])) << c;
}

TEST(Tracked, SumOverAllThatEmitsIsTheAnswer) {
  for (const int bounces : {0, 1, 3})
    for (const IrradianceAt irradiance : {IrradianceAt::none, IrradianceAt::surface, IrradianceAt::point}) {
      Traced room(kRoom, rayOptions(bounces), irradiance);
      const Tracked all(room.prepared(), tracked(kEmitters), Contributed::values);
      for (const V3d& direction : {V3d(0, 0, -1), V3d(1, .2, -.3), V3d(-1, .1, -.2), V3d(.1, -1, -.1),
                                   V3d(.3, 1, -.4), V3d(-.8, .4, -.6), V3d(.9, -.6, -.5)})
        for (uint64_t seed = 1; seed < 4; ++seed) {
          ContributionTracer tracer(room.transport().pathTracer(), all);
          const V3d origin(2, 2, 1.2);
          const V3d unit = direction.normalized();
          const Color sum = sumOf(tracer.trace(origin, unit, 0, seed));
          PathTracer plain = room.transport().pathTracer();
          const Color answer = plain.trace(origin, unit, 0, seed).value.color;
          expectEqual(tracer.ray().value.color, answer, 0);  // an observer changes nothing
          expectEqual(sum, answer, 1e-12);
        }
    }
}

// Coefficients of some modifiers, without shadow rays to the other sources, are those among all. "silver" is
// the mirror that shows other sources.
TEST(Tracked, SourcesThatAreNotTrackedAreLeftOutOfCoefficients) {
  RayOptions o = rayOptions(3);
  o.directJitter = 0;  // samples of sources then use no random numbers
  Traced room(kRoom, o);
  std::vector<std::string> names = kEmitters;
  names.emplace_back("silver");
  const Tracked all(room.prepared(), tracked(names), Contributed::coefficients);
  EXPECT_EQ(Tracked(room.prepared(), tracked({"lamp"}), Contributed::values).sampledLights(), nullptr);
  for (size_t m = 0; m < names.size(); ++m) {
    const Tracked one(room.prepared(), tracked({names[m]}), Contributed::coefficients);
    ASSERT_NE(one.sampledLights(), nullptr) << names[m];
    ContributionTracer ofAll(room.transport().pathTracer(), all), ofOne(room.transport().pathTracer(), one);
    Color sum(0, 0, 0), alone(0, 0, 0);
    for (const V3d& direction : {V3d(0, 0, -1), V3d(-1, .1, -.2), V3d(.9, -.6, -.5), V3d(.3, 1, -.4)})
      for (uint64_t seed = 1; seed < 5; ++seed) {
        const V3d origin(2, 2, 1.2), unit = direction.normalized();
        const ContributionList& list = ofAll.trace(origin, unit, 0, seed);
        for (size_t i = 0; i < list.columns().size(); ++i)
          if (list.columns()[i] == m)
            sum += Color(list.values()[3 * i], list.values()[3 * i + 1], list.values()[3 * i + 2]);
        alone += sumOf(ofOne.trace(origin, unit, 0, seed));
      }
    EXPECT_GT(sum.x, 0) << names[m];
    expectEqual(alone, sum, 1e-12);
  }
}

// A room with a window, without light sources.
const std::string kDaylit =
    "void plastic white 0 0 5 .6 .5 .4 0 0\nvoid glass clear 0 0 3 .9 .8 .7\nvoid glow sky 0 0 4 1 1 1 0\n"
    "sky source heaven 0 0 4 0 0 1 180\nsky source below 0 0 4 0 0 -1 180\n"
    "white polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n"
    "white polygon ceiling 0 0 12 0 0 3 0 4 3 4 4 3 4 0 3\n"
    "white polygon west 0 0 12 0 0 0 0 4 0 0 4 3 0 0 3\nwhite polygon east 0 0 12 4 0 0 4 0 3 4 4 3 4 4 0\n"
    "white polygon north 0 0 12 0 4 0 4 4 0 4 4 3 0 4 3\n"
    "white polygon south 0 0 30 0 0 0 4 0 0 4 0 3 0 0 3 0 0 0 1.5 0 1 1.5 0 2 2.5 0 2 2.5 0 1 1.5 0 1\n"
    "clear polygon window 0 0 12 1.5 0 1 2.5 0 1 2.5 0 2 1.5 0 2\n";

// Mean and standard error of what all bins of the sky give to a sensor.
struct ByBins {
  double mean = 0, error = 0;
};
ByBins byBins(int firstRays, double spoil = 1) {
  RayOptions o = rayOptions(3);
  o.ambientDivisions = 256;
  o.firstRays = firstRays;
  const Traced room(kDaylit, o, IrradianceAt::point);
  TrackedModifier sky{"sky", 24, std::nullopt};
  sky.zones = std::make_shared<const EqualZones>(24);
  const Tracked tracked(room.prepared(), {sky}, Contributed::values);
  ContributionTracer tracer(room.transport().pathTracer(), tracked);
  constexpr int kRuns = 60;
  double sum = 0, square = 0;
  for (uint64_t seed = 1; seed <= kRuns; ++seed) {
    const ContributionList& list = tracer.trace(V3d(2, 2.5, .8), V3d(0, 0, 1), 0, seed);
    expectEqual(sumOf(list), tracer.ray().value.color, 1e-12);
    double all = 0;
    for (size_t i = 0; i < list.columns().size(); ++i) all += spoil * list.values()[3 * i];
    sum += all, square += all * all;
  }
  return {sum / kRuns, std::sqrt((square / kRuns - sum * sum / kRuns / kRuns) / kRuns)};
}

// More rays of the first gather (-Sh) leave the mean as it is, with no more noise; 10% more are found out.
TEST(Tracked, MoreFirstRaysGiveTheSameMean) {
  const ByBins plain = byBins(1), more = byBins(8), spoiled = byBins(8, 1.1);
  const auto apart = [&](const ByBins& b) {
    return std::abs(b.mean - plain.mean) / std::hypot(b.error, plain.error);
  };
  EXPECT_LT(apart(more), 4);
  EXPECT_GT(apart(spoiled), 4);
  EXPECT_LT(more.error, 1.3 * plain.error);
}

// The same sum without the light that shadow rays bring with nothing in their way.
TEST(Tracked, SumLacksWhatTheObserverIsNotShown) {
  Traced room(kRoom, rayOptions(1));
  const Tracked all(room.prepared(), tracked(kEmitters), Contributed::values);
  PathTracer tracer = room.transport().pathTracer();
  BinScratch scratch;
  ContributionList list(3);
  const RayObserver observer = [&](const RayEnd& end, const RayResult& result) {
    all.add(end, result, scratch, list);
  };
  const Color answer = tracer.trace(V3d(2, 2, 1.2), V3d(0, 0, -1), 0, 1, {.observer = &observer}).value.color;
  EXPECT_LT(sumOf(list).x, .9 * answer.x);
}

// A floor in the open, under a sky and a lamp.
const std::string kPlain =
    "void plastic white 0 0 5 .6 .5 .4 0 0\nvoid glow sky 0 0 4 1 1 1 0\nsky source heaven 0 0 4 0 0 1 360\n"
    "void light lamp 0 0 3 5 4 3\nlamp sphere bulb 0 0 4 2 2 9 .1\n"
    "white polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n";

// Coefficients times the radiance of sources that are the same everywhere are their values.
TEST(Tracked, CoefficientTimesRadianceIsTheValue) {
  Traced room(kPlain, rayOptions(2));
  const Tracked coefficients(room.prepared(), tracked({"sky", "lamp"}), Contributed::coefficients);
  const Tracked values(room.prepared(), tracked({"sky", "lamp"}), Contributed::values);
  ContributionTracer a(room.transport().pathTracer(), coefficients), b(room.transport().pathTracer(), values);
  const ContributionList& shares = a.trace(V3d(2, 2, 1), V3d(0, 0, -1), 0, 5);
  const ContributionList& light = b.trace(V3d(2, 2, 1), V3d(0, 0, -1), 0, 5);
  ASSERT_EQ(shares.columns().size(), 2u);
  ASSERT_EQ(light.columns().size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(shares.columns()[i], light.columns()[i]);
    const Color radiance = shares.columns()[i] == 0 ? Color(1, 1, 1) : Color(5, 4, 3);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(shares.values()[3 * i + c] * radiance[c], light.values()[3 * i + c], 1e-12);
  }
}

// As in RADIANCE: the back of a lamp is dark, but a path that ends there has a coefficient.
TEST(Tracked, BackOfASourceHasACoefficientAndNoValue) {
  Traced room("void light lamp 0 0 3 5 4 3\nlamp ring disk 0 0 8 0 0 1 0 0 -1 0 1\n", rayOptions(0));
  for (const Contributed what : {Contributed::coefficients, Contributed::values}) {
    const Tracked all(room.prepared(), tracked({"lamp"}), what);
    ContributionTracer tracer(room.transport().pathTracer(), all);
    expectEqual(sumOf(tracer.trace(V3d(0, 0, 3), V3d(0, 0, -1), 0, 1)),
                what == Contributed::values ? Color(0, 0, 0) : Color(1, 1, 1), 0);
    expectEqual(sumOf(tracer.trace(V3d(0, 0, 0), V3d(0, 0, 1), 0, 1)),
                what == Contributed::values ? Color(5, 4, 3) : Color(1, 1, 1), 0);
  }
}

// As in RADIANCE, a coefficient of an illum includes a view through it; its value is its own light alone.
TEST(Tracked, IllumSeenThroughHasACoefficientAndNoValue) {
  Traced room(
      "void illum sheet 0 0 3 1 2 3\nsheet ring disk 0 0 8 0 0 1 0 0 -1 0 1\n"
      "void glow sky 0 0 4 1 1 1 0\nsky source heaven 0 0 4 0 0 1 360\n",
      rayOptions(0));
  for (const Contributed what : {Contributed::coefficients, Contributed::values}) {
    const Tracked all(room.prepared(), tracked({"sheet"}), what);
    ContributionTracer tracer(room.transport().pathTracer(), all);
    for (const double side : {-1., 1.})
      expectEqual(sumOf(tracer.trace(V3d(0, 0, 1 - side), V3d(0, 0, side), 0, 1)),
                  what == Contributed::values ? Color(0, 0, 0) : Color(1, 1, 1), 0);
  }
}

TEST(Tracked, BinsAreThoseOfTheHit) {
  Traced room(kPlain, rayOptions(0));
  BinFunctions functions;
  const BinDefinitions definitions{{{false, "side:2"}}, "edge=2"};
  std::vector<TrackedModifier> modifiers{
      {"white", 2, functions.compile("-b", "if(edge-Px,0,1)", definitions)},
      {"sky", 3, functions.compile("-b", "if(Dz,if(Dx,side,1),-1)", definitions)}};
  const Tracked bins(room.prepared(), modifiers, Contributed::coefficients);
  EXPECT_EQ(bins.columns(), 5u);
  EXPECT_EQ(bins.firstColumn(1), 2u);
  ContributionTracer tracer(room.transport().pathTracer(), bins);
  const auto columns = [&](const V3d& direction) {
    const std::span<const uint32_t> found =
        tracer.trace(V3d(2, 2, 1.5), direction.normalized(), 0, 1).columns();
    return std::vector<uint32_t>(found.begin(), found.end());
  };
  EXPECT_EQ(columns(V3d(-.1, -1, .1)), std::vector<uint32_t>{3});
  EXPECT_EQ(columns(V3d(.1, -1, .1)), std::vector<uint32_t>{4});
  EXPECT_EQ(columns(V3d(.1, -1, -.1)), std::vector<uint32_t>{});  // a negative bin is left out
  EXPECT_EQ(columns(V3d(-.3, 0, -1)), std::vector<uint32_t>{0});
  EXPECT_EQ(columns(V3d(.3, 0, -1)), std::vector<uint32_t>{1});
}

TEST(Tracked, BinsThatDoNotExistAreLeftOutWithOneWarning) {
  Traced room(kPlain, rayOptions(0));
  BinFunctions functions;
  std::vector<std::string> warnings;
  const Tracked bins(room.prepared(), {{"white", 2, functions.compile("-b", "Px*10", {})}},
                     Contributed::coefficients, [&](std::string_view text) { warnings.emplace_back(text); });
  ContributionTracer tracer(room.transport().pathTracer(), bins);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(tracer.trace(V3d(2, 2, 1), V3d(0, 0, -1), 0, 1).columns().empty());
  EXPECT_EQ(warnings,
            std::vector<std::string>{"bad bin number (20 ignored): modifier 'white' has bins 0 to 1"});
}

TEST(BinFunctions, FaultsNameTheirOption) {
  BinFunctions functions;
  const auto message = [&](const std::string& expression, const BinDefinitions& definitions) {
    try {
      functions.compile("-b", expression, definitions);
    } catch (const rad::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("Dx+(", {}).substr(0, 10), "-b 'Dx+(':");
  EXPECT_NE(message("nix", {}).find("nix"), std::string::npos);
  EXPECT_NE(message("1", {{}, "a=b"}).find("bad parameter list"), std::string::npos);
  EXPECT_NE(message("1", {{{true, "nofile.cal"}}, ""}).find("nofile.cal"), std::string::npos);
}

}  // namespace
}  // namespace rsphere
