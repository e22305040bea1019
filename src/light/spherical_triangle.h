#pragma once
#include "scene/shape.h"

namespace rsphere {

// Signed solid angle (sr) of a triangle as seen from a point. It is computed from differences between the
// corners, which keeps its relative precision for small and for distant triangles. Source: Van Oosterom and
// Strackee 1983, IEEE Trans. Biomed. Eng. 30/2.
double triangleSolidAngle(const V3d& a, const V3d& b, const V3d& c, const V3d& point);

// An area-preserving map from the unit square to the spherical triangle a, b, c (unit vectors). Source: Arvo,
// "Stratified Sampling of Spherical Triangles" (SIGGRAPH 1995). First, c is replaced by the point on the arc
// from a to c for which the triangle has the fraction u1 of its area. Then u2 selects a point on the arc from
// b to that point. Arvo computes it from differences of angles and pi, which loses most digits in small
// triangles. We solve tan(area / 2) = (a . b x c) / (1 + a.b + b.c + c.a) for half its angle from a instead.
V3d sampleTriangle(const V3d& a, const V3d& b, const V3d& c, double solidAngle, double u1, double u2);

}  // namespace rsphere
