#pragma once
// Tuning constants (base/tuned.h). They affect variance and time; Interpolation also affects the mean. Files
// of measurements are in tests/bench/rtrace/runs.
#include "base/tuned.h"

namespace rsphere::tuning {

// The fractions of the directions of gathers that are aimed (gather_directions.cpp). They are proportional to
// the estimated light from openings, from spots and from elsewhere. Variance x time is that of paths
// without interpolation, relative to the chosen value, in four daylit rooms: a narrow and a wide one, each
// with an overcast sky and with sun.
struct GatherDirections {
  // Ratio of the fraction of directions aimed at openings, or at spots, to the estimated fraction of light
  // from them. Measured for openings: variance x time 1.3 .9 1 1 with .5, and 7.8 2.4 1.1 1.2 with .3. For
  // spots, the results from .5 to .9 do not differ beyond noise.
  RSPHERE_TUNED(GatherDirections, double, kAimed, .7);
  // Factor on the estimate of the light from elsewhere, which is the smaller of two estimates. Both are made
  // near openings, where rooms are brighter than farther inside. Measured: variance x time 4.8 2.3 .8 1 with
  // 1.
  RSPHERE_TUNED(GatherDirections, double, kFartherInside, .5);
};

// Rays that a sensor (-I) adds where its gather is noisy (indirect_light.cpp).
struct SensorNoise {
  // Rays are added until the standard error of the gather is at most -aa divided by kAccuracy, or until
  // kMostAdded times -as, or -ad if that is smaller, are added. Measured in six daylit rooms: with 20 and 12
  // instead of 30, sensors have 1.06 and 1.2 times the error for equal times, because patches take most of
  // the time (2026-11-29-sensors.txt). kMostAdded: with 8, sensors below a shaft have an error of 2.3% in
  // .36 s (-as 512); with 24, 1.3% in .44 s (2026-11-27-patches.txt).
  static constexpr double kAccuracy = 30, kMostAdded = 24;
  // If the rays to be added are fewer than those already sent divided by this, none are added, because so few
  // would be unevenly distributed over the hemisphere.
  static constexpr int kFewestAdded = 8;
};

// When and how light is interpolated (indirect_light.cpp, final_gather.cpp).
struct Interpolation {
  // Light is interpolated unless a texture tilts the normal by an angle whose cosine is below this, since
  // the moments of gathered light are then less accurate. Chosen by experiment: raising it by 30% reduces
  // the time by 23% (picture of workshop).
  RSPHERE_TUNED(Interpolation, double, kLeastUpright, .7);
  // The number of rays of a record of the irradiance cache is this divided by the square of -aa, by lamps,
  // by openings and by sun through openings (LitBy), but at most -ad plus -as, and at least 1/kPart of that
  // sum. The error of interpolation, which -aa bounds, is then larger than the noise of the records. Measured
  // at -aa .15: by lamps, half of the rays take a quarter less time for nearly equal errors; by daylight,
  // 128 instead of 768 rays a quarter of the time for a median error of 3.5 instead of 2.5% behind blinds,
  // and an equal one below a skylight (2026-11-27-patches.txt). By sun, with 98 instead of 128, a bedroom
  // behind blinds takes .82 of the time for a median error of 6.8 instead of 5.5% (RADIANCE's: 21%;
  // 2026-11-29-pictures.txt). The light of walls near patches of sun varies over short distances, so that
  // interpolation errs more than the records. Below a diffuse sky it varies little, and their noise is seen
  // as clouds: with 98 rays 3.7 instead of 2.9% in a museum (2026-11-30-pictures.txt).
  RSPHERE_TUNED(Interpolation, double, kRaysByLamps, 7.5);
  RSPHERE_TUNED(Interpolation, double, kRaysByOpenings, 2.7);
  RSPHERE_TUNED(Interpolation, double, kRaysBySun, 2.2);
  static constexpr int kPartByLamps = 2, kPartByOpenings = 6, kPartBySun = 8;
  // Number of rays that estimate the distances around a site (root mean square and harmonic mean): derived.
  // If single distances vary as much as their mean, the mean is known within 25%, half of the step between
  // the sides of cells, which are powers of two. Insensitive.
  static constexpr int kReachRays = 16;
};

// Limits on the number of rays into which a ray splits (ray_limits.h).
struct RayLimits {
  // If a ray of a gather has more than this number of descendants, further descendants of low weight are
  // subject to Russian roulette. The ancestors of a further descendant are not counted. For a primary ray of
  // sphere mode, the limit is this number times -ad plus -as. Measured: 99% of the directions in a room with
  // a chrome column have fewer descendants (-ab 6, -ad 4).
  //
  // Sharp paths of a gather's ray are subject to Russian roulette if their weight is below the inverse of
  // this; the probability of survival is proportional to their weight. Gathers start with a weight of 1/2, so
  // that a ray has on average at most half this number of descendants at a time. Without a limit, that number
  // doubles at each surface of nested transparent objects, up to -lr. With 32, three nested cylinders take a
  // fifth less time, but there is more noise behind a pane that transmits 5%.
  RSPHERE_TUNED(RayLimits, double, kMostDescendants, 64);
  // The number of rays into which a ray may split regardless of weight: derived. A surface that it hits may
  // reflect one and transmit one. It limits
  // - the descendants of each ray of a patch of the coarse solution, on average. Measured: without a limit,
  //   most patches between two boxes of rough trans would have 16 to 40; with 8, a point in front of these
  //   boxes takes twice the time for equal noise;
  // - the patches that a ray of a gather, or a primary ray of sphere mode, uses regardless of weight.
  static constexpr int kFreely = 2;
  // Beyond kFreely patches, a ray of a gather uses about kFurther more, with probabilities proportional to
  // weight. A ray requests 5 patches in an open-plan office, and 12 between boxes of rough trans. Most
  // contribute little, and each sends rays: without a limit, a point in front of the boxes takes twice the
  // time. Measured there, kFreely and kFurther: 2 and 8 have 6% of noise, 2 and 4 37%, 1 and 1 90%.
  RSPHERE_TUNED(RayLimits, double, kFurther, 8);
  // Number of patches that each ray of a patch uses, without further ones. It is the smallest possible
  // number, because rays of patches are numerous. With 4, the point in front of the boxes takes twice the
  // time for equal noise.
  static constexpr int kAskedByPatch = 1;
};

// Sharp reflection and refraction (specular_light.cpp).
struct SpecularLight {
  // Sharp paths of indirect rays are subject to Russian roulette if their weight, relative to the weight of
  // the arriving ray, is below this. One in three reflections by a pane is then followed. Measured in four
  // daylit rooms without interpolation: it reduces the time for equal noise by 3 to 22%; with 1, the noise is
  // up to 1.5 times as large. Without it, variance x time is 1.11 to 1.25 times as large in three sunlit
  // rooms (tests/bench/mechanisms/runs/2026-11-29-tails.txt).
  RSPHERE_TUNED(SpecularLight, double, kWeakBranch, .25);
  // Number of samples of a lobe that a point of sphere mode sees directly, if the lobe's share is at least
  // VertexLight::kStrong: few of the directions see a rough column. Measured 6 cm beside a column of brushed
  // steel: with 1, 4 and 16, 7.2, 3.3 and 3.2% of noise in .51, .52 and .62 s (2026-11-28-random-rooms.txt).
  RSPHERE_TUNED(SpecularLight, int, kOfPoint, 4);
};

// Shadow rays (direct_light.cpp).
struct DirectLight {
  // Rays of a gather for each shadow ray of its surface (outgoing_light.cpp). Measured for a sensor in the
  // half-shadow of the sun, with -ad 1024: with 64 and 4, 18 and 4% of noise, in the same time
  // (2026-11-29-random-rooms.txt).
  static constexpr int kRaysForShadowRay = 4;
  // Of more sources than this, each is drawn as often as of this number: once for 64 rays of the gather.
  static constexpr size_t kFewDrawn = 16;
  // With a jitter (-dj) above this, the rays of gathers do not divide sources into parts, because one sample
  // is then spread over more than half of its source.
  static constexpr double kWideJitter = .5;
  // Up to this number of sources, a glimpse samples all of them. With 32, sensors in a tower with stairwells
  // start in 3.4 instead of .9 s; with 512, sensors in a tower without stairwells in 1.0 instead of .6 s.
  static constexpr size_t kFewOfGlimpse = 128;
  // Of more sources, a glimpse samples up to this times the square root of their number. Where a stairwell of
  // 160 storeys shows a lamp of each, sensors start in 3.5 instead of 130 s without this rule; with 8, in 2.2
  // s, but without stairwells in 1.8 instead of 1.0 to 1.3 s.
  static constexpr size_t kManyOfGlimpse = 5;
};

}  // namespace rsphere::tuning
