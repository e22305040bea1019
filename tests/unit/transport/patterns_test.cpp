#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "rays/ray_report.h"
#include "scene/build_scene.h"
#include "tests/unit/transport/transport_fixture.h"

// Patterns, textures and mixtures: every type against values of the original, and errors in their
// files and arguments.
namespace rsphere::patterns_test {
namespace {

// Library files are those of tests/scenes/patterns.
class Patterns : public testing::Test {
 protected:
  void SetUp() override { setenv("RAYPATH", (std::string(RSPHERE_TESTS) + "/scenes/patterns").c_str(), 1); }
  void TearDown() override { unsetenv("RAYPATH"); }
};

struct Shot {
  V3d origin, direction;
};
const std::array<Shot, 8> kShots = {{{{-.33, .42, 3.2}, {3.3, -.66, -3.2}},
                                     {{.05, .61, 3.2}, {-2.26, -.53, -3.2}},
                                     {{.91, 2.05, 3.2}, {-3.75, -3.43, -3.2}},
                                     {{-2.87, 2.17, 3.2}, {4.22, -5.38, -3.2}},
                                     {{3.38, 3.25, 3.2}, {-2.3, -2.44, -3.2}},
                                     {{-2.4, -3.39, 3.2}, {2.6, .31, -3.2}},
                                     {{-2.17, -1.81, 3.2}, {1.89, 1.79, -1.2}},
                                     {{-.42, 2.4, 3.2}, {.43, -2.32, -1.2}}}};

// The output of rtrace -h -w -ab 0 -dj 0 -dt 0 -ds 0 -st 0 -lw 0 -lr 6 (RADIANCE 6.1a, with its own
// rayinit.cal) for kShots in tests/scenes/patterns. The scene is the text, kFloor, and kSky if sky is set.
struct Figures {
  const char* name;
  const char* text;
  bool sky;
  double values[8][3];
};
constexpr const char* kFloor =
    "M polygon floor\n0\n0\n12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\nM sphere ball\n0\n0\n4 0 0 2 .7\n";
constexpr const char* kSky =
    "void brightfunc slope\n2 .6+.3*Dx+.2*Dy+.4*Dz .\n0\n0\nslope glow shine\n0\n0\n4 1 2 3 0\n"
    "shine source sky\n0\n0\n4 0 0 1 360\n";
constexpr const char* kGlowA = "void glow A\n0\n0\n4 1 0 .5 0\n";

RayOptions plain() {
  RayOptions o;
  o.directThreshold = o.sourceSubstructuring = o.specularThreshold = o.weightLimit = 0;
  o.reflectionLimit = 6;
  return o;
}

std::vector<Figures> figures() {
  // clang-format off
  return {
      {"brightfunc", R"(void brightfunc P
2 wave shading.cal
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.7757368, 0.7757368, 0.7757368}, {0.3616568, 0.3616568, 0.3616568},
        {0.8080807, 0.8080807, 0.8080807}, {0.1673455, 0.1673455, 0.1673455},
        {0.4969777, 0.4969777, 0.4969777}, {0.7320748, 0.7320748, 0.7320748},
        {0.1681507, 0.1681507, 0.1681507}, {0.4747185, 0.4747185, 0.4747185}}},
      {"brightfunc without a file", R"(void brightfunc P
2 Px*Px/9+.1 .
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.1145899, 0.1145899, 0.1145899}, {0.6426778, 0.6426778, 0.6426778},
        {0.9961778, 0.9961778, 0.9961778}, {0.3025, 0.3025, 0.3025}, {0.2296, 0.2296, 0.2296},
        {0.1044444, 0.1044444, 0.1044444}, {0.1389896, 0.1389896, 0.1389896},
        {0.1009481, 0.1009481, 0.1009481}}},
      {"colorfunc", R"(void colorfunc P
4 cr cg cb shading.cal
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.008045, 0.7119243, 0.6419333}, {1.167005, 0.3395329, 0.7618905},
        {1.424977, 0.3600561, 0.7065669}, {1.513924, 0.3754936, 0.6847754},
        {1.159724, 0.3463504, 0.7380786}, {1.242292, 0.3413474, 0.7547859},
        {1.09863, 0.7751343, 0.7916743}, {0.5641314, 1.223505, 0.7996304}}},
      {"colorfunc moved", R"(void colorfunc P
15 cr cg cb shading.cal -s 2 -rz 30 -rx 20 -mx -t 1 2 3
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.04874, 1.114677, 0.5908635}, {0.6913355, 0.6159646, 0.7108207},
        {0.6815761, 0.6262262, 0.6554971}, {1.468886, 0.6339449, 0.6337056},
        {0.4960883, 0.6193733, 0.6870088}, {1.048433, 0.6168718, 0.7037161},
        {0.6688431, 1.018356, 0.7406045}, {0.9308284, 1.100124, 0.7485606}}},
      {"axes of a moved colorfunc", R"(void colorfunc P
15 kr kg kb shading.cal -s 2 -rz 30 -rx 20 -mx -t 1 2 3
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.013397, 1.107138, 1.358248}, {1.013397, 1.107138, 1.358248}, {1.013397, 1.107138, 1.358248},
        {1.013397, 1.107138, 1.358248}, {1.013397, 1.107138, 1.358248}, {1.013397, 1.107138, 1.358248},
        {1.013397, 1.107138, 1.358248}, {1.013397, 1.107138, 1.358248}}},
      {"brightdata", R"(void brightdata P
5 noop d2.dat . Px Py
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.4354137, 0.4354137, 0.4354137}, {0.591772, 0.591772, 0.591772}, {0.22748, 0.22748, 0.22748},
        {0.8478, 0.8478, 0.8478}, {0.306072, 0.306072, 0.306072}, {0.6956, 0.6956, 0.6956},
        {0.7231296, 0.7231296, 0.7231296}, {0.5753211, 0.5753211, 0.5753211}}},
      {"brightdata moved", R"(void brightdata P
9 one d2.dat shading.cal Px Py -rz 20 -s .5
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.6474419, 0.6474419, 0.6474419}, {0.3637671, 0.3637671, 0.3637671},
        {-0.1012387, -0.1012387, -0.1012387}, {0.7761282, 0.7761282, 0.7761282},
        {1.048558, 1.048558, 1.048558}, {0.09017145, 0.09017145, 0.09017145},
        {1.663073, 1.663073, 1.663073}, {1.096523, 1.096523, 1.096523}}},
      {"colordata, one function of all three", R"(void colordata P
9 three one noneg d2.dat d2b.dat d2.dat shading.cal Px Py
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{2.970281, 1.128626, 0.4354137}, {3.201192, 0.734104, 0.591772}, {2.148144, 1.138224, 0.22748},
        {4.08575, 0.59455, 0.8478}, {2.523608, 1.19932, 0.306072}, {3.1416, 0.2592, 0.6956},
        {3.922311, 0.9297926, 0.7231296}, {3.612556, 1.211271, 0.5753211}}},
      {"colordata, functions of all three", R"(void colordata P
9 red three blue d2.dat d2b.dat d2.dat shading.cal Px Py
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.4354137, 2.970281, 0.4354137}, {0.591772, 3.201192, 0.591772}, {0.22748, 2.148144, 0.22748},
        {0.8478, 4.08575, 0.8478}, {0.306072, 2.523608, 0.306072}, {0.6956, 3.1416, 0.6956},
        {0.7231296, 3.922311, 0.7231296}, {0.5753211, 3.612556, 0.5753211}}},
      {"colordata of one axis", R"(void colordata P
12 clip_r clip_g clip_b d1.dat d1.dat d1.dat . Px -t .5 0 0
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.345878, 0.345878, 0.345878}, {0.2353333, 0.2353333, 0.2353333}, {0, 0, 0}, {0.64, 0.64, 0.64},
        {0.532, 0.532, 0.532}, {0.4, 0.4, 0.4}, {0.6641244, 0.6641244, 0.6641244},
        {0.4974575, 0.4974575, 0.4974575}}},
      {"colorpict", R"(void colorpict P
7 red green blue small.hdr . Px/4+.5 Py/4+.5
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.38764, 0.4347606, 0.5517277}, {0.01370054, 0.3406877, 0}, {0.5230603, 1.378012, 0.4776079},
        {0.6243824, 0.6245282, 0.6430134}, {0.3523518, 1.042427, 0.6731632},
        {0.3764078, 0.4175012, 0.08054553}, {0.1819544, 0.9639698, 0.3167768},
        {0.1835862, 0.2728634, 0.2892144}}},
      {"colorpict moved", R"(void colorpict P
13 three one grey small.hdr shading.cal Px/2 Py/2 -s 1.5 -t -2 -1 0
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{5.165514, 1.805278, 0.8303666}, {2.408905, 1.421723, 0.607167}, {8.159428, 0.9459895, 0.5207519},
        {0.7185946, 0.1901035, 0.03058098}, {2.27112, 1.365608, 0.5524669},
        {0.6736366, 0.548668, 0.1507931}, {7.228348, 2.982731, 1.318182}, {2.542557, 0.8024315, 0.3648413}}},
      {"brighttext", R"(void brighttext P
2 two.fnt lines.txt
0
11 -3.9 3.9 0 1.6 .02 0 .05 -2.5 0 1.5 .25
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}, {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25},
        {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}}},
      {"brighttext spaced", R"(void brighttext P
2 two.fnt lines.txt
0
12 -3.9 3.9 0 1.6 .02 0 .05 -2.5 0 1.5 .25 .3
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25},
        {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}}},
      {"brighttext squeezed", R"(void brighttext P
2 two.fnt lines.txt
0
12 -3.9 3.9 0 1.6 .02 0 .05 -2.5 0 1.5 .25 -.3
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}, {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25},
        {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {0.25, 0.25, 0.25}}},
      {"brighttext of a line", R"(void brighttext P
3 two.fnt . BBAAB
0
11 -3.9 3.9 0 1.6 .02 0 .05 -7.5 0 1.5 .25
P glow M
0
0
4 1 1 1 0
)", false,
       {{1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {1.5, 1.5, 1.5}, {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25},
        {1.5, 1.5, 1.5}, {0.25, 0.25, 0.25}, {1.5, 1.5, 1.5}}},
      {"colortext", R"(void colortext P
2 two.fnt lines.txt
0
15 -3.9 3.9 0 1.6 .02 0 .05 -2.5 0 1 .5 .2 .1 .3 .7
P glow M
0
0
4 1 1 1 0
)", false,
       {{1, 0.5, 0.2}, {0.1, 0.3, 0.7}, {0.1, 0.3, 0.7}, {1, 0.5, 0.2}, {0.1, 0.3, 0.7}, {1, 0.5, 0.2},
        {0.1, 0.3, 0.7}, {0.1, 0.3, 0.7}}},
      {"texfunc", R"(void texfunc P
4 tx ty tz shading.cal
0
2 1 .5
P metal M
0
0
5 .9 .8 .7 1 0
)", true,
       {{0.6202405, 1.167684, 1.64233}, {0.8519959, 1.515046, 1.989151}, {0.3705934, 0.6647884, 0.8825848},
        {0.7954215, 1.426018, 1.891788}, {0.3625914, 0.6485253, 0.8578016},
        {0.9874872, 1.760537, 2.319149}, {0.3707104, 0.6591215, 0.8652333}, {0.8155547, 1.449904, 1.903048}}},
      {"texfunc moved", R"(void texfunc P
15 tx ty tz shading.cal -s 2 -rz 30 -rx 20 -mx -t 1 2 3
0
2 1 .5
P metal M
0
0
5 .9 .8 .7 1 0
)", true,
       {{0.7009912, 1.334674, 1.901047}, {0.6608486, 1.175721, 1.544618}, {0.4812649, 0.8599529, 1.136064},
        {0.7385346, 1.364701, 1.8785}, {0.4652523, 0.8300317, 1.094338}, {1.004069, 1.786074, 2.346014},
        {0.3674758, 0.6534298, 0.8578619}, {0.707866, 1.258454, 1.651764}}},
      {"texdata", R"(void texdata P
9 xx yy zz d2.dat d2b.dat d2.dat shading.cal Px Py
0
0
P metal M
0
0
5 .9 .8 .7 1 0
)", true,
       {{0.7022892, 1.291066, 1.76633}, {0.6918168, 1.230737, 1.61676}, {0.428219, 0.7664171, 1.014594},
        {0.7347165, 1.322754, 1.764114}, {0.5360152, 0.7567241, 0.7653505},
        {0.9991092, 1.778819, 2.339129}, {0.3293742, 0.5856244, 0.7687504}, {0.8180251, 1.454282, 1.908771}}},
      {"texfunc and colorfunc", R"(void texfunc T
4 tx ty tz shading.cal
0
2 1 .5
T colorfunc P
4 cr cg cb shading.cal
0
0
P metal M
0
0
5 .9 .8 .7 1 0
)", true,
       {{0.622876, 0.9999154, 1.368635}, {0.9939924, 0.5167077, 1.516759},
        {0.5166978, 0.2736622, 0.6471973}, {1.176606, 0.6025409, 1.346239},
        {0.4176897, 0.2476679, 0.64698}, {1.221291, 0.6306187, 1.767027},
        {0.4072376, 0.5110711, 0.6852102}, {0.4601371, 1.773907, 1.521814}}},
      {"texfunc on glass", R"(void texfunc P
4 tx ty tz shading.cal
0
2 1 .5
P glass M
0
0
3 .9 .8 .7
)", true,
       {{0.4677464, 0.826298, 1.127025}, {0.1283442, 0.2304186, 0.3087983}, {0.1426, 0.2526188, 0.3343695},
        {0.4343352, 0.7630249, 0.9969949}, {0.1061834, 0.1886084, 0.2503788},
        {0.4153155, 0.7316877, 0.9564708}, {0.5791514, 0.813032, 0.8268045},
        {0.3528569, 0.5207117, 0.5704135}}},
      {"a pattern before the material", R"(void glow G
0
0
4 1 1 1 0
G brightfunc M
2 wave shading.cal
0
0
)", false,
       {{0.7757368, 0.7757368, 0.7757368}, {0.3616568, 0.3616568, 0.3616568},
        {0.8080807, 0.8080807, 0.8080807}, {0.1673455, 0.1673455, 0.1673455},
        {0.4969777, 0.4969777, 0.4969777}, {0.7320748, 0.7320748, 0.7320748},
        {0.1681507, 0.1681507, 0.1681507}, {0.4747185, 0.4747185, 0.4747185}}},
      {"mixfunc", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixfunc M
4 A B soft shading.cal
0
0
)", false,
       {{0.5492424, 0.9015153, 0.3873106}, {0.4679314, 1.064137, 0.3669828},
        {0.6458256, 0.7083489, 0.4114564}, {0.5333473, 0.9333054, 0.3833368},
        {0.8193954, 0.3612093, 0.4548488}, {0.4938856, 1.012229, 0.3734714},
        {0.5867145, 0.8265709, 0.3966786}, {0.4727413, 1.054517, 0.3681853}}},
      {"mixfunc with holes", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixfunc M
4 A void hole shading.cal
0
0
)", true,
       {{1, 0, 0.5}, {1, 0, 0.5}, {0.08531491, 0.1706298, 0.2559447}, {1, 0, 0.5},
        {0.06969179, 0.1393836, 0.2090754}, {0.4940684, 0.9881368, 1.482205}, {1, 0, 0.5}, {1, 0, 0.5}}},
      {"mixfunc with soft holes", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixfunc M
4 void B soft shading.cal
0
0
)", true,
       {{0.07568061, 1.375326, 0.3800374}, {0.03645334, 1.137044, 0.2423772},
        {0.05509855, 0.8185461, 0.2538393}, {0.243002, 1.419309, 0.8456693},
        {0.05710513, 0.4754195, 0.2164665}, {0.2440132, 1.500255, 0.8585684},
        {0.1327233, 1.411568, 0.541435}, {0.04469473, 1.275218, 0.2823128}}},
      {"mixfunc of mixfunc", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixfunc N
4 A void hole shading.cal
0
0
void mixfunc M
4 N B soft shading.cal
0
0
)", true,
       {{0.5492424, 0.9015153, 0.3873106}, {0.4679314, 1.064137, 0.3669828},
        {0.05509855, 0.8185461, 0.2538393}, {0.5333473, 0.9333054, 0.3833368},
        {0.05710513, 0.4754195, 0.2164665}, {0.2440132, 1.500255, 0.8585684},
        {0.5867145, 0.8265709, 0.3966786}, {0.4727413, 1.054517, 0.3681853}}},
      {"mixfunc before a material", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
A mixfunc M
4 void void hole shading.cal
0
0
)", false,
       {{1, 0, 0.5}, {1, 0, 0.5}, {1, 0, 0.5}, {1, 0, 0.5}, {1, 0, 0.5}, {1, 0, 0.5}, {1, 0, 0.5},
        {1, 0, 0.5}}},
      {"mixfunc of patterns", R"(void brightfunc F
2 wave shading.cal
0
0
void colorfunc G
4 cr cg cb shading.cal
0
0
void mixfunc P
4 F G soft shading.cal
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{0.8804517, 0.7469729, 0.7154239}, {0.7901571, 0.3498854, 0.5746086},
        {1.02657, 0.6494018, 0.7721271}, {0.7957299, 0.2644784, 0.4088055},
        {0.6166728, 0.4697737, 0.5405216}, {0.9903031, 0.534322, 0.7435692},
        {0.5527043, 0.4190082, 0.4258439}, {0.5218622, 0.869523, 0.6460311}}},
      {"mixfunc of a texture", R"(void texfunc T
4 tx ty tz shading.cal
0
2 1 .5
void mixfunc P
4 T void soft shading.cal
0
0
P metal M
0
0
5 .9 .8 .7 1 0
)", true,
       {{0.6451856, 1.204369, 1.67755}, {0.7539997, 1.341081, 1.761244}, {0.4048441, 0.7251862, 0.9610261},
        {0.7626396, 1.368695, 1.818166}, {0.3961847, 0.707846, 0.9349841}, {1.005712, 1.79107, 2.356071},
        {0.3339369, 0.5937328, 0.7793878}, {0.8174001, 1.453157, 1.907271}}},
      {"mixfunc of metal and glow", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void metal K
0
0
5 .9 .8 .7 1 0
void mixfunc M
4 K B soft shading.cal
0
0
)", true,
       {{0.3748672, 1.593987, 1.065503}, {0.3057214, 1.608087, 0.8477023}, {0.2987219, 1.24245, 0.7946815},
        {0.3849035, 1.625197, 1.037629}, {0.0584202, 1.42486, 0.2351761}, {0.4952553, 1.893651, 1.28503},
        {0.1652369, 1.120358, 0.4889714}, {0.3827757, 1.73501, 1.024967}}},
      {"mixdata", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixdata M
7 A B one d2.dat shading.cal Px Py
0
0
)", false,
       {{0.9708275, 0.05834502, 0.4927069}, {1, 0, 0.5}, {0.55496, 0.89008, 0.38874}, {1, 0, 0.5},
        {0.712144, 0.575712, 0.428036}, {1, 0, 0.5}, {1, 0, 0.5}, {1, 0, 0.5}}},
      {"mixpict", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixpict M
7 A B grey small.hdr . Px/4+.5 Py/4+.5
0
0
)", false,
       {{0.4298509, 1.140298, 0.3574627}, {0.21873, 1.56254, 0.3046825}, {1, 0, 0.5},
        {0.6256876, 0.7486248, 0.4064219}, {0.8355735, 0.328853, 0.4588934},
        {0.3847699, 1.23046, 0.3461925}, {0.7147324, 0.5705352, 0.4286831}, {0.250258, 1.499484, 0.3125645}}},
      {"mixtext", R"(void glow A
0
0
4 1 0 .5 0
void glow B
0
0
4 0 2 .25 0
void mixtext M
4 A B two.fnt lines.txt
0
9 -3.9 3.9 0 1.6 .02 0 .05 -2.5 0 
)", false,
       {{1, 0, 0.5}, {0, 2, 0.25}, {0, 2, 0.25}, {1, 0, 0.5}, {0, 2, 0.25}, {1, 0, 0.5}, {0, 2, 0.25},
        {0, 2, 0.25}}},
      {"no value: the pattern is left out", R"(void brightfunc P
2 bad shading.cal
0
0
P glow M
0
0
4 1 1 1 0
)", false,
       {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}},
      {"a lamp by direction", R"(void brightfunc P
2 2+Dx+Dy .
0
0
P light L
0
0
3 100 90 80
L sphere lamp
0
0
4 1 1 4 .1
void plastic M
0
0
5 .5 .5 .5 0 0
)", false,
       {{0.441925, 0.3977325, 0.35354}, {0.03947971, 0.03553174, 0.03158377}, {0, 0, 0},
        {0.0270525, 0.02434725, 0.021642}, {0.06310663, 0.05679597, 0.05048531},
        {0.02963737, 0.02667364, 0.0237099}, {0, 0, 0}, {0.1362782, 0.1226504, 0.1090226}}},
      {"a lamp by length, through glass", R"(void brightfunc P
2 1+Ts/10+T/100 .
0
0
P light L
0
0
3 100 90 80
L sphere lamp
0
0
4 1 1 4 .1
void plastic M
0
0
5 .5 .5 .5 0 0
void glass K
0
0
3 .9 .9 .9
K polygon pane
0
0
12 -4 -4 3.5 4 -4 3.5 4 4 3.5 -4 4 3.5
)", false,
       {{0.1551957, 0.1396761, 0.1241565}, {0.01832519, 0.01649267, 0.01466015}, {0, 0, 0},
        {0.01379855, 0.0124187, 0.01103884}, {0.0379532, 0.03415788, 0.03036256},
        {0.01383901, 0.01245511, 0.01107121}, {0, 0, 0}, {0.05078951, 0.04571056, 0.04063161}}},
      {"a luminaire", R"(void brightdata P
9 corrected d2.dat shading.cal lampx lampy -t 1 1 3
0
4 1.5 .8 .5 .1
P light L
0
0
3 100 90 80
L polygon lamp
0
0
12 .6 .8 2.9 .6 1.2 2.9 1.4 1.2 2.9 1.4 .8 2.9
void plastic M
0
0
5 .5 .5 .5 0 0
)", false,
       {{4.036849, 3.633163, 3.229479}, {0, 0, 0}, {0, 0, 0}, {0.09101333, 0.081912, 0.07281066},
        {0.6492739, 0.5843465, 0.5194191}, {0.09938196, 0.08944377, 0.07950557}, {0, 0, 0},
        {1.386374, 1.247737, 1.109099}}},
  };
  // clang-format on
}

TEST_F(Patterns, AreTheOriginals) {
  for (const Figures& f : figures()) {
    Traced scene(f.text + std::string(kFloor) + (f.sky ? kSky : ""), plain());
    for (size_t i = 0; i < kShots.size(); ++i) {
      const Color got = scene.color(kShots[i].origin, kShots[i].direction);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got[c], f.values[i][c], 2e-6 + 2e-6 * std::abs(f.values[i][c]))
            << f.name << ", ray " << i << ", channel " << c;
    }
  }
}

// Seen from behind, a surface keeps its front: in the world, textures perturb the normal in the same
// direction from both sides.
TEST_F(Patterns, TextureIsTheFrontsWhicheverSideIsSeen) {
  const std::string head = "void texfunc T\n4 .2 .1 0 .\n0\n0\nT metal M\n0\n0\n5 1 1 1 1 0\n";
  const std::string up = "M polygon p\n0\n0\n9 -9 -9 0 9 -9 0 0 9 0\n";
  const std::string down = "M polygon p\n0\n0\n9 0 9 0 9 -9 0 -9 -9 0\n";
  Traced front(head + up), back(head + down);
  const auto normal = [](Traced& t) {
    return answerOf(t.scene(), t.tracer().trace(V3d(0, 0, 1), V3d(0, 0, -1), 0, 1)).normal;
  };
  // The sum with the front's normal, then turned to the ray: up, (.2, .1, 1); down, -(.2, .1, -1).
  const V3d a = normal(front), b = normal(back);
  EXPECT_NEAR((a - V3d(.2, .1, 1).normalized()).length(), 0, 1e-12);
  EXPECT_NEAR((b - V3d(-.2, -.1, 1).normalized()).length(), 0, 1e-12);
}

std::string errorOf(const std::string& text, rad::Status* status = nullptr) {
  try {
    Traced scene(text + kFloor);
    scene.value(V3d(3, 3, 3), V3d(0, 0, -1));
  } catch (const rad::Error& e) {
    if (status) *status = e.status();
    return e.what();
  }
  return "no error";
}

TEST_F(Patterns, WhatIsMissingIsSaidWithThePlaceWhenARayMeetsIt) {
  struct Fault {
    const char* text;
    const char* message;
    rad::Status status;
  };
  const Fault faults[] = {
      {"void brightfunc P\n2 x none.cal\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brightfunc \"P\": cannot find function file \"none.cal\"", rad::Status::system},
      {"void colorfunc P\n4 x x x none.cal\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: colorfunc \"P\": cannot find function file \"none.cal\"", rad::Status::system},
      {"void colordata P\n8 f f f d1.dat d1.dat d1.dat none.cal Px\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: colordata \"P\": cannot find function file \"none.cal\"", rad::Status::system},
      {"void colorpict P\n7 f f f p.hdr none.cal Px Py\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: colorpict \"P\": cannot find function file \"none.cal\"", rad::Status::system},
      {"void brightdata P\n4 noop none.dat . Px\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brightdata \"P\": cannot find data file \"none.dat\"", rad::Status::system},
      {"void colorpict P\n7 red green blue none.hdr . Px Py\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: colorpict \"P\": cannot find picture file \"none.hdr\"", rad::Status::system},
      {"void brighttext P\n2 none.fnt lines.txt\n0\n11 0 0 0 1 0 0 0 1 0 1 2\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brighttext \"P\": cannot find font file \"none.fnt\"", rad::Status::system},
      {"void brighttext P\n2 two.fnt none.txt\n0\n11 0 0 0 1 0 0 0 1 0 1 2\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brighttext \"P\": cannot find text file \"none.txt\"", rad::Status::system},
      {"void brighttext P\n2 two.fnt lines.txt\n0\n11 0 0 0 1 0 0 2 0 0 1 2\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brighttext \"P\": illegal motion vector", rad::Status::input},
      {"void brightdata P\n4 noop d2.dat . Px\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brightdata \"P\": expected at least 5 string arguments, with a coordinate for each "
       "dimension, "
       "got 4",
       rad::Status::input},
      {"void brightfunc P\n4 Px . -t 1\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n",
       "room.rad:1: brightfunc \"P\": bad transform", rad::Status::input},
      {"void colordata P\n10 red green blue d2.dat d1.dat d2.dat . Px Py -i\n0\n0\nP glow M\n0\n0\n4 1 1 1 "
       "0\n",
       "room.rad:1: colordata \"P\": the data files differ in their number of dimensions",
       rad::Status::input},
      {"void plastic Q\n0\n0\n5 1 1 1 0 0\nQ plastic M\n0\n0\n5 1 1 1 0 0\n",
       "room.rad:1: plastic \"Q\": conflicting material", rad::Status::input},
      {"void plastic Q\n0\n0\n5 1 1 1 0 0\nQ mixfunc M\n4 Q Q .5 .\n0\n0\n",
       "room.rad:5: mixfunc \"M\": inappropriate modifier", rad::Status::input},
  };
  for (const Fault& f : faults) {
    rad::Status status = rad::Status::signal;
    const std::string_view message(f.message), file = message.substr(message.rfind(' ') + 1);
    const bool isMissing = message.find("cannot find") != message.npos;
    EXPECT_EQ(errorOf(f.text, &status),
              f.message + (isMissing ? rad::FileAccess().remark(file.substr(1, file.size() - 2), true) : ""));
    EXPECT_EQ(status, f.status) << f.message;
  }
  EXPECT_EQ(errorOf("void brightfunc P\n2 x none.cal\n0\n0\nvoid glow M\n0\n0\n4 1 1 1 0\n"), "no error")
      << "no surface uses it";
}

TEST_F(Patterns, WarnsOnceOfWhatHasNoValue) {
  const Scene scene =
      sceneOf(std::string("void brightfunc P\n2 1/(Px*0) .\n0\n0\nP glow M\n0\n0\n4 1 1 1 0\n") + kFloor);
  std::vector<std::string> warnings;
  const Transport transport(scene, {}, IrradianceAt::none, false,
                            [&](std::string_view text) { warnings.emplace_back(text); });
  PathTracer tracer = transport.pathTracer();
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(tracer.trace(V3d(3, 3, 3), V3d(0, 0, -1), 0, 1).value.color.x, 1) << "left out";
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "room.rad:1: brightfunc \"P\": compute error: division by zero: ignored at such points; the "
            "function can exclude them with if()");
}

// The meter of -i ignores patterns. A texture before the material still tilts it.
TEST_F(Patterns, IrradianceIgnoresPatterns) {
  const std::string sky = "void glow g\n0\n0\n4 1 1 1 0\ng source sky\n0\n0\n4 0 0 1 360\n";
  const std::string chain = "void brightfunc P\n2 .3 .\n0\n0\nP plastic Q\n0\n0\n5 .5 .5 .5 0 0\n";
  Traced behind(chain + "Q mixfunc M\n4 void void 1 .\n0\n0\n" + kFloor + sky, unbiased(1),
                IrradianceAt::surface);
  Traced before(
      "void plastic Q\n0\n0\n5 .5 .5 .5 0 0\nQ brightfunc M\n2 .3 .\n0\n0\n" + std::string(kFloor) + sky,
      unbiased(1), IrradianceAt::surface);
  EXPECT_NEAR(behind.value(V3d(3, 3, 1), V3d(0, 0, -1)), 3.14159265, .2);
  EXPECT_NEAR(before.value(V3d(3, 3, 1), V3d(0, 0, -1)), 3.14159265, .2);
}

TEST_F(Patterns, ThreadsMeetAModifierForTheFirstTimeTogether) {
  for (int round = 0; round < 20; ++round) {
    const Scene scene =
        sceneOf(std::string("void colorpict P\n7 red green blue small.hdr . Px/4+.5 Py/4+.5\n0\n0\n"
                            "P mixfunc N\n4 void void wave shading.cal\n0\n0\nN glow M\n0\n0\n4 1 1 1 0\n") +
                kFloor);
    const Transport transport(scene, {}, IrradianceAt::none);
    PathTracer alone = transport.pathTracer();
    std::array<double, 4> values{};
    std::vector<std::thread> threads;
    std::atomic<int> waiting = 4;
    for (size_t i = 0; i < values.size(); ++i)
      threads.emplace_back([&, i] {
        PathTracer tracer = transport.pathTracer();
        --waiting;
        while (waiting > 0) std::this_thread::yield();
        values[i] = tracer.trace(V3d(1, 1.5, 3), V3d(0, 0, -1), 0, 1).value.color.x;
      });
    for (std::thread& t : threads) t.join();
    for (double v : values) EXPECT_EQ(v, alone.trace(V3d(1, 1.5, 3), V3d(0, 0, -1), 0, 1).value.color.x);
  }
}

TEST_F(Patterns, MixtureWithoutAMaterialBehindItIsTheMaterial) {
  const Scene scene = sceneOf(std::string(kGlowA) + "void mixfunc M\n4 A void .5 .\n0\n0\n" + kFloor);
  EXPECT_EQ(scene.materialName(scene.surfaces.at(0)), "M");
  EXPECT_EQ(scene.materialOf(scene.surfaces.at(0)), nullptr);
  const Scene behind = sceneOf(std::string(kGlowA) + "A mixfunc M\n4 void void .5 .\n0\n0\n" + kFloor);
  EXPECT_EQ(behind.materialName(behind.surfaces.at(0)), "A");
  const Scene none = sceneOf(std::string("void brightfunc M\n2 .5 .\n0\n0\n") + kFloor);
  EXPECT_EQ(none.materialName(none.surfaces.at(0)), "void");
}

// A goal emits whatever its modifiers are: a plastic surface beside a goal with a mixture receives
// importance from it.
TEST_F(Patterns, GoalMayBeAMixture) {
  const std::string text =
      "void plastic Q\n0\n0\n5 .5 .5 .5 0 0\nvoid mixfunc G\n4 Q void .5 .\n0\n0\n"
      "Q polygon floor\n0\n0\n12 -4 -4 0 4 -4 0 4 4 0 -4 4 0\n"
      "G polygon goal\n0\n0\n12 -1 -1 2 -1 1 2 1 1 2 1 -1 2\n";
  const std::vector<std::string> goals = {"G"};
  const Scene scene = buildScene(rad::readSceneText(text, "room.rad"), {}, goals);
  const Transport transport(scene, unbiased(), IrradianceAt::none);
  PathTracer tracer = transport.pathTracer();
  EXPECT_EQ(tracer.trace(V3d(.2, .3, 1), V3d(0, 0, 1), 0, 1).value.color.x, 1);
  Sample floor;
  for (uint64_t i = 0; i < 4000; ++i)
    floor.add(tracer.trace(V3d(0, 0, 1), V3d(0, 0, -1), 0, mixBits(i)).value.color.x);
  // .5/pi times the irradiance under the middle of a square, which is 4 / pi times that of a quarter, with
  // a = b = 1/2.
  const double side = 1 / std::sqrt(5.), factor = 4 / 3.14159265358979 * side * std::atan(side);
  EXPECT_NEAR(floor.mean(), .5 * factor, 5 * floor.standardError());
}

// The goal reflects the importance of a second one, which takes random numbers. They depend on the seed, and
// not on the path that was traced before.
TEST_F(Patterns, RaysToAGoalTakeTheRandomNumbersOfTheirSeed) {
  const std::string text =
      "void plastic G\n0\n0\n5 .5 .5 .5 0 0\n"
      "G polygon goal\n0\n0\n12 -1 -1 2 -1 1 2 1 1 2 1 -1 2\n"
      "G polygon other\n0\n0\n12 -1 -1 0 1 -1 0 1 1 0 -1 1 0\n";
  const std::vector<std::string> goals = {"G"};
  const Scene scene = buildScene(rad::readSceneText(text, "room.rad"), {}, goals);
  const Transport transport(scene, unbiased(), IrradianceAt::none);
  const SourceSample sample{
      .direction = V3d(0, 0, 1), .distance = 1, .normal = V3d(0, 0, -1), .source = LightId(0)};
  const auto toGoal = [&](PathTracer& tracer, uint64_t seed) {
    return tracer.traceToSource(V3d(0, 0, 1), sample, seed).value.color;
  };
  PathTracer fresh = transport.pathTracer(), used = transport.pathTracer();
  used.trace(V3d(.2, .3, 1), V3d(0, 0, -1), 0, 99);
  const Color first = toGoal(fresh, 7);
  EXPECT_EQ(toGoal(used, 7), first);
  EXPECT_NE(toGoal(fresh, 8), first) << "the path takes no random numbers, and the test shows nothing";
}

// A pattern of a distant source is evaluated at the origin of the ray, also if the source is known to be
// visible.
TEST_F(Patterns, RaysToADistantSourceShowItsPatternAtTheirOrigin) {
  const std::string text =
      "void brightfunc p\n2 Px+2 .\n0\n0\np light sun\n0\n0\n3 1 1 1\nsun source s\n0\n0\n4 0 0 1 5\n";
  const Scene scene = buildScene(rad::readSceneText(text, "sky.rad"));
  const Transport transport(scene, unbiased(), IrradianceAt::none);
  PathTracer tracer = transport.pathTracer();
  const V3d point(1, 0, 0), up(0, 0, 1);
  const SourceSample sample{.direction = up, .distance = kFarAway, .normal = -up, .source = LightId(0)};
  EXPECT_EQ(tracer.trace(point, up, 0, 1).value.color.x, 3);
  EXPECT_EQ(tracer.traceToSource(point, sample, 1).value.color.x, 3);
}

TEST_F(Patterns, MixturesNestAsDeepAsMakesSense) {
  const auto nested = [](int depth) {
    std::string text = kGlowA, last = "A";
    for (int i = 0; i < depth; ++i) {
      const std::string name = "m" + std::to_string(i);
      text += "void mixfunc " + name + "\n4 " + last + " void 1 .\n0\n0\n";
      last = name;
    }
    return text + "void mixfunc M\n4 " + last + " void 1 .\n0\n0\n";
  };
  EXPECT_EQ(errorOf(nested(20)), "no error");
  EXPECT_NE(errorOf(nested(2000)).find("modifiers are nested more than 64 deep"), std::string::npos);
}

// -e and -f: rtrace -h -e 'tone(x)=.25*x;noon:2' and -f with the same in a file give 0.5 (RADIANCE 6.1a).
TEST_F(Patterns, SharedDefinitionsAreSeenByAllFunctionFiles) {
  const std::string text =
      "void brightfunc p\n2 tone(noon) .\n0\n0\np glow g\n0\n0\n4 1 1 1 0\ng source all\n0\n0\n4 0 0 1 360\n";
  const auto value = [&](std::vector<SharedDefinitions> definitions) {
    RayOptions options;
    options.definitions = std::move(definitions);
    return Traced(text, options).value(V3d(0, 0, 0), V3d(0, 0, 1));
  };
  EXPECT_EQ(value({{false, "tone(x)=.25*x;noon:2"}}), .5);
  EXPECT_EQ(value({{false, "noon=1"}, {false, "tone(x)=x*noon;noon=3"}}), 9);
  EXPECT_EQ(value({{true, "shared.cal"}, {false, "noon=3"}}), 1.5);
  EXPECT_EQ(value({{false, "noon=3"}, {true, "shared.cal"}}), 1);
  // Definitions of rayinit.cal are replaced.
  EXPECT_EQ(value({{false, "tone(x)=bound(0,x,9);noon=4;bound(a,x,b)=a+x+b"}}), 13);
  const auto fault = [&](SharedDefinitions definitions, rad::Status status) {
    try {
      value({std::move(definitions)});
    } catch (const rad::Error& error) {
      EXPECT_EQ(error.status(), status);
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  EXPECT_NE(fault({true, "absent.cal"}, rad::Status::system).find("absent.cal"), std::string::npos);
  EXPECT_NE(fault({false, "a=1+"}, rad::Status::input).find("-e 'a=1+'"), std::string::npos);
}

}  // namespace
}  // namespace rsphere::patterns_test
