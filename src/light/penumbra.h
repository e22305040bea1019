#pragma once
// Half spaces that bound the light that a source sends through an opening, computed from the exact corners of
// both. These bounds are tighter than a beam (beam.h), which uses only bounding spheres.
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

// Appends half spaces that contain every point reached by a straight ray that starts in the convex hull of
// `from` and then passes the convex hull of `opening`. Each plane separates the two hulls and contains an
// edge of one and a corner of the other (Teller 1992, "Computing the antipenumbra of an area light source",
// SIGGRAPH). Edges join successive corners. Appends none if the hulls overlap. If the hulls touch, rays that
// pass within 1e-12 (relative to the coordinates) of the common points may lie outside.
void addPenumbra(std::span<const V3d> from, std::span<const V3d> opening, std::vector<HalfSpace>& bounds);

// Clips a polygon to all half spaces. Returns corners whose hull contains the remaining part; empty if
// nothing remains. Parts that lie outside by up to 1e-7 of their coordinates are kept.
std::vector<V3d> clipped(std::vector<V3d> corners, std::span<const HalfSpace> bounds);

// True if the box lies outside of the half space by more than the margin of clipped().
bool isOutside(const Box3d& box, const HalfSpace& bound);

}  // namespace rsphere
