#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. Those of special objects, which the paper
// asks for but does not give, are in special_objects.h.
//
// None of them changes the mean of an estimate over rotations (-Sr), except those of Stopping, slightly. They
// change its variance and its time, its own estimate of the variance (ErrorEstimate), and pictures (-Si).
//
// Each comment gives the meaning and the unit, then after the colon where the value comes from. "Chosen by
// experiment" means that it was the best of some values that were tried on scenes like those of
// tests/bench/importance, and that the results for the others were not kept. The last sentence says what
// less and more of the constant do to error and time in the case of tests/bench/sensitivity where it matters
// most (2026-11-24.txt in its folder runs, and 2026-11-22.txt for what has not changed since).
#include <array>
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// How much radiance varies on special objects and around them (contrasts.cpp). Measured once per scene.
struct Contrasts {
  // The part of the standard deviation of radiance over all directions that is an error of one base
  // direction. The other part varies slowly, for example from one side of a room to the other, and an even
  // set integrates it: measured in furnished interiors, .5 to .7. 30% less: time +3%; 30% more: within noise
  // (points in office; noise: error 7%, time 1%).
  RSPHERE_TUNED(Contrasts, double, kUnevenShare, .6);
  // Rays to the special objects of one modifier, and directions in which the typical view is sampled, with
  // two paths in each: chosen by experiment. For normally distributed values the deviation is then known
  // within 9%, 1/sqrt(2 x 63). All modifiers together get Caps::kAsked rays, but at least 2 each, to limit
  // the time at start: rays for each object instead of each modifier took 1.1 s instead of .05 s. 30% less or
  // more: within noise (points in office; error 7%, time 6%).
  RSPHERE_TUNED(Contrasts, size_t, kRays, 64);
};

// The strategy -Sw c as a whole (silhouette_weights.cpp).
struct SilhouetteWeights {
  // Rays at each point that measure the mean brightness around, and that the guess of radiance is fitted to:
  // chosen by experiment; 1.6% of the directions of the default. 30% less or more: within noise (points
  // beside goal; error 16%, time 7%).
  RSPHERE_TUNED(SilhouetteWeights, int, kRaysAround, 32);
  // Glances per base direction: by measurement. A glance takes .15 to .5 us, a direction 1 to 100. Twice as
  // many, with twice as many shadow rays to sources (SeenSources), reduced the error from .53% to .51% beside
  // a goal and from .41% to .40% in the open-plan office, in up to a fifth more time. 30% less or more:
  // within noise (points in office; error 27%, time 6%).
  RSPHERE_TUNED(SilhouetteWeights, size_t, kGlancesPerDirection, 4);
  // Cap on the glances, but never fewer than base directions: chosen by experiment. It applies from 16384
  // base directions on. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(SilhouetteWeights, size_t, kMostGlances, 65536);
  // The variance of glances, relative to that of as many directions with the same radiances: their guesses
  // have edges but no noise of paths, of which an even set leaves half the variance
  // (ErrorEstimate::kEvenSet). Without bounces, in the open-plan office, the actual deviation is then 1.07
  // times the predicted standard error.
  RSPHERE_TUNED(SilhouetteWeights, double, kEvenGlances, .5);
  // Directions to images of light sources are one per so many base directions, and at least
  // SeenSources::kUsualRays: chosen by experiment. 30% less or more: within noise (points in office; error
  // 8%, time 6%).
  RSPHERE_TUNED(SilhouetteWeights, size_t, kBaseDirectionsPerRayToImages, 4);
};

// Which regions get directions of their own (targets.cpp).
// Glances and joins with light vertices (diffuse_glances.h).
struct DiffuseGlances {
  // Glances for each base direction. Their number costs most of the time of a point, and the error falls with
  // its root.
  RSPHERE_TUNED(DiffuseGlances, size_t, kPerDirection, 12);
  // Cap on the glances, but never fewer than base directions: the memory of those of one point, about 100 MB.
  RSPHERE_TUNED(DiffuseGlances, size_t, kMostGlances, 1 << 20);
  // Joins for each base direction. 4: error +5% around the goal at a fiftieth less time; 16: within noise.
  RSPHERE_TUNED(DiffuseGlances, double, kJoinsPerDirection, 8);
  // Vertices nearer than this share of the mean length of light paths get no more joins than others. .1 or
  // .3: within noise.
  RSPHERE_TUNED(DiffuseGlances, double, kJoinRadius, .17);
  // Light paths for each base direction, and at least, once for all points. Around the goal, 256: error -10%,
  // and a start of .4 s instead of .1 s.
  RSPHERE_TUNED(DiffuseGlances, double, kPathsPerDirection, 64);
  RSPHERE_TUNED(DiffuseGlances, double, kLeastPaths, 32768);
  // With -Sa there are as many as suit this accuracy, and more in proportion to its square if more is asked
  // for.
  RSPHERE_TUNED(DiffuseGlances, double, kUsualAccuracy, .005);
  // Cap on the light paths of all pools together: about 400 MB.
  RSPHERE_TUNED(DiffuseGlances, double, kMostPaths, 1 << 20);
  // Rays to images of light sources for each base direction. A source that is half hidden is found by them
  // alone. 1/4: an error of 3.2% instead of 2.7% at a point where the goal shows behind a partition.
  RSPHERE_TUNED(DiffuseGlances, size_t, kRaysToImages, 1);
  // What the surroundings leave to directions, as a share of the mean radiance that glances find: targets
  // are compared with it. 1 and .3: single answers 6% off around the goal, where brushed steel shows it;
  // .03: within noise, in 1.15 times the time.
  RSPHERE_TUNED(DiffuseGlances, double, kLeft, .1);
};

struct Targets {
  // Cap on the ratio of deviations, and with it on the density of a target's directions over that of the
  // base: chosen by experiment. Without it all other targets would pay for the last factor of two in density
  // of one. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(Targets, double, kMostContrast, 20000);
  // An image of a light source in a ball gets directions of its own if without them it would add more than
  // this share of the variance of all base directions: chosen by experiment. 30% less or more: within noise
  // (points in office; error below 1%, time 7%).
  RSPHERE_TUNED(Targets, double, kLeastGlint, 1e-3);
  // Standard deviation of the brightness within a region that is lit in part, relative to the brightness of
  // what lights it: the largest that values between 0 and 1 can have, if half of the region is lit. By
  // measurement for the three kinds of regions:
  // - Images of light sources in balls. 30% less: error +12%; 30% more: error -20% (points beside chrome;
  //   noise: error 5%).
  // - Openings that show daylight. In a room with a window that shows a house below an uneven sky, 512
  //   directions have errors of 3.8 2.9 2.7 2.5% (two bounces) and 51 5.9 3.8 2.3% (none) with 0 .1 .25 .5,
  //   in times that are the same within noise; without targets at openings 6.9 and 76%.
  // - Spots of daylight. With them, the default directions in two sunlit rooms have errors of 1.5 and 1.8%
  //   instead of 2.75 and 1.9%. .25 or 1: within noise.
  RSPHERE_TUNED(Targets, double, kPartlyLit, .5);
  // An opening that would give more than this share of the light at a point, if nothing hid it, gets at least
  // the number of directions below: chosen by experiment. At .1, a far window that happens to be dark in the
  // rays around a point causes errors of up to 10% instead of 5%.
  RSPHERE_TUNED(Targets, double, kLeastOpening, .01);
  // The least number of directions to such an opening: chosen by experiment. With 8, an opening of which an
  // eighth is hidden often looks open.
  RSPHERE_TUNED(Targets, double, kDirectionsToOpening, 32);
  // Expected directions in a target from which on its cells are fitted to its solid angle: chosen by
  // experiment. With 4 or 16 the errors in rooms with a window are the same; with fewer, the fit would bias
  // the mean where the number of directions and what they see depend on each other. With 8 no bias is found:
  // .02 +- .02% (128 base directions).
  RSPHERE_TUNED(Targets, double, kFewestFitted, 8);
  // Cap on the targets that are considered for that, to limit the time of comparing each with each: chosen
  // without measurement.
  RSPHERE_TUNED(Targets, size_t, kMostFitted, 256);
};

// The cells of directions in targets (cells_in_targets.cpp).
struct CellsInTargets {
  // If the cells outside targets would have to change by more than this share, all cells are scaled: chosen
  // without measurement. It matters only where targets fill nearly all of the sphere.
  RSPHERE_TUNED(CellsInTargets, double, kMostScaled, .25);
};

// Images of light sources in mirroring balls (glints.cpp).
struct Glints {
  // Reflectance of dielectrics at normal incidence: Fresnel's for the index 1.5.
  static constexpr double kFresnel = .04;
  // A source is divided so that half the width of a part is at most this, relative to its distance from the
  // ball, because the image of a wider part is noticeably curved: chosen by experiment. There are at most
  // Silhouettes::kCorners parts along each side. 30% less or more: within noise (points beside chrome; error
  // 2%, time 5%).
  RSPHERE_TUNED(Glints, double, kHalfPart, .12);
};

// Light sources that are integrated separately (seen_sources.cpp).
struct SeenSources {
  // Cap on the rays to one image, the largest of: this number of rays; one ray for each square of this side
  // (rad) in the image; and this multiple of an even share of all rays to images. Chosen by experiment. 30%
  // less or more: within noise (points by sun; error below 1%, time 4%).
  RSPHERE_TUNED(SeenSources, double, kUsualRays, 16);
  // Wide sources need it: without it, the error below a luminous ceiling that 36 balls hide partly is 2.9%
  // instead of .5% (2048 base directions). 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(SeenSources, double, kSmallestPart, .02);
  // Without it, the error of a small lamp that is half hidden would stay at 4.2% with any number of base
  // directions. With it, the error falls from 4.2% with 256 to .33% with 16384.
  //
  // Images in mirrors that would get fewer rays than this, on average, are left to the base directions:
  // chosen by experiment. A tenth of a ray means a ray at one of ten points, with ten times the weight. 30%
  // less or more: within noise (points in workshop; error 17%, time 7%).
  RSPHERE_TUNED(SeenSources, double, kSmallShare, .1);
  // Exponent of the light of an image to which its number of rays is proportional: derived. Of n parts of a
  // half hidden image only those on the shadow's edge are uncertain, so that the error of light L is
  // proportional to L n^-3/4. The sum of L^2 n^-3/2 over all images, for a given sum of n, is smallest for n
  // proportional to L^(4/5).
  static constexpr double kByLight = 4. / 5;
  // Directions, without rays, that measure the fraction of a region that its source fills: derived. An edge
  // divides about n^1/2 of n even cells, whose errors, of .3 each, add up to .3 n^-3/4 of the region: .2%.
  static constexpr size_t kShareTries = 1024;
  // Shadow rays along each side of the cell of a direction to a source that is seen straight: by
  // measurement. Where the goal shows behind the edge of a partition, 2: error 3% instead of 1.8%, at the
  // same time; 8: within noise.
  RSPHERE_TUNED(SeenSources, size_t, kShadowsAlong, 4);
  // Reflectance of glass at normal incidence: Fresnel's for the index 1.5.
  static constexpr double kFresnel = .04;
};

// The regions that silhouettes are replaced by (silhouette.cpp, silhouette_index.cpp).
struct Silhouettes {
  // Half angle (rad) around the middle of an object up to which a hull is computed instead of a cap: chosen
  // by experiment. Hulls are computed on a plane, which cannot hold a hemisphere (1.57). 30% less or more:
  // within noise (points beside chrome; error 10%, time 8%).
  RSPHERE_TUNED(Silhouettes, double, kWidestHull, 1.2);
  // Corners of the polygon around a circle: chosen by experiment. The area of the polygon is 1.3% larger.
  // Light sources with more corners are replaced by squares around them where balls show their images. 30%
  // less or more: within noise (points beside chrome; error below 1%, time 8%).
  RSPHERE_TUNED(Silhouettes, int, kCorners, 16);
  // Cells along the edge of a face of the cube map that names the silhouettes near a direction: chosen by
  // experiment. Without cells the search took 18% of the time among 180 special objects. It changes the time
  // only, and tests/bench/sensitivity does not vary it, because it is the size of a table.
  static constexpr int kSide = 6;
};

// The standard error of a mean (error_estimate.cpp).
struct ErrorEstimate {
  // The error of the mean that the coarse solution brings (-aa above 0), relative to the mean, is taken for
  // independent of that of the directions: that of its rays, where a gather is asked for so many, the second
  // number, and which falls with the root of their number; and that of its patches. By measurement: a white
  // room with a lamp, with and without a desk, of which means have .13% with 256 rays and .06 to .07% with
  // 8192. In daylit rooms they are .1 to .2% dark, beside stated errors of .6 to 1%.
  RSPHERE_TUNED(ErrorEstimate, double, kRaysOfPatches, .0006);
  static constexpr double kUsualRays = 1024;
  RSPHERE_TUNED(ErrorEstimate, double, kPatches, .0006);
  // Factor on the variance that follows from second differences of base directions: a compromise. It is .6 if
  // straight edges are all of the variance, of which an even set averages out a part, and 1 if the noise of
  // paths is.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenSet, .8);
  // The smallest number of neighbours with which second differences are used: derived. With fewer,
  // ownPartOfSecond() does not hold for their variance.
  static constexpr double kFewestAround = 4;
  // The factor for directions to the parts of a light source: chosen by experiment. Differences of successive
  // parts count an edge too often, because it lies between two parts more often than it crosses one. Where
  // the light of a source is all of the variance, the standard error is then too small (40 rotations each):
  //   predicted / actual deviation              .5 (this)    1
  //   luminous ceiling behind 36 balls          .67 to .88   .94 to 1.24
  //   lamp of .1 m, half hidden                 .69          .98
  //   ceiling with a pattern of stripes         .70 to .76   .99 to 1.08
  // 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenParts, .5);
  // The factor for n dynamic directions to a target is 1 / (1 + n^1/2 / kEvenRun): the root because an edge
  // crosses about n^1/2 of the n cells; the number chosen by experiment. n is the effective number of
  // directions that the variance is due to. With all directions of the target instead, at a point beside a
  // chrome ball where 1 to 5 of 3400 find lamps that are mirrored twice, the actual deviation was 1.6 times
  // the predicted standard error, and 2% of the answers were further off than six; now it is .9 times, and
  // none is. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(ErrorEstimate, double, kEvenRun, 8);
  // The size of an obstacle that no direction has hit, as a share of what one more direction in a target
  // would represent: a compromise. n directions miss an obstacle of the share s with the probability (1 -
  // s)^n, a third if s is 1/n.
  RSPHERE_TUNED(ErrorEstimate, double, kUnseen, .5);
};

// When -Sa has enough sets (two_halves.cpp).
struct Stopping {
  // Each half requests sets until its standard error is this multiple of the one that is wanted: by
  // measurement. Only one answer in 50, rather than one in 25, then needs more sets because its own estimate
  // is too large. Those sets cause the remaining bias. 30% less or more: within noise (stopping; error 1%,
  // time 6%).
  RSPHERE_TUNED(Stopping, double, kMargin, .95);
  // Cap on the ratio of the sets of the halves: derived. If one set finds something very bright,
  // the other half asks for many sets; the cap then gives some to the half of that set, which outweigh it
  // sooner. With 1, each half would depend on its own sets, and the bias would be that of stopping without
  // halves, so that it is the smallest number above 1.
  static constexpr size_t kMostRatio = 2;
};

// Points that almost no light reaches (estimator.cpp, two_halves.cpp).
struct Dark {
  // The mean below which -Sa gives up soon, relative to what surfaces of the scene show on average; and the
  // share of the directions that find light below which a warning names the point. Chosen without
  // measurement. Within closed furniture of metal one direction in a hundred thousand finds a gap between
  // surfaces; a million directions would not tell how much light that is within a percent. 30% less or more:
  // the same answers in all cases.
  RSPHERE_TUNED(Dark, double, kShare, 1e-3);
  // The sets after which it gives up: chosen by experiment. Within a closed column of metal they take 7 s
  // (-ab 6).
  RSPHERE_TUNED(Dark, size_t, kSets, 8);
};

// Pictures of the view from a point (draw_point.cpp, pixel_tracer.cpp, smooth_light.cpp).
struct Pictures {
  // Pixels along the height of a fisheye: about half a million pixels in all. It trades no error for time;
  // tests/bench/sensitivity draws smaller pictures.
  RSPHERE_TUNED(Pictures, int, kFisheyeSide, 800);
  // Light sources that cover fewer pixels than this are sampled separately: derived. A disc of 16 pixels
  // holds the middles of 14 to 21 of them, so that its light has a standard deviation of 6%. The light of a
  // lamp of 1.4 pixels would have one of 38% instead of .1%.
  //
  // Such a source gets as many samples for each pixel that it covers: by measurement. With 4 per pixel, lamps
  // of 4 to 16 pixels lose 3 to 9% of their light in the picture, with 16 they lose 1 to 3.5%. 30% less or
  // more: the same answers in all cases.
  RSPHERE_TUNED(Pictures, double, kSmallest, 16);
  // Samples of such a source at least. The light of a minute lamp that is half hidden then has a standard
  // deviation of 12%; with one sample it is 34%. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(Pictures, double, kLeastSamples, 4);
  // Places at which the background of a small source is looked for, in pixels from the middle of one:
  // chosen by experiment.
  static constexpr std::array<std::array<double, 2>, 4> kBeside = {
      {{-.4, -.4}, {.4, .4}, {-.4, .4}, {.4, -.4}}};
  // One pixel in a square of this side gathers indirect light, and each of those from 32 rays: chosen by
  // experiment.
  RSPHERE_TUNED(Pictures, int, kSharing, 2);
  // The same where shadow rays find all light (there is neither daylight nor glow), so that gathers are less
  // noisy: chosen by experiment in the open-plan office. 2: error -21%; 4: error +26% (picture from point,
  // which has 1% of the pixels; noise: error 4%, time 6%).
  RSPHERE_TUNED(Pictures, int, kSharingByLamps, 3);
  // Passes of smoothing of indirect light: chosen by experiment. 2: error +10%; 4: within noise (picture from
  // point; noise: error 1%, time 6%).
  RSPHERE_TUNED(Pictures, int, kIndirectPasses, 3);
  // Further passes for indirect and direct light, limited by the difference of light below, and passes for
  // gloss: chosen by experiment. The noise that the first passes leave is 2 to 5%. 1 or 3: within noise
  // (picture from point; error below 1%, time 6%).
  RSPHERE_TUNED(Pictures, int, kFinePasses, 2);
  RSPHERE_TUNED(Pictures, float, kSameLight, .14f);
  // Least roughness of surfaces whose pixels share gloss: derived. The lobe is about as wide as the gloss of
  // two passes is blurred, 2.2 pixels or .014 radians.
  static constexpr double kLeastRoughness = .02;
  // Cosine between the normals of pixels that share gloss: derived. They are 2 degrees apart, less than the
  // width of such a lobe.
  static constexpr float kSameGlossNormal = .9994f;
  // Pixels that differ from a neighbor by more than this, of 1 on the sRGB curve, are traced near their
  // corners as well, and near the middles of their sides if these rays differ by more: chosen by experiment.
  // 30% less: error -2%; 30% more: error +3% (picture from point; noise: error below 1%, time 6%).
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
  // Two pixels share indirect light if the cosine between their normals is at least this: chosen by
  // experiment. .87 or .93: within noise (picture from point; error below 1%, time 6%).
  RSPHERE_TUNED(Pictures, float, kSameNormal, .9f);
  // Furthermore, their distance must be at most this share of that from the eye, and the height of one point
  // over the plane of the other at most this share of their distance. 30% less: error +25%; 30% more: error
  // -13% (picture from point, which has 1% of the pixels, so that edges count more; noise: error 2%, time
  // 6%).
  RSPHERE_TUNED(Pictures, float, kNear, .25f);
};

}  // namespace rsphere::tuning
