#pragma once
// What the tests of highlights on balls and cylinders have in common: materials, a source, a floor, and
// checks.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace highlight_scene {

inline const std::string kMaterials =
    "void metal chrome 0 0 5 .9 .9 .9 1 .05\nvoid metal mirroring 0 0 5 .9 .9 .9 1 0\n"
    "void plastic matt 0 0 5 .5 .5 .5 0 0\nvoid plastic glossy 0 0 5 .5 .5 .5 .05 .05\n"
    "void light lamp 0 0 3 100 100 100\n";
inline const std::string kBulb = "lamp sphere bulb 0 0 4 3 2.5 2.5 .05\n";
inline const std::string kFloor = "matt polygon floor 0 0 12 0 0 0 4 0 0 4 4 0 0 4 0\n";

// BallHighlights or CylinderHighlights of a scene.
template <class Highlights>
Highlights highlightsOf(const Traced& t) {
  return Highlights(t.scene(), t.prepared().tracer(), t.prepared().lights(), 1e-9);
}

// At a point that sees one highlight above it: those that are too weak are left out, and those that are
// hidden behind the surface.
template <class Highlights>
void expectAimedWhereTheyMatter(const Highlights& highlights, const V3d& point) {
  const V3d up(0, 0, 1);
  typename Highlights::Aim aim;
  highlights.aim(point, up, 0, aim);
  EXPECT_EQ(aim.count, 1u);
  const double mean = aim.mean;
  highlights.aim(point, -up, 0, aim);
  EXPECT_EQ(aim.count, 0u);
  // Met by chance, the highlight is seen in less than one of 1000 directions.
  highlights.aim(point, up, 1000 * mean * mean, aim);
  EXPECT_EQ(aim.count, 1u);
  highlights.aim(point, up, 1e6 * mean * mean, aim);
  EXPECT_EQ(aim.count, 0u);
  EXPECT_EQ(aim.mean, 0);
}

// Gathers on the floor of a room below origin have the same mean whether rays are aimed at highlights or not,
// and less than a third of the error in equal numbers of `paths`. reflectors: text of a scene.
inline void expectMeanOfPathsKept(const std::string& reflectors, const V3d& origin, uint64_t paths) {
  RayOptions options = unbiased(1);
  options.ambientDivisions = 64;
  Traced t(kMaterials + reflectors + kBulb + roomOf("matt", V3d(4, 4, 3)), options);
  PathTracer aimed = t.tracerWith(t.transport().aims());
  const V3d down(0, 0, -1);
  Sample with, without;
  constexpr int kMore = 8;  // times as many without
  for (uint64_t i = 0; i < paths; ++i) with.add(aimed.trace(origin, down, 0, mixBits(i)).value.color.x);
  for (uint64_t i = 0; i < kMore * paths; ++i) without.add(t.value(origin, down, mixBits(i + 1000000)));
  const double error = std::hypot(with.standardError(), without.standardError());
  EXPECT_LT(std::abs(with.mean() - without.mean()), kMostSigmas * error) << reflectors;
  EXPECT_GT(std::abs(1.01 * with.mean() - without.mean()), kMostSigmas * error)
      << "the spoiled twin" << reflectors;
  EXPECT_LT(with.standardError(), without.standardError() * std::sqrt(kMore) / 3) << reflectors;
}

}  // namespace highlight_scene
}  // namespace rsphere
