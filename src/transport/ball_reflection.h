#pragma once
#include "scene/shape.h"

namespace rsphere {

// The unit normal of a sphere at the point where it mirrors one place to another, within 1e-4 of the angle
// between the directions from its center to both. It lies in the plane of both places and the center, and
// halves the angle between the directions to both. point: outside the sphere. to: a place outside, or a
// direction (unit) if distant.
V3d mirroringNormal(const Sphere& ball, const V3d& point, const V3d& to, bool distant);

}  // namespace rsphere
