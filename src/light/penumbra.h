#pragma once
// Half spaces that bound the light of a source behind an opening, from the exact corners of both. They bound
// it more closely than a beam (beam.h), which only knows the spheres around them.
#include <span>
#include <vector>

#include "scene/shape.h"

namespace rsphere {

// The points p with inward . p >= offset.
struct HalfSpace {
  V3d inward{0, 0, 1};  // unit
  double offset = 0;

  // The distance of a point from the plane (world units), positive inside.
  double height(const V3d& p) const { return p.dot(inward) - offset; }
};

// Appends half spaces that contain every point which a straight ray reaches that starts in the hull of `from`
// and then passes the hull of `opening`: their planes separate the two, and hold an edge of one and a corner
// of the other (Teller 1992, "Computing the antipenumbra of an area light source", SIGGRAPH). Edges are those
// between successive corners. Appends none if the hulls overlap. Rays that pass from one to the other within
// 1e-12 of their coordinates, where the two touch, may lie outside.
void addPenumbra(std::span<const V3d> from, std::span<const V3d> opening, std::vector<HalfSpace>& bounds);

// Corners whose hull holds that of the part of a polygon which lies in all half spaces; empty if no point
// does. A part that lies outside by up to 1e-7 of its coordinates is kept.
std::vector<V3d> clipped(std::vector<V3d> corners, std::span<const HalfSpace> bounds);

// Whether no point of a box lies in the half space, by the same margin.
bool isOutside(const Box3d& box, const HalfSpace& bound);

}  // namespace rsphere
