#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

// Materials that depend on function files: every type against values of the original, their effect on
// shadows, and errors in their files and arguments.
namespace rsphere::function_materials_test {
namespace {

// Library files are those of tests/scenes/materials.
class FunctionMaterials : public testing::Test {
 protected:
  void SetUp() override { setenv("RAYPATH", (std::string(RSPHERE_TESTS) + "/scenes/materials").c_str(), 1); }
  void TearDown() override { unsetenv("RAYPATH"); }
};

struct Shot {
  V3d origin, direction;
};
const std::array<Shot, 6> kShots = {{{{3, -2, 2.5}, {-2.85, 1.65, -1.3}},
                                     {{-2, -3, 2}, {1.9, 3.05, -.7}},
                                     {{1.5, 2.5, 3}, {-1.5, -2.3, -1.75}},
                                     {{1.9, -2.6, 2.1}, {-.1, 2.6, -1.5}},
                                     {{2.4, 2, 2.4}, {-.4, -1.7, -1.73}},
                                     {{2.9, .3, .3}, {-1.2, -.4, .23}}}};

// The output of rtrace -h -w -ab 0 -dj 0 -dt 0 -ds 0 -ss 0 -st 1 -lr 6 -lw 0 -av .1 .1 .1 (RADIANCE 6.1a,
// with its own rayinit.cal) for kShots in tests/scenes/materials. The scene is the text and kRoom. The first
// three shots see the ball, two the pane from above, the last one the pane from below.
struct Figures {
  const char* name;
  const char* text;
  double values[6][3];
};
constexpr const char* kRoom = R"(M sphere ball
0
0
4 0 0 1 .8
M polygon pane
0
0
12 1.2 -1 .4 2.6 -1 .7 2.6 1 .8 1.2 1 .5
void plastic wall
0
0
5 .6 .5 .4 0 0
wall polygon floor
0
0
12 -4 -4 0 4 -4 0 4 4 0 -4 4 0
void light L
0
0
3 60 50 40
L sphere lamp
0
0
4 -1 -2 3 .3
L polygon panel
0
0
12 1 .5 3.5 1 1.5 3.5 2 1.5 3.5 2 .5 3.5
L sphere low
0
0
4 2 .2 .15 .05
)";

RayOptions plain() {
  RayOptions o;
  o.directThreshold = o.sourceSubstructuring = o.weightLimit = o.specularSampling = 0;
  o.specularThreshold = 1;
  o.reflectionLimit = 6;
  o.ambientValue = Radiance(.1);
  return o;
}

std::vector<Figures> figures() {
  // clang-format off
  return {
      {"plastic2", R"(void plastic2 M
4 ux uy uz scattering.cal
0
6 .6 .5 .3 .08 .3 .1
)",
       {{0.3739178, 0.2697763, 0.1391726}, {0.629302, 0.4482821, 0.2270745},
        {1.328649, 0.9334124, 0.4589239}, {1.153138, 0.8110351, 0.3992335},
        {1.238049, 0.8701437, 0.4278801}, {0.2313173, 0.1707481, 0.09163912}}},
      {"plastic2 moved, with texture and pattern", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P plastic2 M
14 Nx+.2 Py Rdot . -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
6 .6 .5 .3 .08 .3 .1
)",
       {{0.3895373, 0.243447, 0.02499022}, {0.5712829, 0.6001095, 0.2507005},
        {1.258549, 0.7122383, 0.07202064}, {0.8922359, 0.6148379, 0.3924813},
        {0.5862175, 0.6310006, 0.2380076}, {0.2095142, 0.1249178, 0.07695647}}},
      {"metal2", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T metal2 M
4 0 0 1 .
0
6 .6 .5 .3 .8 .15 .35
)",
       {{0.1511383, 0.1132905, 0.06037943}, {0.8398176, 0.59154, 0.2899392},
        {4.548519, 3.167027, 1.526173}, {0.6078326, 0.4304393, 0.2126109},
        {0.5665947, 0.4018018, 0.1988649}, {0.09788623, 0.07630988, 0.04262874}}},
      {"trans2", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T trans2 M
4 0 0 1 .
0
8 .6 .5 .3 .05 .15 .35 .6 .5
)",
       {{0.2347224, 0.1724496, 0.09108263}, {0.3720816, 0.2772729, 0.1595127},
        {1.057208, 0.8043041, 0.5108853}, {0.661001, 0.4729769, 0.2439765},
        {0.6683899, 0.4773262, 0.2445631}, {0.4499969, 0.3219423, 0.1628323}}},
      {"trans2 moved", R"(void colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P trans2 M
14 ux uy uz scattering.cal -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
8 .9 .8 .7 .05 .25 .1 .7 .8
)",
       {{0.19031, 0.133065, 0.01938481}, {0.1344823, 0.1959976, 0.02820827},
        {0.5935825, 0.3622855, 0.04549735}, {0.4834915, 0.3560098, 0.3296529},
        {0.3208334, 0.3794152, 0.1975083}, {0.3435454, 0.2137672, 0.1836974}}},
      {"ashik2", R"(void colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P ashik2 M
14 ux uy uz scattering.cal -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
8 .4 .3 .2 .2 .3 .1 20 150
)",
       {{0.1833562, 0.1223804, 0.01764336}, {0.2227814, 0.2793145, 0.03950636},
        {0.8646415, 0.4621763, 0.0483614}, {0.6239932, 0.3986736, 0.2647133},
        {0.4240302, 0.4294769, 0.1629018}, {0.1690539, 0.1104065, 0.0666503}}},
      {"plasfunc moved", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P plasfunc M
12 told scattering.cal -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
4 .6 .5 .4 .3
)",
       {{0.3768716, 0.2496957, 0.06649854}, {0.2527926, 0.3090676, 0.07009364},
        {1.445809, 0.9451116, 0.3822284}, {0.7918489, 0.56056, 0.4621353},
        {0.5468366, 0.5668793, 0.298425}, {0.1908944, 0.117594, 0.09412007}}},
      {"plasfunc", R"(void plasfunc M
2 around scattering.cal
0
4 .6 .5 .4 .3
)",
       {{0.3001935, 0.2173257, 0.1475921}, {1.144593, 0.8948829, 0.668751}, {1.786004, 1.355086, 0.977469},
        {2.044891, 1.588997, 1.179134}, {2.474386, 1.938045, 1.451282}, {0.2493508, 0.1900263, 0.1378082}}},
      {"metfunc", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T metfunc M
12 scattered scattering.cal -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
9 .6 .5 .4 .3 .3 .15 .2 .1 1
)",
       {{0.378128, 0.2709222, 0.1813902}, {1.082473, 0.7600508, 0.4944325},
        {1.35726, 0.9508754, 0.6165603}, {1.025365, 0.7203925, 0.4690512},
        {0.9773368, 0.6870395, 0.4477052}, {0.1926018, 0.1420846, 0.09893413}}},
      {"transfunc", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P transfunc M
2 scattered scattering.cal
0
11 .6 .5 .4 .1 .7 .4 .3 .15 .2 .1 1
)",
       {{0.1472829, 0.09465066, 0.009621298}, {0.4578145, 0.4297952, 0.2608083},
        {0.548286, 0.3513141, 0.1223203}, {0.3865485, 0.264988, 0.2230828},
        {0.2537258, 0.2811854, 0.1316305}, {0.5332443, 0.3010185, 0.2279045}}},
      {"plasdata", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T plasdata M
15 scaled plane.dat scattering.cal height turned -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
4 .6 .5 .4 .3
)",
       {{0.6732811, 0.5168835, 0.3781595}, {0.7975527, 0.6026801, 0.4325863},
        {2.69738, 2.104987, 1.569726}, {1.575283, 1.197761, 0.8662291}, {1.948123, 1.502239, 1.104834},
        {0.3607291, 0.2821907, 0.211019}}},
      {"metdata", R"(void colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P metdata M
4 noop line.dat scattering.cal height
0
4 .6 .5 .4 .3
)",
       {{0.2751994, 0.1717882, 0.01679629}, {0.2476671, 0.3367679, 0.03221155},
        {1.269407, 0.7101483, 0.07148953}, {0.9201888, 0.6224326, 0.5144066},
        {0.6110889, 0.6692319, 0.3075549}, {0.2144067, 0.1245213, 0.09805106}}},
      {"transdata", R"(void colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P transdata M
5 noop plane.dat scattering.cal height turned
0
6 .6 .5 .4 .1 .7 .4
)",
       {{0.1803126, 0.1280263, 0.04715296}, {0.1812467, 0.1977964, 0.07807458},
        {0.6432168, 0.4369146, 0.1998608}, {0.6269487, 0.456438, 0.3767894},
        {0.5088403, 0.5030902, 0.2952782}, {0.6799305, 0.3940545, 0.2986194}}},
      {"BRTDfunc", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P BRTDfunc M
20 .1 .2*RdotP .3*CrP .2 .1+if(Rdot,.3,.1) .5*NxP*NxP told around 0
scattering.cal -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
9 .1 .2 .3 .3 .2 .1 .1 .05 .2
)",
       {{0.545357, 0.2183433, 0.0284805}, {0.4734273, 2.114811, 0.03842308},
        {3.018397, 2.945817, 0.09374081}, {1.073294, 3.536306, 0.4626212},
        {0.9031551, 4.525526, 0.2730506}, {0.4562638, 2.716067, 0.2706305}}},
      {"BRTDfunc of numbers", R"(void BRTDfunc M
10 .1 .1 .1 .3 .4 .5 0 0 0 .
0
9 0 0 0 0 0 0 0 0 0
)",
       {{0.03037278, 0.0388324, 0.04083502}, {0.003473242, 0.004719129, 0.005302357},
        {0.03817232, 0.0502424, 0.05453182}, {0.3019025, 0.2836324, 0.2319079},
        {0.1093506, 0.1269499, 0.1234528}, {0.08990694, 0.06327624, 0.04130714}}},
      {"BRTDfunc without sharp paths", R"(void colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P BRTDfunc M
10 0 0 0 0 0 0 scattered scattered scattered scattering.cal
0
14 .1 .2 .3 .3 .2 .1 .1 .05 .2 .4 .2 0 0 1
)",
       {{0.0849539, 0.102718, 0.03218104}, {1.108726, 1.022629, 0.7354978},
        {0.9395335, 0.8855645, 0.5363804}, {0.7922139, 0.7591207, 0.858447},
        {0.6916452, 0.7500333, 0.6495198}, {0.7933492, 0.536432, 0.582846}}},
      {"WGMDfunc moved", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
void colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
void WGMDfunc M
23 T .1+.05*RdotP .2 .1+.05*NxP P .3 .1 .3 void ux uy uz scattering.cal -s 1.5 -rz 40 -rx 25 -t .2 .1 .3
0
9 .1 .2 .3 .3 .2 .1 .1 .05 .2
)",
       {{0.1154004, 0.1547427, 0.1805578}, {0.5764552, 0.5872312, 0.5562978},
        {0.566057, 0.6719763, 0.7092996}, {0.3088331, 0.4118604, 0.5592537},
        {0.3201909, 0.4387819, 0.5844733}, {0.3707636, 0.1965549, 0.3433599}}},
      {"WGMDfunc of sharp paths", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P WGMDfunc M
13 inherit .08 0 0 inherit .4 0 0 inherit 0 0 1 .
0
9 .1 .2 .3 .3 .2 .1 .1 .05 .2
)",
       {{0.1281268, 0.121001, 0.02114963}, {0.05316203, 0.1506818, 0.02779165},
        {0.2855867, 0.3396697, 0.06003323}, {0.4602143, 0.4342028, 0.5901062},
        {0.1953338, 0.33979, 0.2983625}, {0.3278864, 0.1424015, 0.2522323}}},
      {"WGMDfunc of lobes", R"(void texfunc T
6 .15*sin(7*Px) .1*cos(9*Py) .12*sin(5*Pz) . -rz 20
0
0
T colorfunc P
4 .6+.3*sin(5*Px) .7 .5+.4*cos(6*Py) .
0
0
P WGMDfunc M
13 void .08 .2 .1 T .4 .15 .3 P 0 0 1 .
0
10 .1 .2 .3 .3 .2 .1 .1 .05 .2 7
)",
       {{0.1251802, 0.1538683, 0.06850276}, {0.1010477, 0.1953427, 0.07951379},
        {0.2801365, 0.3512364, 0.1067626}, {0.2579019, 0.3215737, 0.5184277},
        {0.1807881, 0.3285137, 0.3219899}, {0.332036, 0.15915, 0.2896175}}},
  };
  // clang-format on
}

TEST_F(FunctionMaterials, HaveTheOriginalsFigures) {
  for (const Figures& f : figures()) {
    Traced scene(std::string(f.text) + kRoom, plain());
    for (size_t i = 0; i < kShots.size(); ++i)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(scene.color(kShots[i].origin, kShots[i].direction)[channel], f.values[i][channel],
                    2e-6 * f.values[i][channel])
            << f.name << ", shot " << i + 1 << ", channel " << channel;
  }
}

// ---- sampled lobes

// The mean of lobe samples under a sky that is not a light source, compared with next-event estimation of the
// same sky divided into many small sources.
TEST_F(FunctionMaterials, SampledLobesSeeWhatDirectLightSees) {
  constexpr const char* kSky =
      "void brightfunc slope 2 1+Dx*.5+Dz*.3 . 0 0\nslope glow shine 0 0 4 1 1 1 0\nshine source sky 0 0 4 0 "
      "0 1 360\n";
  constexpr const char* kPlane = "M polygon plane 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n";
  std::string suns = "void brightfunc slope 2 1+Dx*.5+Dz*.3 . 0 0\nslope light shine 0 0 3 1 1 1\n";
  // A lattice of equal discs whose total solid angle is that of the hemisphere.
  constexpr int kSuns = 2000;
  for (int i = 0; i < kSuns; ++i) {
    const double z = (i + .5) / kSuns, r = std::sqrt(1 - z * z), a = 2.39996322973 * i;
    const double half = std::acos(1 - 1. / kSuns);
    suns += fmt::format("shine source s 0 0 4 {:.9f} {:.9f} {:.9f} {:.9f}\n", r * std::cos(a),
                        r * std::sin(a), z, 2 * half * 180 / std::numbers::pi);
  }
  for (const char* material :
       {"void metal2 M 4 1 .3 0 . 0 6 .9 .9 .9 1 .4 .2\n",
        "void WGMDfunc M 13 void .8 .4 .2 void 0 0 0 void 1 .3 0 . 0 9 0 0 0 0 0 0 0 0 0\n"}) {
    RayOptions o = unbiased();
    o.backFacesVisible = true;
    Traced sampled(std::string(kSky) + material + kPlane, o);
    o.specularThreshold = 1;
    Traced summed(suns + material + kPlane, o);
    const V3d eye(0, 0, 2), down(.8, .2, -1);
    expectMean(sampled.mean(eye, down, 20000), summed.value(eye, down));
  }
}

// ---- shadows

// The highlight of ashik2 under a sky whose radiance is 1 + .8 x + .5 z: the mean of its samples is the sky's
// mean over the lobe's half vectors (Ashikhmin and Shirley 2000, equation 6) whose directions lie above the
// surface. RADIANCE 6.1a with -u+ has the same means; one pass of 400 rays without it scatters by 1%.
TEST_F(FunctionMaterials, MeanHighlightOfAshik2IsTheQuadratureOfItsLobe) {
  constexpr double kAlong = 12, kAcross = 60, kSpecular = .3, kPi = std::numbers::pi;
  RayOptions o = unbiased();
  Traced scene(fmt::format("void brightfunc gradient 2 1+Dx*.8+Dz*.5 . 0 0\ngradient glow sky 0 0 4 1 1 1 0\n"
                           "sky source all 0 0 4 0 0 1 360\n"
                           "void ashik2 M 4 1 0 0 . 0 8 0 0 0 {0} {0} {0} {1} {2}\n"
                           "M polygon p 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n",
                           kSpecular, kAlong, kAcross),
               o);
  for (const V3d& toEye : {V3d(.3, .17, .94), V3d(.66, .38, .64), V3d(-.16, .92, .34)}) {
    const V3d eye = toEye.normalized();
    constexpr int kSteps = 300;
    double above = 0, sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < 2 * kSteps; ++k) {
        const double z = (i + .5) / kSteps, r = std::sqrt(1 - z * z), angle = kPi * (k + .5) / kSteps;
        const V3d to(r * std::cos(angle), r * std::sin(angle), z), half = (eye + to).normalized();
        const double power = (kAlong * half.x * half.x + kAcross * half.y * half.y) / (1 - half.z * half.z);
        const double density = std::sqrt((kAlong + 1) * (kAcross + 1)) / (2 * kPi) * std::pow(half.z, power) /
                               (4 * half.dot(eye));
        above += density;
        sum += density * (1 + .8 * to.x + .5 * to.z);
      }
    const double share = kSpecular + (1 - kSpecular) * std::pow(1 - eye.z, 5);
    expectMean(scene.mean(3. * eye, -eye, 4000), share * sum / above, 1.02);
  }
}

TEST_F(FunctionMaterials, OnlySharpTransmissionLetsLightPass) {
  const auto lit = [](const std::string& material) {
    Traced scene(material +
                     "void plastic white 0 0 5 1 1 1 0 0\nvoid light L 0 0 3 9 9 9\n"
                     "white polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n"
                     "M polygon pane 0 0 12 -1 -1 1 1 -1 1 1 1 1 -1 1 1\nL source sun 0 0 4 0 0 1 2\n",
                 plain());
    return (scene.value(V3d(1.5, 0, .5), V3d(-1.4, 0, -.5)) - .1) /
           (scene.value(V3d(5, 0, .5), V3d(1, 0, -.5)) - .1);
  };
  EXPECT_NEAR(lit("void plastic2 M 4 1 0 0 . 0 6 .5 .5 .5 .1 .1 .1\n"), 0, 1e-12);
  EXPECT_NEAR(lit("void trans2 M 4 1 0 0 . 0 8 1 1 1 0 .1 .1 1 1\n"), 0, 1e-12);
  EXPECT_NEAR(lit("void ashik2 M 4 1 0 0 . 0 8 .1 .1 .1 .1 .1 .1 9 9\n"), 0, 1e-12);
  EXPECT_NEAR(lit("void transfunc M 2 told scattering.cal 0 6 1 1 1 0 1 1\n"), 0, 1e-12);
  EXPECT_NEAR(lit("void BRTDfunc M 10 0 0 0 .4 .4 .4 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0\n"), .4, 1e-12);
  EXPECT_NEAR(lit("void BRTDfunc M 10 .5 .5 .5 0 0 0 0 0 0 . 0 9 0 0 0 0 0 0 1 1 1\n"), 0, 1e-12);
  EXPECT_NEAR(lit("void WGMDfunc M 13 void 0 0 0 void .3 0 0 void 0 0 1 . 0 9 0 0 0 0 0 0 0 0 0\n"), .3,
              1e-12);
  EXPECT_NEAR(lit("void WGMDfunc M 13 void 0 0 0 void .3 .1 .1 void 0 1 0 . 0 9 0 0 0 0 0 0 0 0 0\n"), 0,
              1e-12);
  EXPECT_NEAR(lit("void WGMDfunc M 13 void .3 0 0 void 0 0 0 void 0 0 1 . 0 9 0 0 0 0 0 0 1 1 1\n"), 0,
              1e-12);
}

// -i gives the irradiance of opaque surfaces. Transparent ones are passed, here into the void (rtrace -i).
TEST_F(FunctionMaterials, AreMeteredUnlessTransparent) {
  const auto irradiance = [](const std::string& material) {
    Traced scene(material +
                     "void light L 0 0 3 9 9 9\nM polygon pane 0 0 12 -1 -1 1 1 -1 1 1 1 1 -1 1 1\n"
                     "L source sun 0 0 4 1 0 1 2\n",
                 plain(), IrradianceAt::surface);
    return scene.value(V3d(0, 0, 2), V3d(0, 0, -1));
  };
  // The sun's solid angle, radiance and cosine, and pi times the ambient value.
  const double lit = 9 * 2 * std::numbers::pi * (1 - std::cos(std::numbers::pi / 180)) / std::sqrt(2.) +
                     .1 * std::numbers::pi;
  EXPECT_NEAR(irradiance("void plastic2 M 4 1 0 0 . 0 6 0 0 0 0 .1 .1\n"), lit, 1e-6);
  EXPECT_NEAR(irradiance("void transfunc M 2 told scattering.cal 0 6 0 0 0 0 1 1\n"), lit, 1e-6);
  EXPECT_NEAR(irradiance("void BRTDfunc M 10 .1 0 0 0 0 0 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0\n"), lit, 1e-6);
  EXPECT_EQ(irradiance("void BRTDfunc M 10 0 0 0 0 .1 0 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0\n"), 0);
  EXPECT_EQ(irradiance("void trans2 M 4 1 0 0 . 0 8 0 0 0 0 .1 .1 .5 .5\n"), 0);
  EXPECT_EQ(irradiance("void WGMDfunc M 13 void 0 0 0 void .3 .1 .1 void 0 1 0 . 0 9 0 0 0 0 0 0 0 0 0\n"),
            0);
}

// -bv-: all materials but BRTDfunc are invisible from behind.
TEST_F(FunctionMaterials, BacksMayBeInvisible) {
  RayOptions o = plain();
  o.backFacesVisible = false;
  const auto from = [&](const std::string& material, double side) {
    Traced scene(material + "M polygon pane 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n", o);
    return scene.value(V3d(0, 0, side), V3d(0, 0, -side));
  };
  for (const char* material :
       {"void plastic2 M 4 1 0 0 . 0 6 .5 .5 .5 0 .1 .1\n",
        "void ashik2 M 4 1 0 0 . 0 8 .5 .5 .5 0 0 0 9 9\n",
        "void metfunc M 2 told scattering.cal 0 4 .5 .5 .5 0\n",
        "void WGMDfunc M 13 void 0 0 0 void 0 0 0 void 0 0 1 . 0 9 .5 .5 .5 .5 .5 .5 0 0 0\n"}) {
    EXPECT_NEAR(from(material, 1), .05, 1e-12) << material;
    EXPECT_EQ(from(material, -1), 0) << material;
  }
  EXPECT_NEAR(from("void BRTDfunc M 10 0 0 0 0 0 0 0 0 0 . 0 9 .5 .5 .5 .2 .2 .2 0 0 0\n", -1), .02, 1e-12);
}

// ---- errors

std::string errorOf(const std::string& material) {
  try {
    Traced scene(material +
                     "\nvoid light L 0 0 3 9 9 9\nL source sun 0 0 4 0 0 1 2\n"
                     "M polygon pane 0 0 12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n",
                 plain());
    scene.value(V3d(0, 0, 1), V3d(0, 0, -1));
  } catch (const rad::Error& e) {
    return e.what();
  }
  return "";
}

TEST_F(FunctionMaterials, NameTheirFaultsWithTheirPlace) {
  const auto expectError = [](const char* material, const char* text) {
    const std::string error = errorOf(material);
    EXPECT_EQ(error.find("room.rad:1"), 0u) << material << ": " << error;
    EXPECT_NE(error.find(text), std::string::npos) << material << ": " << error;
  };
  expectError("void plastic2 M 4 0 0 1 . 0 5 1 1 1 1 1", "expected 6 real arguments, got 5");
  expectError("void trans2 M 4 0 0 1 . 0 6 1 1 1 1 1 1", "expected 8 real arguments, got 6");
  expectError("void metal2 M 3 0 0 1 0 6 1 1 1 1 1 1", "expected at least 4 string arguments, got 3");
  expectError("void metal2 M 4 0 0 1 . 0 6 1 1 1 1 .1 0", "roughness too small");
  expectError("void metal2 M 4 0 0 up . 0 6 1 1 1 1 .1 .1", "up");
  expectError("void metal2 M 6 0 0 1 . -rz x 0 6 1 1 1 1 .1 .1", "bad transform");
  expectError("void ashik2 M 4 0 0 1 . 0 8 1 1 1 1 1 1 -1 5", "specular powers must be above -1");
  expectError("void ashik2 M 4 0 0 1 . 0 6 1 1 1 1 1 1", "expected 8 real arguments, got 6");
  expectError("void plasfunc M 1 f 0 4 1 1 1 1", "expected at least 2 string arguments, got 1");
  expectError("void plasfunc M 2 f . 0 4 1 1 1 1", "f");
  expectError("void plasfunc M 2 f nowhere.cal 0 4 1 1 1 1", "nowhere.cal");
  expectError("void transfunc M 2 told scattering.cal 0 5 1 1 1 1 1",
              "expected at least 6 real arguments, got 5");
  expectError("void metdata M 4 noop nowhere.dat . height 0 4 1 1 1 1",
              "cannot find data file \"nowhere.dat\"");
  expectError("void metdata M 4 noop plane.dat scattering.cal height 0 4 1 1 1 1",
              "expected at least 5 string arguments, with a coordinate for each dimension, got 4");
  expectError("void BRTDfunc M 9 0 0 0 0 0 0 0 0 0 0 9 0 0 0 0 0 0 0 0 0",
              "expected at least 10 string arguments");
  expectError("void BRTDfunc M 10 0 0 0 0 0 0 f f f . 0 9 0 0 0 0 0 0 0 0 0", "f");
  expectError("void WGMDfunc M 12 void 0 0 0 void 0 0 0 void 0 0 1 0 9 0 0 0 0 0 0 0 0 0",
              "at least 13 string");
  expectError("void WGMDfunc M 13 void 0 0 0 void 0 0 0 void 0 0 1 . 0 8 0 0 0 0 0 0 0 0", "at least 9 real");
  expectError("void WGMDfunc M 13 paint .1 0 0 void 0 0 0 void 0 0 1 . 0 9 0 0 0 0 0 0 0 0 0",
              "undefined modifier \"paint\"");
  // A component with a share of 0 needs no modifier.
  EXPECT_EQ(errorOf("void WGMDfunc M 13 paint 0 0 0 paint 0 0 0 paint 0 0 1 . 0 9 0 0 0 0 0 0 0 0 0"), "");
  // A function that is never evaluated need not exist.
  EXPECT_EQ(errorOf("void BRTDfunc M 10 0 0 0 0 0 0 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0"), "");
}

}  // namespace
}  // namespace rsphere::function_materials_test
