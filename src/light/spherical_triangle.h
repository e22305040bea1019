#pragma once
#include "scene/shape.h"

namespace rsphere {

// Signed solid angle (sr) of a triangle as seen from a point. It is computed from the differences of the
// corners, which keeps the relative precision for small and for distant triangles. Source: Van Oosterom and
// Strackee 1983, IEEE Trans. Biomed. Eng. 30/2.
double triangleSolidAngle(const V3d& a, const V3d& b, const V3d& c, const V3d& point);

// An area-preserving map from the unit square to the spherical triangle a, b, c (unit vectors). Source: Arvo,
// "Stratified Sampling of Spherical Triangles" (SIGGRAPH 1995). First the corner c is moved along the arc
// towards a, until the triangle has the share u1 of its area; then u2 selects a point on the arc between this
// corner and b. Unlike Arvo, we find the corner from tan(area / 2) = (a . b x c) / (1 + a.b + b.c + c.a),
// solved for half its angle from a. His difference of angles and pi loses most digits in small triangles.
V3d sampleTriangle(const V3d& a, const V3d& b, const V3d& c, double solidAngle, double u1, double u2);

}  // namespace rsphere
