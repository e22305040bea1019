#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include "base/tuned.h"
#include "openings/tuning.h"

namespace rsphere::tuning {

// Particles of sources with patterns (light_particles.cpp). kTried: number of ways of which one is
// followed; as many as for light paths (VertexLight::kCandidates). kMeasured: number that measure the
// power: it is known within a quarter if a beam fills a quarter of the hemisphere.
struct LightParticles {
  static constexpr size_t kTried = 8, kMeasured = 64;
};

// Spots of strong direct light, at which indirect rays are aimed (bright_spots.cpp).
struct BrightSpots {
  // Number of particles traced from the sources, and of those traced from distant sources through openings.
  // Derived: if all particles hit spots, a spot is hit by 128 on average, and its power is known within 9%,
  // 1/sqrt(128). 80 particles find a spot that reflects a hundredth of the light. Insensitive.
  static inline const double kParticles = 128. * Caps::kAimed;
  // A spot reflects at least this many times as much light per area as the mean of all surfaces. Chosen by
  // experiment. For light that enters through openings, the threshold is half of this, because few rays of a
  // patch of the coarse solution hit these spots. Measured in a sunlit classroom: thresholds of 6, 3 and 2
  // have noise of 1.55, 1.16 and 1.27% at sensors. Without spots, variance x time of gathers is 1.2 to 2.1
  // times as large in three sunlit rooms, that of points in a cabin by lamps 1.3 times
  // (tests/bench/mechanisms/runs/2026-11-29-tails.txt).
  //
  // Directions are only aimed if the worth of all spots together (Node::worth) exceeds this multiple of the
  // worth that all surfaces would have under uniform light, since aiming makes a path 25% more expensive.
  // Measured: a relative worth of 31 (a lit lampshade), 8 (an office, around a goal) and 2 (a small room)
  // leaves one third, two thirds and nearly all of the noise. Insensitive. For light that enters through
  // openings, no minimum is required.
  RSPHERE_DERIVED(BrightSpots, double, kBrighter, 5);
  // Transmittance assumed for every pane: that of clear single glazing. It need not be exact, because only
  // the relative power of spots matters.
  static constexpr double kTransmittance = .9;
  // The smallest number of particles that form a spot. Its power is then known within 29%, 1/sqrt(12).
  static constexpr size_t kFewest = 12;
  // Spots are divided as long as this adds more than this fraction to the worth of all. Measured: with 0, an
  // office has 34 faint spots more, and its sensors .82 instead of .75% of noise.
  static constexpr double kLeastGain = .001;
  // Ratio of the radius of a spot to half the diagonal of the box around its particles. The box around n
  // evenly distributed points is smaller than the region that contains them, on average by (n - 1) / (n +
  // 1). For the fewest particles the correction is 1.18.
  static constexpr double kWider = 1.15;
  // No rays are aimed at a spot if the squared distance to its center is below this number of squared radii.
  // At that distance, the formula for a small surface makes a disk 1.5 times as bright as it is: it uses 1 /
  // d^2 instead of 1 / (d^2 + r^2).
  static constexpr float kApart = 2;
  // Surface area of a room, divided by the mean square of the distances across it. The mean chord of a convex
  // body is 4 V/S. In a room of 10 x 7 x 3 m it is 3.5 m; the mean square is 17 m2, and the surface area 14
  // times as large.
  static constexpr double kRoomSurface = 14;
  // One in this number of particles begins a random walk of this many steps.
  static constexpr size_t kForEachWalk = 16;
  static constexpr int kStepsOfWalk = 8;
};

// Highlights of light sources on rough balls and cylinders, at which indirect rays are aimed (highlights.h,
// source_parts.cpp, highlight_lobe.cpp, ball_highlights.cpp, cylinder_highlights.cpp). Values without a
// stated origin are estimates that have not been varied. All affect the variance and the computing time, not
// the mean.
struct Highlights {
  // Rays are aimed at a highlight if otherwise, hit only by chance, it would add more than this multiple of
  // the squared mean radiance to the variance of a direction. Measured in an open-plan office with 50 rough
  // balls and 51 rough legs, at a desk, above it, and at the ceiling: noise of 2.61 .92 2.84% without, .44
  // .49 2.84% with .1, .44 .20 2.71% with .05, .23 .28 2.58% with .02; with .2, only the first improves.
  // Without aiming, single sensors beside cylinders are wrong by a factor
  // (tests/bench/mechanisms/runs/2026-11-29-rays.txt).
  RSPHERE_TUNED(Highlights, double, kLeast, .05);
  // Gathers with at least this number of rays search for highlights on cylinders. Derived: in the office of
  // kLeast, a search takes as long as two rays, at most an eighth of the gather.
  RSPHERE_DERIVED(Highlights, int, kMany, 16);
  // Factor on kLeast for balls, in gathers with fewer rays than kMany, whose noise is larger. kLeast divided
  // by this is also the threshold for each single highlight on cylinders, because many cylinders add up.
  // Insensitive.
  RSPHERE_DERIVED(Highlights, double, kLeastOfFew, 10);
  // Largest half-width of a part of a source, relative to its distance from the surface. The highlight of a
  // wider part would be noticeably curved. Also used for the parts of sources whose images in mirroring balls
  // are targets (targets/glints.h). Derived: its edge is at most 3% farther away than its middle.
  static constexpr double kHalf = .25;
  // Ratio of the width of the distribution of aimed directions to the width of the highlight. Also the ratio
  // of the region that surrounds the image of a source in a mirroring ball (targets/glints.h) to the image.
  // Without this margin, few directions would hit the edge, and a part of the image would be lost.
  // Insensitive.
  static constexpr double kWider = 1.2;
  // Lower bound on cosines, for surfaces seen edge-on. Used for reflections, whose highlight would otherwise
  // have no extent; for bright spots, whose normal is a mean; and for the sine of the angle between a
  // cylinder's axis and a distant source. Insensitive.
  static constexpr double kEdgeOn = .05;
  // No direction is aimed where the density of a highlight is below exp(-kReach^2) = 1e-4 of its peak. For a
  // small source, this happens in Ward's model if the angle between the normal and the bisector of the
  // directions to point and source exceeds this multiple of the roughness.
  static constexpr double kReach = 3;
  // No rays are aimed at a ball or cylinder if the distance to its center or axis is below this number of
  // radii, because the formulas divide by 0 on its surface.
  static constexpr double kApart = 1.02;
  // Places along a cylinder from which shadow rays are sent to a source, as fractions of its length.
  static constexpr double kPlaces[] = {.5, .1, .9};
  // Number of cells along the longest side of the scene. With this number, the grid takes half a megabyte.
  // With fewer cells, points where no object matters would take more time.
  static constexpr int kReachCells = 32;
};

}  // namespace rsphere::tuning
