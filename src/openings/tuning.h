#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// Caps that limit the time of each gather, and the time at start.
struct Caps {
  // Cap on each of the following numbers; the brightest elements are kept:
  // - the openings, the spots and the highlights on balls at which rays from one point are aimed;
  // - the parts of sources whose highlights one ball shows.
  // The cap is half of this for spots of light from openings, and for highlights on cylinders, which cost
  // more. Chosen by experiment: each aimed ray evaluates all their densities. Insensitive.
  static constexpr size_t kAimed = 64;
  // Cap on the panes and holes that are probed, on the balls and cylinders that are examined for highlights,
  // and on the targets of a point that may be fitted (Targets::kFewestFitted); the largest are kept.
  // Insensitive.
  static constexpr size_t kAsked = 1024;
  // Number of rays that measure a mean brightness: on each side of a pane, around a point in sphere mode, and
  // (as a minimum) to each opening that may matter there. Chosen by experiment. A mean is then known within
  // 18% if single values vary as much as their mean.
  // - For panes, changing it by 30% either way increases the time by 30%, because other panes are then
  //   classified as openings.
  // - For points: insensitive.
  RSPHERE_TUNED(Caps, int, kProbes, 32);
};

// Holes in walls (holes.cpp).
struct Holes {
  // Polygons belong to one wall if their normals agree within kSameNormal, and their distances from the
  // scene's corner within kSamePlane times the size of the scene. The tolerances are far above rounding
  // errors, and far below the thickness of a wall.
  static constexpr double kSameNormal = 1e-6, kSamePlane = 1e-5;
  // Grid cells along each side of a wall. The edges of a hole are found to within a cell, which is 16 cm for
  // a door in a wall of 10 m. Errors affect only the variance.
  static constexpr int kCells = 64;
  // Smallest fraction of a hole's outline that borders on the wall. A door, which has the wall on three
  // sides, passes. The space between the legs of a row of desks does not.
  static constexpr double kSurrounded = .6;
  // Cap on the number of walls that are searched, to limit the time at start; the largest are kept.
  static constexpr size_t kMostWalls = 256;
};

// Portals of daylight, at which indirect rays are aimed (find_openings.cpp, openings.cpp).
struct Openings {
  // Panes and holes are ignored if their area is below this fraction of a wall as wide and as high as the
  // scene, because each opening costs time in each gather. Derived: a window of 6 x 6 cm is found in a room
  // of 3 m on a ground of 1 km, and a door of 2 m2 in a city of 10 km by 200 m. Insensitive.
  static constexpr double kLeastArea = 1e-6;
  // A pane or hole is an opening if one side is at least this many times brighter than the other. Typical
  // ratios:
  //   windows by day, which also mirror the bright side   2 to 8
  //   diffusing windows                                   1.6
  //   windows behind sunlit blinds                        1.1
  //   panes between two rooms                             about 1
  // Diffusing windows and windows behind blinds are recognized by the sky that is seen through them
  // (kMoreSky). With 3, two of the four windows of a sunlit classroom are not found, and the noise of sensors
  // from sky light is 2.7 times as large. Without openings, variance x time of gathers is 2.7 to 16 times as
  // large in five daylit rooms (tests/bench/mechanisms/runs/2026-11-29-tails.txt).
  RSPHERE_TUNED(Openings, double, kBrighter, 1.7);
  // Regardless of brightness, one side is the bright side of an opening if two conditions hold: at least
  // kMoreSky times as much unreflected sky light arrives from it as from the other side, and sky light is at
  // least kLeastSky of all light from it. Chosen by experiment. Sunlit blinds beside a pane are as bright as
  // the sky on its other side, but little sky is seen through them. For a hole, light of places under the
  // open sky is sky light, too (an open window below an overhang).
  RSPHERE_TUNED(Openings, double, kMoreSky, 3);
  RSPHERE_TUNED(Openings, double, kLeastSky, .1);
  // Two holes are treated as one opening if they are parallel (cosine of the angle at least kParallel) and
  // the distance between their middles is below kSameHole times the shortest side of both. This finds the two
  // faces of a wall, which are nearer to each other than a door is wide.
  static constexpr double kParallel = .99, kSameHole = .5;
  // A parallel hole is the mouth of a shaft behind an opening if it lies at least kLeastDepth times the
  // shortest side of the opening away, and at most kMostDepth times the longest; if their middles are no
  // farther apart sideways than kSameHole allows; and if the ratio of their areas is at most kWidening.
  // Through less deep reveals, most directions to the panes reach them. Not varied.
  static constexpr double kLeastDepth = .2, kMostDepth = 3, kWidening = 3;
  // Rays are aimed at the image of an opening in a mirror that reflects at least this fraction of the light
  // of all openings. Derived: if one in a thousand unaimed rays finds the light of the mirror, its error with
  // 8192 rays is a third, and thus .3% of all light.
  static constexpr double kLeastMirrored = .01;
  // Coplanar panes are merged into one opening, and the cells of a hole are treated as one opening, if they
  // fill at least this fraction of their bounding rectangle. Most directions towards the rectangle then hit
  // them. With .91, no answer in tests/bench/sensitivity changes.
  static constexpr double kFilled = .5;
  // Panes are widened over gaps beside them by steps of this fraction of their shorter side. Not varied.
  static constexpr double kGapStep = 1. / 64;
};

// Openings as light sources of paths from both ends (portals.cpp).
struct Portals {
  // A hole, or a pane indoors, with less than this fraction of the radiance of the brightest opening is no
  // portal, nor is a hole indoors: paths from the eye find its light. Rays to a false opening, such as a hole
  // in the plane of desk tops, would be lost; as portals, that hole makes the noise 25 instead of .4%, a
  // glass partition 6 instead of 1.5%, mouths of shafts 4 instead of 2%. Panes below an open sky are never
  // false: without them, points that see windows below an overhang by a skylight have 19 instead of 1.7%
  // (2026-11-29-portals.txt, 2026-11-30-lamps.txt, -points.txt).
  RSPHERE_TUNED(Portals, double, kLeastRadiance, .2);
};

}  // namespace rsphere::tuning
