#pragma once
#include "scene/shape.h"

namespace rsphere {

// The unit normal of a sphere at the point where the sphere mirrors `to` towards `point`. The normal lies in
// the plane of both places and the center, and bisects the angle between the directions from the reflecting
// point to both. Its error is at most 1e-4 of the angle between the directions from the center to both.
// point: outside the sphere. to: a place outside the sphere, or a direction (unit) if `distant`.
V3d mirroringNormal(const Sphere& ball, const V3d& point, const V3d& to, bool distant);

}  // namespace rsphere
