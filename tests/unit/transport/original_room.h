#pragma once
#include <array>
#include <string>
#include <vector>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {

// The room in which reference values were computed: oconv room.rad | rtrace -h, RADIANCE 6.1a.
inline const std::string kRoom = R"(
void plastic wall 0 0 5 .57 .51 .5 0 0
wall polygon floor 0 0 12 0 0 0 4 0 0 4 5 0 0 5 0
wall polygon ceiling 0 0 12 0 0 3 0 5 3 4 5 3 4 0 3
wall polygon w1 0 0 12 0 0 0 0 0 3 4 0 3 4 0 0
wall polygon w2 0 0 12 4 0 0 4 0 3 4 5 3 4 5 0
wall polygon w3 0 0 12 4 5 0 4 5 3 0 5 3 0 5 0
wall polygon w4 0 0 12 0 5 0 0 5 3 0 0 3 0 0 0
void plastic gloss 0 0 5 .6 .4 .3 .05 .1
gloss sphere s1 0 0 4 2.0 2.5 .7 .4
)";
inline const std::string kRoomMirrors = R"(
void mirror mir 0 0 3 .9 .94 .9
mir polygon m1 0 0 12 .02 1 .5 .02 4 .5 .02 4 2.5 .02 1 2.5
mir polygon m2 0 0 12 1 4.98 .5 3 4.98 .5 3 4.98 2.5 1 4.98 2.5
mir ring m3 0 0 8 3.9 2 1.5 -1 .2 .1 0 .9
)";
inline const std::string kRoomBall = "void light l 0 0 3 800 700 600\nl sphere lamp 0 0 4 1.6 2.6 2.6 .05\n";

struct OriginalFigure {
  V3d origin, direction;
  Color value;
};

// -ab 0 -dj 0 -dt 0 -ds 0 -ss 0 -st 1 -lr 8 -dr 2 -dp 0
inline RayOptions originalOptions() {
  RayOptions o;
  o.directThreshold = 0;
  o.sourceSubstructuring = 0;
  o.specularSampling = 0;
  o.specularThreshold = 1;
  o.reflectionLimit = 8;
  return o;
}

// Expects agreement within the printed digits and single precision.
inline void expectFigures(const std::string& scene, const std::vector<OriginalFigure>& figures) {
  Traced traced(scene, originalOptions());
  for (const OriginalFigure& f : figures) {
    const Color got = traced.color(f.origin, f.direction);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(got[i], f.value[i], 1e-4 * f.value[i]) << f.origin << " channel " << i;
  }
}

}  // namespace rsphere
