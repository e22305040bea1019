#pragma once
// Tuning constants (base/tuned.h) of pictures (-Si).
#include <array>
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// Pictures of the view from a point (draw_point.cpp, pixel_tracer.cpp, smooth_light.cpp).
struct Pictures {
  // Height of a fisheye in pixels: the least that evalglare(1) of RADIANCE recommends.
  // tests/bench/sensitivity draws smaller pictures.
  RSPHERE_DERIVED(Pictures, int, kFisheyeSide, 800);
  // Least exposed brightness that is shown as white (ToneCurve), 15 times the median: derived. If the
  // brightest pixel became white in pictures without lamps and windows, their walls would be white. With
  // this value, the median is shown as .504 in sRGB instead of .5.
  static constexpr double kLeastWhite = 4;
  // Light sources that cover fewer pixels than this are sampled separately: derived. A disc of 16 pixels
  // covers the middles of 14 to 21 pixels, which gives its light a standard deviation of 6%; of 1.4 pixels,
  // 38%, with separate samples .1%. Also the number of samples of such a source per covered pixel, and the
  // minimum per source: measured. With 4, lamps of 4 to 16 pixels lose 3 to 9% of their light, with 16 1 to
  // 3.5%. Insensitive.
  static constexpr double kSmallest = 16;
  // Offsets from the middle of a pixel (in pixels) of the rays that look for the background behind a small
  // source: chosen by experiment.
  static constexpr std::array<std::array<double, 2>, 4> kBeside = {
      {{-.4, -.4}, {.4, .4}, {-.4, .4}, {.4, -.4}}};
  // Side of a square of pixels (in pixels), of which one gathers indirect light, with 32 rays: derived. It is
  // the smallest side with which pixels share light.
  static constexpr int kSharing = 2;
  // kSharing where shadow rays find all light (neither daylight nor glow), so that gathers are less noisy:
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
  // Images in mirrors that contribute less than this fraction to a pixel do not decide which pixels share the
  // indirect light of images: derived. Paths that weak exist at random, because -lw ends most of them.
  static constexpr double kFaintImage = 1e-3;
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
  // than the width of a shared lobe. Where the roughness is a larger angle, that is the limit.
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
  // Rays up to which pixels beside the edge of a shadow on one surface are traced, and those whose direct
  // light differs: chosen by experiment. The half-shadow of the sun is about as wide as a pixel and thirty
  // times as bright as a floor beside it, so that the noise of nine rays frays its edge
  // (2026-11-30-pictures.txt).
  static constexpr size_t kByShadows = 16, kMostRays = 40;
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
