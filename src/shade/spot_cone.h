#pragma once
#include "scene/material.h"

namespace rsphere {

// Whether a point is outside a spotlight's cone. towards: from the point to the light (unit).
inline bool outsideSpot(const Spotlight& spot, const V3d& towards) {
  constexpr double kTwoPi = 6.283185307179586;
  return spot.solidAngle < kTwoPi * (1 + spot.aim.dot(towards));
}

}  // namespace rsphere
