#pragma once
#include "scene/shape.h"

namespace rsphere {

// Solid angle, with its sign, of a triangle as seen from a point. Differences of the corners keep their
// digits where the triangle is small or far. Source: Van Oosterom and Strackee 1983, IEEE Trans. Biomed. Eng.
// 30/2.
double triangleSolidAngle(const V3d& a, const V3d& b, const V3d& c, const V3d& point);

// An even map from the square to the spherical triangle. Arvo's construction: first the corner of the
// triangle that holds the share u1 of the area, on the side from a to c; then a point between it and b. The
// corner is found from tan(area / 2) = (a . b x c) / (1 + a.b + b.c + c.a), solved for the half angle from a:
// no difference of angles and pi, which has few digits left where the triangle is small. Source: Arvo,
// "Stratified Sampling of Spherical Triangles" (SIGGRAPH 1995). a, b, c: unit.
V3d sampleTriangle(const V3d& a, const V3d& b, const V3d& c, double solidAngle, double u1, double u2);

}  // namespace rsphere
