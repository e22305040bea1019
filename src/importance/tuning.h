#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. Those of special objects, for which the
// paper gives no values, are in special_objects.h.
//
// Changing them does not change the mean of an estimate over rotations (-Sr), except slightly for those of
// Stopping. It changes the variance and the time, the estimated variance (ErrorEstimate), and pictures (-Si).
//
// Each comment gives the meaning, the unit and the origin of the value. "Chosen by experiment": it was the
// best of some values that were tried on scenes like those of tests/bench/importance; the results of the
// others were not kept. "Insensitive": changing it by 30% had no effect beyond noise in
// tests/bench/sensitivity (runs/2026-11-24.txt, or 2026-11-22.txt if it was not measured again).
#include <array>
#include <cstddef>

#include "base/constants.h"
#include "base/tuned.h"

namespace rsphere::tuning {

// The contrast of special objects with their surroundings (contrasts.cpp), measured once per scene.
struct Contrasts {
  // Rays to the special objects of one modifier; twice as many paths sample the typical view. Chosen by
  // experiment. For normally distributed values, the standard deviation is then known within 9%, 1/sqrt(2 x
  // 63). To limit the time at start, all modifiers together get Caps::kAsked rays, but each at least 2: with
  // separate rays for each object, the start took 1.1 s instead of .05 s. Insensitive.
  RSPHERE_TUNED(Contrasts, size_t, kRays, 64);
};

// The strategy -Sw c as a whole (silhouette_weights.cpp).
struct SilhouetteWeights {
  // Base directions for each direction to images of light sources; the latter are at least
  // SeenSources::kUsualRays. Chosen by experiment. Insensitive.
  RSPHERE_TUNED(SilhouetteWeights, size_t, kBaseDirectionsPerRayToImages, 4);
};

// Glances, and joins with light vertices (diffuse_glances.h). Errors are those around the goal.
struct DiffuseGlances {
  // Glances for each base direction. They take most of the time of a point. The error is inversely
  // proportional to the square root of their number.
  RSPHERE_TUNED(DiffuseGlances, size_t, kPerDirection, 12);
  // Paths from a point that decide whether glances suit it by daylight, and the largest fraction of them that
  // may leave the room past all portals or meet surfaces that are not known.
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
  // averaging sets also averages the error due to the vertices. It is also the number of sets after which -Sa
  // stops at a dark point: each pool has then been used once. In a closed metal column, these sets take 7 s
  // (-ab 6).
  static constexpr size_t kPools = 8;
  // The number of light paths, as a multiple of the number of base directions (-Sn). They are traced once,
  // and used at all points. With 256, the error is 10% smaller, and the program takes .4 s to start instead
  // of .1 s.
  RSPHERE_TUNED(DiffuseGlances, double, kPathsPerDirection, 64);
  // The same by daylight through openings, where a path costs twice as much: half of it, so that the paths of
  // both take the same time. With a quarter, the error is 10 to 40% larger, and the program starts in .14
  // instead of .2 s.
  static inline const double kDaylitPaths = kPathsPerDirection / 2;
  // Assumed mean radiance of light that glances miss, as a fraction of that which they find. It is the
  // reference for the variance of targets. With .3 or 1, single answers are off by 6% where brushed steel
  // reflects the goal. With .03, the time is 1.15 times as long, without an effect on the error beyond noise.
  RSPHERE_TUNED(DiffuseGlances, double, kLeft, .1);
};

// The regions that get extra directions (targets.cpp).
struct Targets {
  // An image of a light source in a ball becomes a target if it would otherwise add more than this fraction
  // of the variance of all base directions: chosen by experiment. Insensitive.
  RSPHERE_TUNED(Targets, double, kLeastGlint, 1e-3);
  // Standard deviation of the brightness within a partly lit region, relative to the brightness of its lit
  // part: derived. .5 is the largest possible value, and holds if half of the region is lit. Measurements for
  // the three kinds of regions confirm it:
  // - Images of light sources in balls. Reducing it by 30% changes the error by +12%, raising it by 30% by
  //   -20% (points beside chrome).
  // - Openings that show daylight, in a room with a window onto a house below an uneven sky. Errors of 512
  //   directions; the times are equal within noise:
  //   value                            no targets   0      .1     .25    .5
  //   error with two bounces           6.9%         3.8%   2.9%   2.7%   2.5%
  //   error with none                  76%          51%    5.9%   3.8%   2.3%
  // - Spots of daylight. With the default number of directions, the errors in two sunlit rooms are 1.5 and
  //   1.8% with such targets, 2.75 and 1.9% without. With .25 or 1, no effect beyond noise.
  RSPHERE_DERIVED(Targets, double, kPartlyLit, .5);
  // An opening gets at least Caps::kProbes directions if it would, unoccluded, give more than this fraction
  // of the light at a point: chosen by experiment. With .1, a far window that happens to be dark in the rays
  // around a point causes errors of up to 10% instead of 5%. With only 8 directions, an opening with an
  // eighth hidden often looks unobstructed.
  RSPHERE_TUNED(Targets, double, kLeastOpening, .01);
  // Cells in a target are fitted to its solid angle if at least this many directions are expected in it:
  // chosen by experiment. Fitting biases the mean if the number of directions is correlated with the radiance
  // that they find. With 8 no bias is found: .02 +- .02% (128 base directions). With 4 or 16, the errors in
  // rooms with a window are the same.
  RSPHERE_TUNED(Targets, double, kFewestFitted, 8);
};

// Light sources that are integrated separately (seen_sources.cpp).
struct SeenSources {
  // The fraction of an even share of all rays in the cap on the rays to one image (kSmallestPart). With it,
  // the error for a small half-hidden lamp falls from 4.2% with 256 base directions to .33% with 16384;
  // without it, the error stays at 4.2%.
  //
  // It is also the number of rays below which an image in a mirror is left to the base directions: chosen by
  // experiment. A tenth of a ray is a ray at one in ten points, with ten times the weight. Insensitive.
  RSPHERE_TUNED(SeenSources, double, kSmallShare, .1);
  // The number of rays to an image is proportional to its light raised to this power: derived. Of the n parts
  // of a half-hidden image, only those on the shadow's edge are uncertain, so that the error for light L is
  // proportional to L n^-3/4. The sum of L^2 n^-3/2 over all images, for a given sum of n, is smallest for n
  // proportional to L^(4/5).
  static constexpr double kByLight = 4. / 5;
  // Number of directions that measure, without tracing rays, how much of a region its source fills: derived.
  // An edge divides about n^1/2 of n even cells. Their errors, of .3 each, add up to .3 n^-3/4 of the region:
  // .2%.
  static constexpr size_t kShareTries = 1024;
  // Shadow rays along each side of a direction's cell on a directly visible source: measured at points where
  // a partition hides part of the goal. With 2, the error is 3% instead of 1.8%, in the same time. With 8, no
  // effect beyond noise.
  RSPHERE_TUNED(SeenSources, size_t, kShadowsAlong, 4);
  // The cap on the rays to a small image of a source, as many as the shadow rays of one cell.
  static inline const double kUsualRays = static_cast<double>(kShadowsAlong * kShadowsAlong);
  // Solid angle (sr) in the image of a source for each of which a ray is allowed: derived. The cell of one of
  // the usual 2048 base directions gets kUsualRays. The cap on the rays to one image is the largest of
  // kUsualRays, one for each such part, and kSmallShare times an even share of all rays to images. Without
  // the parts, the error below a luminous ceiling partly hidden by 36 balls is 2.9% instead of .5%.
  RSPHERE_DERIVED(SeenSources, double, kSmallestPart, 4 * kPi / 2048 / (kShadowsAlong * kShadowsAlong));
};

// Regions of directions used in place of exact silhouettes (silhouette.cpp, silhouette_index.cpp).
struct Silhouettes {
  // Largest half angle (rad) of an object, as seen from the point, for which a hull is computed instead of a
  // cap: derived. Hulls are computed on a plane, which cannot represent a hemisphere (1.57). At this angle,
  // the projection stretches directions by 14 and 14^2, so that rounding costs two digits of sixteen. With
  // 1.2, the error beside chrome is 30% larger, in the same time.
  RSPHERE_DERIVED(Silhouettes, double, kWidestHull, 1.5);
  // Corners of the polygon around a circle: derived. The polygon's area is 1.3% larger than the circle's, so
  // that 1.3% of the directions to it miss the object. When searching for images on balls, light sources with
  // more corners are replaced by squares around them. Insensitive.
  static constexpr int kCorners = 16;
  // Cells along each edge of a face of the cube map that lists the silhouettes near a direction: chosen by
  // experiment. Without cells, the search among 180 special objects took 18% of the time. The number only
  // affects the time. tests/bench/sensitivity does not vary it, because it is the size of a table.
  static constexpr int kSide = 6;
};

// The standard error of a mean (error_estimate.cpp).
struct ErrorEstimate {
  // Relative standard error of the mean due to the coarse solution (-aa above 0), assumed independent of the
  // error of the directions. Its patches cause kPatches. Its rays cause as much again if gathers have
  // kUsualRays rays; this part is inversely proportional to the square root of their number. Measured in a
  // white room with a lamp: means are .08% too dark, because the light and the solid angle of a patch both
  // decrease away from the place below the lamp. In daylit rooms means are .1 to .2% too dark, with stated
  // errors of .6 to 1% (tests/bench/rtrace/runs/2026-11-28-patches.txt).
  RSPHERE_TUNED(ErrorEstimate, double, kPatches, .0009);
  static constexpr double kUsualRays = 1024;
  // Factor on the variance that is estimated from differences of evenly spread directions: derived. The right
  // value is .6 if all variance is due to straight edges, because evenly spread directions average out part
  // of it, and 1 if all is due to the noise of paths. With the middle of both, stated errors are at most 15%
  // too large and 11% too small. Where directions to one target see something round that is as large as ten
  // of their cells, they are up to 35% too large.
  static constexpr double kEvenSet = .8;
  // Smallest number of neighbours for second differences: derived. ownPartOfSecond() does not hold for fewer.
  static constexpr double kFewestAround = 4;
  // Factor like kEvenSet for directions to the parts of a light source: chosen by experiment. Differences
  // between successive parts overestimate the effect of an edge, because it lies between two parts more often
  // than it crosses one. Where all variance is due to the light of one source, the stated error is too small
  // (40 rotations each):
  //   stated / actual standard deviation        .5 (used)    1
  //   luminous ceiling behind 36 balls          .67 to .88   .94 to 1.24
  //   lamp of .1 m, half hidden                 .69          .98
  //   ceiling with a pattern of stripes         .70 to .76   .99 to 1.08
  // Insensitive.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenParts, .5);
  // The same factor for n dynamic directions to several targets, parts of one image, is 1 / (1 + n^1/2 /
  // kEvenRun). The root is derived: an edge crosses about n^1/2 of the n cells. kEvenRun is chosen by
  // experiment. n is the effective number of directions that cause the variance. With the number of all
  // directions, errors were understated beside a chrome ball, where 1 to 5 of 3400 directions find twice
  // mirrored lamps: the actual deviation was 1.6 times the stated one, and 2% of the answers were off by more
  // than six stated errors. Now the ratio is .9, and no answer is. Insensitive.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenRun, 8);
  // Assumed size of an obstacle that no direction has hit, as a fraction of the solid angle that one more
  // direction in a target would represent: derived. If n directions miss an obstacle, the expected fraction
  // that it covers is 1/2 / (n + 1) (Bayes' theorem, with Jeffreys' prior for a probability).
  static constexpr double kUnseen = .5;
  // The stated variance due to light vertices is at least this number of standard deviations of the spread of
  // their batches: chosen by experiment. It is the spread minus the part due to choosing vertices at random;
  // if the two are nearly equal, the difference may be 0 by chance. Where a tiny lamp lights a white room
  // (-ab 0), 10% of the answers were off by more than six stated errors without the minimum, and none of 600
  // with it.
  static constexpr double kLeastShared = .5;
};

// The end of -Sa (two_halves.cpp).
struct Stopping {
  // Each half requests sets until its standard error is below this multiple of the requested one: measured.
  // One answer in 50, instead of 25, then needs further sets because its own error estimate is too large.
  // Those sets cause the remaining bias. Insensitive.
  RSPHERE_TUNED(Stopping, double, kMargin, .95);
  // Cap on the ratio between the numbers of sets of the two halves: derived. If a set finds something very
  // bright, the other half is given many sets. The cap gives the half of the bright set some as well, and
  // these reduce its weight sooner. With a ratio of 1, the number of sets of a half would depend on its own
  // sets, which is the bias that the halves avoid. 2 is therefore the smallest integer.
  static constexpr size_t kMostRatio = 2;
};

// Points at which almost no light arrives (estimator.cpp, two_halves.cpp).
struct Dark {
  // -Sa stops early if the mean is below this fraction of the average radiance on the scene's surfaces. A
  // warning names the point if less than this fraction of the directions find light. Derived: it is two of
  // the usual 2048 directions, whose mean is known within 71%. In closed metal furniture, one direction in a
  // hundred thousand finds a gap between surfaces; a million directions could not measure its light within a
  // percent. Insensitive.
  static constexpr double kShare = 2. / 2048;
};

// Pictures of the view from a point (draw_point.cpp, pixel_tracer.cpp, smooth_light.cpp).
struct Pictures {
  // Height of a fisheye in pixels: the least that evalglare(1) of RADIANCE recommends.
  // tests/bench/sensitivity draws smaller pictures.
  RSPHERE_DERIVED(Pictures, int, kFisheyeSide, 800);
  // Light sources that cover fewer pixels than this are sampled separately: derived. A disc of 16 pixels
  // covers the middles of 14 to 21 pixels, which gives its light a standard deviation of 6%. For a lamp of
  // 1.4 pixels it would be 38%; with separate samples it is .1%.
  //
  // It is also the number of samples of such a source per covered pixel, and the minimum per source:
  // measured. With 4 per pixel, lamps of 4 to 16 pixels lose 3 to 9% of their light in the picture, with 16
  // they lose 1 to 3.5%. Insensitive.
  static constexpr double kSmallest = 16;
  // Offsets from the middle of a pixel (in pixels) of the rays that look for the background behind a small
  // source: chosen by experiment.
  static constexpr std::array<std::array<double, 2>, 4> kBeside = {
      {{-.4, -.4}, {.4, .4}, {-.4, .4}, {.4, -.4}}};
  // Side of the squares of pixels (in pixels) in each of which one pixel gathers indirect light, with 32
  // rays: derived. It is the least with which pixels share light.
  static constexpr int kSharing = 2;
  // The same where shadow rays find all light (neither daylight nor glow), so that gathers are less noisy:
  // chosen by experiment in the open-plan office. With 2, the error changes by -21%, with 4 by +26% (picture
  // from point with 1% of the pixels).
  RSPHERE_TUNED(Pictures, int, kSharingByLamps, 3);
  // Smoothing passes for indirect light: chosen by experiment. With 2, the error changes by +10%; with 4, no
  // effect beyond noise (picture from point).
  RSPHERE_TUNED(Pictures, int, kIndirectPasses, 3);
  // Largest relative difference of light between pixels that share it in further passes, for indirect and
  // direct light: derived. The noise after the first passes is at most 5%, so that this is two standard
  // deviations of the difference of two pixels, 2 x 2^1/2 x 5%.
  static constexpr float kSameLight = .14f;
  // Number of times that the direct light of a noisy pixel in a soft shadow is traced again: chosen by
  // experiment. The picture of examples/idea takes 10% longer, and the edge of its shadow becomes smooth.
  static constexpr int kRepeats = 8;
  // Smoothing passes for gloss, which is also the number of further passes for other light; and least
  // roughness of surfaces whose pixels share gloss: derived. The lobe is then about as wide as the blur of
  // two passes, 2.2 pixels or .014 radians. With 1 or 3 further passes for other light, no effect beyond
  // noise (picture from point), but with 3 a glossy desk below a window looks rougher.
  static constexpr int kFinePasses = 2;
  static constexpr double kLeastRoughness = .02;
  // Least cosine between the normals of pixels that share gloss: derived. It corresponds to 2 degrees, less
  // than the width of such a lobe.
  static constexpr float kSameGlossNormal = .9994f;
  // Visible difference between neighboring pixels, on an sRGB scale of 0 to 1. Where it is exceeded, four
  // rays near the corners of the pixel are added; if these differ as much, four near the middles of its
  // sides. Chosen by experiment. Reducing it by 30% changes the error by -2%, raising it by 30% by +3%
  // (picture from point).
  RSPHERE_TUNED(Pictures, double, kVisible, .05);
  static constexpr std::array<std::array<double, 2>, 8> kAround = {{{-1 / 3., -1 / 3.},
                                                                    {1 / 3., -1 / 3.},
                                                                    {-1 / 3., 1 / 3.},
                                                                    {1 / 3., 1 / 3.},
                                                                    {0, -1 / 3.},
                                                                    {-1 / 3., 0},
                                                                    {1 / 3., 0},
                                                                    {0, 1 / 3.}}};
  static constexpr size_t kCorners = 4;
  // Rows are traced in this number of sweeps, each of which skips rows evenly. All sweeps then take about the
  // same time, so that progress reports are right. It does not affect the picture.
  static constexpr int kSweeps = 16;
  // Two pixels share light if their surface points are close together and nearly in one plane. The limit on
  // the distance between the points is this fraction of the distance from the eye. The limit on the height of
  // one point over the other's plane is this fraction of the distance between them. Chosen by experiment. If
  // the fraction is 30% lower, the error is 25% larger; if it is 30% higher, the error is 13% smaller (with
  // 1% of the pixels, which makes edges weigh more).
  RSPHERE_TUNED(Pictures, float, kNear, .25f);
};

}  // namespace rsphere::tuning
