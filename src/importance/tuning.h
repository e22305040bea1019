#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. Those of special objects, which the paper
// asks for but does not give, are in special_objects.h.
//
// None of them changes the mean of an estimate over rotations (-Sr), except those of Stopping, slightly. They
// change its variance and its time, its own estimate of the variance (ErrorEstimate), and pictures (-Si).
//
// Each comment gives the meaning and the unit, then after the colon where the value comes from. "Chosen by
// experiment" means that it was the best of some values that were tried on scenes like those of
// tests/bench/importance, and that the results for the others were not kept. The last sentence gives the
// effect of smaller and larger values on error and time, in the case of tests/bench/sensitivity where it is
// largest (2026-11-24.txt in its folder runs, and 2026-11-22.txt for what has not changed since).
#include <array>
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// How much radiance varies on special objects and around them (contrasts.cpp). Measured once per scene.
struct Contrasts {
  // Rays to the special objects of one modifier; twice as many paths sample the typical view. Chosen by
  // experiment. For normally distributed values the standard deviation is then known within 9%, 1/sqrt(2 x
  // 63). All modifiers together get Caps::kAsked rays, but at least 2 each, to limit the time at start: rays
  // for each object instead of each modifier took 1.1 s instead of .05 s. 30% less or more: within noise
  // (points in office; error 7%, time 6%).
  RSPHERE_TUNED(Contrasts, size_t, kRays, 64);
};

// The strategy -Sw c as a whole (silhouette_weights.cpp).
struct SilhouetteWeights {
  // Glances per base direction: by measurement. A glance takes .15 to .5 us, a direction 1 to 100. Twice as
  // many, with twice as many shadow rays to sources (SeenSources), reduced the error from .53% to .51% beside
  // a goal and from .41% to .40% in the open-plan office, in up to a fifth more time. 30% less or more:
  // within noise (points in office; error 27%, time 6%).
  RSPHERE_TUNED(SilhouetteWeights, size_t, kGlancesPerDirection, 4);
  // Base directions for each direction to images of light sources, which are at least
  // SeenSources::kUsualRays: chosen by experiment. 30% less or more: within noise (points in office; error
  // 8%, time 6%).
  RSPHERE_TUNED(SilhouetteWeights, size_t, kBaseDirectionsPerRayToImages, 4);
};

// Glances and joins with light vertices (diffuse_glances.h).
struct DiffuseGlances {
  // Glances for each base direction. They take most of the time of a point. The error falls with the square
  // root of their number.
  RSPHERE_TUNED(DiffuseGlances, size_t, kPerDirection, 12);
  // Cap on the glances at one point, about 100 MB; they are never fewer than the base directions. Also the
  // cap on the light paths of all pools together, about 400 MB.
  RSPHERE_TUNED(DiffuseGlances, size_t, kMost, 1 << 20);
  // Joins for each base direction. 4: error +5% around the goal at a fiftieth less time; 16: within noise.
  RSPHERE_TUNED(DiffuseGlances, double, kJoinsPerDirection, 8);
  // Radius, as a fraction of the mean length of light paths, within which a smaller distance hardly increases
  // the number of joins. .1 or .3: within noise.
  RSPHERE_TUNED(DiffuseGlances, double, kJoinRadius, .17);
  // Light paths for each base direction. They are traced once for all points. Around the goal, 256: error
  // -10%, and a start of .4 s instead of .1 s.
  RSPHERE_TUNED(DiffuseGlances, double, kPathsPerDirection, 64);
  // With -Sa, this number of light paths suffices down to this accuracy. Below it, the number grows with the
  // inverse square of the accuracy.
  RSPHERE_TUNED(DiffuseGlances, double, kUsualAccuracy, .005);
  // Assumed mean radiance of the light that glances do not find, as a fraction of the mean radiance that they
  // find. The variance of targets is compared with it. 1 and .3: single answers are 6% off around the goal,
  // where brushed steel shows it; .03: within noise, in 1.15 times the time.
  RSPHERE_TUNED(DiffuseGlances, double, kLeft, .1);
};

// The regions that get extra directions (targets.cpp).
struct Targets {
  // An image of a light source in a ball gets directions of its own if without them it would add more than
  // this share of the variance of all base directions: chosen by experiment. 30% less or more: within noise
  // (points in office; error below 1%, time 7%).
  RSPHERE_TUNED(Targets, double, kLeastGlint, 1e-3);
  // Standard deviation of the brightness within a partly lit region, relative to the brightness of its lit
  // part: derived. .5 is the largest possible for values between 0 and 1: half of the region is lit. It is
  // confirmed by measurement for the three kinds of regions:
  // - Images of light sources in balls. 30% less: error +12%; 30% more: error -20% (points beside chrome;
  //   noise: error 5%).
  // - Openings that show daylight. In a room with a window that shows a house below an uneven sky, the errors
  //   of 512 directions with values of 0, .1, .25 and .5 are 3.8, 2.9, 2.7 and 2.5% (two bounces) and 51,
  //   5.9, 3.8 and 2.3% (none), in the same time within noise; without targets at openings 6.9 and 76%.
  // - Spots of daylight. With them, the default directions in two sunlit rooms have errors of 1.5 and 1.8%
  //   instead of 2.75 and 1.9%. .25 or 1: within noise.
  static constexpr double kPartlyLit = .5;
  // An opening that, unoccluded, would give more than this fraction of the light at a point gets at least
  // Caps::kProbes directions: chosen by experiment. At .1, a far window that happens to be dark in the rays
  // around a point causes errors of up to 10% instead of 5%. With 8 directions, an opening of which an eighth
  // is hidden often looks unobstructed.
  RSPHERE_TUNED(Targets, double, kLeastOpening, .01);
  // The cells in a target are fitted to its solid angle if at least this many directions are expected in it:
  // chosen by experiment. With 4 or 16 the errors in rooms with a window are the same. With fewer, the fit
  // would bias the mean where the number of directions is correlated with what they see. With 8 no bias is
  // found: .02 +- .02% (128 base directions).
  RSPHERE_TUNED(Targets, double, kFewestFitted, 8);
};

// The cells of directions in targets (cells_in_targets.cpp).
struct CellsInTargets {
  // If the cells outside targets would have to change by more than this share, all cells are scaled: chosen
  // without measurement. It matters only where targets fill nearly all of the sphere.
  RSPHERE_TUNED(CellsInTargets, double, kMostScaled, .25);
};

// Images of light sources in mirroring balls (glints.cpp).
struct Glints {
  // A source is divided so that half the width of a part is at most this, relative to its distance from the
  // ball, because the image of a wider part is noticeably curved: chosen by experiment. There are at most
  // Silhouettes::kCorners parts along each side. .25 (Highlights::kHalf): within noise (points beside chrome;
  // error 1%, time 1%).
  RSPHERE_TUNED(Glints, double, kHalfPart, .12);
};

// Light sources that are integrated separately (seen_sources.cpp).
struct SeenSources {
  // Cap on the rays to one image: the largest of kUsualRays; one ray for each square of side kSmallestPart
  // (rad) in the image; and kSmallShare times an even share of all rays to images. Chosen by experiment. 30%
  // less or more: within noise (points by sun; error below 1%, time 4%).
  RSPHERE_TUNED(SeenSources, double, kUsualRays, 16);
  // The side of those squares (rad). Wide sources need them: without them, the error below a luminous ceiling
  // that 36 balls hide partly is 2.9% instead of .5% (2048 base directions). 30% less or more: the same
  // answers in all cases.
  RSPHERE_TUNED(SeenSources, double, kSmallestPart, .02);
  // The fraction of an even share in this cap. Without it, the error of a small lamp that is half hidden
  // would stay at 4.2% with any number of base directions. With it, the error falls from 4.2% with 256 to
  // .33% with 16384.
  //
  // Also, images in mirrors that would get fewer rays than this, on average, are left to the base directions:
  // chosen by experiment. A tenth of a ray means a ray at one of ten points, with ten times the weight. 30%
  // less or more: within noise (points in workshop; error 17%, time 7%).
  RSPHERE_TUNED(SeenSources, double, kSmallShare, .1);
  // The number of rays to an image is proportional to its light to this power: derived. Of n parts of a
  // half-hidden image, only those on the shadow's edge are uncertain, so that the error is proportional to L
  // n^-3/4 for light L. The sum of L^2 n^-3/2 over all images, for a given sum of n, is smallest for n
  // proportional to L^(4/5).
  static constexpr double kByLight = 4. / 5;
  // Directions, without rays, that measure the fraction of a region that its source fills: derived. An edge
  // divides about n^1/2 of n even cells, whose errors, of .3 each, add up to .3 n^-3/4 of the region: .2%.
  static constexpr size_t kShareTries = 1024;
  // Shadow rays along each side of a direction's cell on a source that is seen directly: by measurement. At
  // points where the goal shows behind the edge of a partition, 2: error 3% instead of 1.8%, in the same
  // time; 8: within noise.
  RSPHERE_TUNED(SeenSources, size_t, kShadowsAlong, 4);
};

// The regions that replace silhouettes (silhouette.cpp, silhouette_index.cpp).
struct Silhouettes {
  // Largest half angle (rad) of an object, as seen from the point, for which a hull is computed instead of a
  // cap: derived. Hulls are computed on a plane, which cannot hold a hemisphere (1.57). At this angle, the
  // projection stretches directions by 14 and 14^2, so that rounding costs two digits of sixteen. 1.2: error
  // +30% beside chrome, in the same time.
  static constexpr double kWidestHull = 1.5;
  // Corners of the polygon around a circle: chosen by experiment. The polygon's area is 1.3% larger. To find
  // images on balls, light sources with more corners than this are replaced by squares around them. With 30%
  // less or more, points beside chrome change by no more than the noise (error below 1%, time 8%).
  RSPHERE_TUNED(Silhouettes, int, kCorners, 16);
  // Cells along the edge of a face of the cube map that names the silhouettes near a direction: chosen by
  // experiment. Without cells, the search among 180 special objects took 18% of the time. The number changes
  // the time only, and tests/bench/sensitivity does not vary it, because it is the size of a table.
  static constexpr int kSide = 6;
};

// The standard error of a mean (error_estimate.cpp).
struct ErrorEstimate {
  // Relative standard error of the mean that is due to the coarse solution (-aa above 0), assumed independent
  // of the error of the directions. Its patches cause kPatches. Its rays cause as much again if gathers have
  // kUsualRays rays, and otherwise in inverse proportion to the square root of their number. By measurement:
  // in a white room with a lamp, with and without a desk, means have errors of .13% with 256 rays and .06 to
  // .07% with 8192. In daylit rooms means are .1 to .2% too dark, beside stated errors of .6 to 1%.
  RSPHERE_TUNED(ErrorEstimate, double, kPatches, .0006);
  static constexpr double kUsualRays = 1024;
  // Factor on the variance that is estimated from second differences of base directions: a compromise. It
  // should be .6 if all of the variance comes from straight edges, because an even set averages out a part of
  // it, and 1 if all comes from the noise of paths.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenSet, .8);
  // The smallest number of neighbours with which second differences are used: derived. With fewer,
  // ownPartOfSecond() does not hold for their variance.
  static constexpr double kFewestAround = 4;
  // The same factor for directions to the parts of a light source: chosen by experiment. Differences of
  // successive parts overestimate the effect of an edge, because it lies between two parts more often than it
  // crosses one. Where the light of a source causes all of the variance, the standard error is then too small
  // (40 rotations each):
  //   predicted / actual deviation              .5 (this)    1
  //   luminous ceiling behind 36 balls          .67 to .88   .94 to 1.24
  //   lamp of .1 m, half hidden                 .69          .98
  //   ceiling with a pattern of stripes         .70 to .76   .99 to 1.08
  // 30% less or more: the same answers in all cases.
  //
  // It is also the factor for glances, whose guesses have edges but no noise of paths. Without bounces, in
  // the open-plan office, the actual deviation is then 1.07 times the predicted standard error.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenParts, .5);
  // The same factor for n dynamic directions to a target is 1 / (1 + n^1/2 / kEvenRun). The root is derived:
  // an edge crosses about n^1/2 of the n cells. kEvenRun is chosen by experiment. n is the effective number
  // of directions that cause the variance, not all directions of the target. With all of them, at a point
  // beside a chrome ball where 1 to 5 of 3400 find lamps that are mirrored twice, the actual deviation was
  // 1.6 times the predicted standard error, and 2% of the answers were off by more than six standard errors;
  // now the ratio is .9, and no answer is. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenRun, 8);
  // Assumed size of an obstacle that no direction has hit, as a fraction of the solid angle that one more
  // direction in a target would represent: a compromise. n directions miss an obstacle of the share s with
  // the probability (1 - s)^n, a third if s is 1/n.
  RSPHERE_TUNED(ErrorEstimate, double, kUnseen, .5);
  // The shared error of light vertices is the spread of their batches minus the part that is due to choosing
  // vertices. If the two are nearly equal, the difference may be 0 by chance. The stated variance is at least
  // this number of standard deviations of the spread: chosen by experiment. Where a tiny lamp lights a white
  // room (-ab 0), 10% of the answers were off by more than six stated errors without the minimum; with it,
  // none of 600.
  static constexpr double kLeastShared = .5;
};

// When -Sa has enough sets (two_halves.cpp).
struct Stopping {
  // Each half requests sets until its standard error is below this multiple of the requested one: by
  // measurement. Only one answer in 50, rather than one in 25, then needs more sets because the average's own
  // error estimate is too large. Those sets cause the remaining bias. 30% less or more: within noise
  // (stopping; error 1%, time 6%).
  RSPHERE_TUNED(Stopping, double, kMargin, .95);
  // Cap on the ratio between the halves' numbers of sets: derived. If a set finds something very bright, the
  // other half gets many sets; the cap then gives some to the half of the bright set as well, where they
  // outweigh it sooner. With a ratio of 1, the number of sets of a half would depend on its own sets, with
  // the same bias as without halves. 2 is therefore the smallest possible integer.
  static constexpr size_t kMostRatio = 2;
};

// Points that almost no light reaches (estimator.cpp, two_halves.cpp).
struct Dark {
  // -Sa gives up soon if the mean is below this fraction of the average radiance of the scene's surfaces, and
  // a warning names the point if less than this fraction of the directions find light. Chosen without
  // measurement. Within closed furniture of metal one direction in a hundred thousand finds a gap between
  // surfaces; a million directions could not measure its light within a percent. 30% less or more: the same
  // answers in all cases.
  RSPHERE_TUNED(Dark, double, kShare, 1e-3);
  // Number of sets after which -Sa gives up: chosen by experiment. Within a closed column of metal they take
  // 7 s (-ab 6).
  RSPHERE_TUNED(Dark, size_t, kSets, 8);
};

// Pictures of the view from a point (draw_point.cpp, pixel_tracer.cpp, smooth_light.cpp).
struct Pictures {
  // Pixels along the height of a fisheye: about half a million pixels in all. The number does not trade error
  // for time, and tests/bench/sensitivity draws smaller pictures.
  RSPHERE_TUNED(Pictures, int, kFisheyeSide, 800);
  // Light sources that cover fewer pixels than this are sampled separately: derived. A disc of 16 pixels
  // holds the middles of 14 to 21 of them, so that its light has a standard deviation of 6%. The light of a
  // lamp of 1.4 pixels would have one of 38% instead of .1%.
  //
  // It is also the number of samples of such a source for each pixel that it covers, and the least number of
  // its samples: by measurement. With 4 per pixel, lamps of 4 to 16 pixels lose 3 to 9% of their light in the
  // picture, with 16 they lose 1 to 3.5%. 30% less or more: the same answers in all cases.
  static constexpr double kSmallest = 16;
  // Offsets from the middle of a pixel (in pixels) at which the background of a small source is sampled:
  // chosen by experiment.
  static constexpr std::array<std::array<double, 2>, 4> kBeside = {
      {{-.4, -.4}, {.4, .4}, {-.4, .4}, {.4, -.4}}};
  // One pixel in each square of this side (in pixels) gathers indirect light, with 32 rays: chosen by
  // experiment.
  RSPHERE_TUNED(Pictures, int, kSharing, 2);
  // The same where shadow rays find all light (there is neither daylight nor glow), so that gathers are less
  // noisy: chosen by experiment in the open-plan office. 2: error -21%; 4: error +26% (picture from point,
  // which has 1% of the pixels; noise: error 4%, time 6%).
  RSPHERE_TUNED(Pictures, int, kSharingByLamps, 3);
  // Passes of smoothing of indirect light: chosen by experiment. 2: error +10%; 4: within noise (picture from
  // point; noise: error 1%, time 6%).
  RSPHERE_TUNED(Pictures, int, kIndirectPasses, 3);
  // Further passes for indirect and direct light, in which only pixels share whose light differs by less than
  // kSameLight: chosen by experiment. The noise that the first passes leave is 2 to 5%.
  RSPHERE_TUNED(Pictures, float, kSameLight, .14f);
  // How often the direct light of a noisy pixel in a soft shadow is traced again: chosen by experiment. The
  // picture of examples/idea takes 10% more time than without, and its shadow has an even edge.
  static constexpr int kRepeats = 8;
  // Passes of smoothing of gloss, and the further passes for other light; and the least roughness of surfaces
  // whose pixels share gloss: derived. Their lobe is about as wide as the blur of two passes, 2.2 pixels or
  // .014 radians. 1 or 3 further passes for other light: within noise (picture from point; error below 1%,
  // time 6%), but with 3 a glossy desk below a window is rougher.
  static constexpr int kFinePasses = 2;
  static constexpr double kLeastRoughness = .02;
  // Least cosine between the normals of pixels that share gloss: derived. It is that of 2 degrees, less than
  // the width of such a lobe.
  static constexpr float kSameGlossNormal = .9994f;
  // Pixels that differ from a neighbor by more than this, on an sRGB scale of 0 to 1, are also traced near
  // their corners; if those rays differ by more than this, near the middles of the sides too. Chosen by
  // experiment. 30% less: error -2%; 30% more: error +3% (picture from point; noise: error below 1%, time
  // 6%).
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
  // Rows are traced in sweeps that skip all but one in this number, so that each sweep takes about as long as
  // another and progress reports are honest. It changes no picture.
  static constexpr int kSweeps = 16;
  // Two pixels share light if the distance between the points that they show is at most this fraction of the
  // distance from the eye, and the height of one point over the plane of the other at most this fraction of
  // the distance between them: chosen by experiment. 30% less: error +25%; 30% more: error -13% (picture from
  // point, which has 1% of the pixels, so that edges count more; noise: error 2%, time 6%).
  RSPHERE_TUNED(Pictures, float, kNear, .25f);
};

}  // namespace rsphere::tuning
