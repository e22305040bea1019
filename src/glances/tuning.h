#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// Glances, and joins with light vertices (diffuse_glances.h). Errors were measured around a goal.
struct DiffuseGlances {
  // Glances for each base direction. They take most of the time of a point. The error is inversely
  // proportional to the square root of their number.
  RSPHERE_TUNED(DiffuseGlances, size_t, kPerDirection, 12);
  // Number of paths from a point by which suitsDaylight() decides, and the largest fraction of them that may
  // leave the room past all portals or meet surfaces that are not plain.
  static constexpr size_t kWalks = 256;
  RSPHERE_TUNED(DiffuseGlances, double, kMostPast, .02);
  // Limit on the memory for the glances at one point (about 100 MB), if there are fewer base directions, and
  // for the light paths of all pools together (about 400 MB).
  static constexpr size_t kMost = 1 << 20;
  // Joins for each base direction. With 4, the error is 5% larger and the time 2% shorter. With 16, no effect
  // beyond noise. With 0, .4 to 3% of the light by lamps is missing, which nothing else estimates. Distances
  // below LightVertices::kWidth hardly increase the number of joins.
  RSPHERE_TUNED(DiffuseGlances, double, kJoinsPerDirection, 8);
  // The number of pools of light vertices with -Sa and -Su. Sets of directions use them in turn, so that
  // averaging sets also averages the error due to the vertices. Also the number of sets after which -Sa stops
  // at a dark point.
  static constexpr size_t kPools = 8;
  // The number of light paths, as a multiple of the number of base directions (-Sn). They are traced once,
  // and used at all points. With 256, the error is 10% smaller, and the program takes .4 s to start instead
  // of .1 s.
  RSPHERE_TUNED(DiffuseGlances, double, kPathsPerDirection, 64);
  // The least number of light paths in a batch: if single paths vary as much as their mean, that of a batch
  // is known within 3%.
  static constexpr size_t kLeastPaths = 1024;
  // kPathsPerDirection by daylight through openings, where a path costs twice as much. With a quarter, the
  // error is 10 to 40% larger, and the program starts in .14 instead of .2 s.
  static inline const double kDaylitPaths = kPathsPerDirection / 2;
  // Assumed mean radiance of the light that glances miss, as a fraction of the radiance that they find. It is
  // the reference for the variance of targets. With .3 or 1, single answers are off by 6% where brushed steel
  // reflects the goal. With .03, the time is 1.15 times as long, without an effect on the error beyond noise.
  RSPHERE_TUNED(DiffuseGlances, double, kLeft, .1);
};

// Light vertices for each room (light_pools.cpp).
struct LightPools {
  // A place gets separate vertices if the sources visible from it have less than this fraction of all power.
  // If they have more, enough of the paths from all sources reach the place.
  static constexpr double kFewPower = .25;
  // Places in one region share vertices. The region is the largest one around a place in which the sources
  // visible from the place still make up this fraction of the power of all sources visible from the region.
  static constexpr double kShared = .75;
};

}  // namespace rsphere::tuning
