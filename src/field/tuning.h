#pragma once
// Tuning constants (base/tuned.h). They determine the spacing of interpolated light, its bias, time and
// memory. "Chosen by experiment": on pictures (tests/bench/rtrace/runs/2026-11-21-interpolated.txt).
#include "base/tuned.h"

namespace rsphere::tuning {

// Constants that the irradiance cache and the coarse solution share.
struct Fields {
  // Surroundings at this distance, relative to the size of the scene, are treated as open. It bounds the side
  // of cells, and the mean distance of surroundings that determines the side of patches. Chosen by
  // experiment. Reducing it by 30% has no effect beyond noise; increasing it by 30% reduces the time by 28%
  // (sensors by sun).
  RSPHERE_TUNED(Fields, double, kOpen, .1);
  // Number of finer levels that are tried if a place sees no site or patch. Chosen by experiment. 1 and 3
  // have no effect beyond noise (sensors by sun).
  static constexpr int kFinerWhereHidden = 2;
};

// The irradiance cache at the first diffuse surface (irradiance_field.cpp).
struct IrradianceField {
  // Size of the room around a site, relative to the root mean square distance of the surfaces that the site
  // sees. RADIANCE's -ar relates the finest spacing to the size of the scene. Here it is related to the size
  // of the room if the room is smaller, because most daylight models have a wide ground. Chosen by experiment
  // in rooms on a ground of 0 to 5 km, by the error in thin gaps and the number of gathers. With 4, the light
  // between louvres is 3% too dark. With 2.5, furnished rooms need 3% more gathers.
  //
  // The constant has a second use: the side of the widest cells is -aa times kRoom times the harmonic mean
  // distance of their surroundings. Chosen by experiment. Insensitive.
  RSPHERE_TUNED(IrradianceField, double, kRoom, 3.2);
  // Upper bound on the finest spacing, relative to the height of the gap that contains a place (the distance
  // to the first surface along its normal). Measured between louvres: with 1, 2.6% of the places are wrong by
  // a factor of 1.5, instead of .7%; .125 does not reduce the errors further, and needs 3% more gathers in a
  // furnished room.
  RSPHERE_TUNED(IrradianceField, double, kFinestInGap, .25);
  // -aa divided by this is the allowed relative error of an interpolation. Chosen by experiment. In RADIANCE,
  // -aa bounds the error, and the mean error is smaller. Insensitive.
  static constexpr double kAllowed = 2.4;
  // If the error of a level of cells is at most the allowed one, that level gives the whole answer. If the
  // error is this many times the allowed one or more, the level is not used. In between it is blended with
  // the next level, to avoid visible edges. The allowed error grows by this factor from level to level,
  // because smaller cells cover a smaller part of a picture. Chosen by experiment. Insensitive.
  //
  // The constant is also the safety margin for extrapolations. The relative error of an extrapolation over a
  // distance d is predicted as this constant times the larger of two quantities: the relative change that the
  // gradients predict over d; and this constant times (d / R)^2, where R is the harmonic mean distance of the
  // surroundings. Insensitive.
  static constexpr double kNoneAbove = 1.5;
};

// Interpolation between the sites around a place (site_interpolation.cpp).
struct SiteInterpolation {
  // Differences between sites below this number of standard errors are treated as noise. Chosen by
  // experiment. Insensitive.
  static constexpr double kChance = .7;
  // The error of an interpolation is predicted from three quantities at two sites:
  // - the change of the gradient (site_interpolation.cpp);
  // - the difference of their light, divided by this;
  // - the part of that difference that the gradients do not predict, also divided by this.
  // The last two detect edges of shadows between the sites, which gradients do not show. Chosen by
  // experiment. Insensitive.
  static constexpr double kByStep = 5;
  // Factor on the gradients of the sites. With half of each gradient, interpolation is exact for quadratic
  // functions.
  static constexpr float kSlopes = .5F;
  // The error of an interpolation is predicted as the change of the gradient between two sites, along the
  // segment between them, divided by this. For a quadratic function f that change is f'' h^2, and the error
  // of a linear interpolation is at most f'' h^2 / 8.
  static constexpr double kBySlopes = 8;
  // Lower bound on an extrapolated light, relative to the interpolated one. Without it, the light beside
  // bright surfaces becomes negative where cells are wide (with -aa 1 -ar 4 in an office, some pixels are
  // black).
  static constexpr float kLeast = .05F;
};

// The coarse solution beyond the first diffuse surface (coarse_solution.cpp). "Measured" values were chosen
// by the error of 40 sensors and the time in two daylit rooms (a classroom of 10 x 7 m and a cell with a
// small window), each with sun and with an overcast sky:
// tests/bench/rtrace/runs/2026-11-22-coarse-solution.txt.
struct CoarseSolution {
  // Side of a patch at -aa .1, relative to the harmonic mean distance of its surroundings. For -aa below .1
  // it is proportional to -aa. For -aa above .1 it is proportional to the root of -aa, since the error of an
  // interpolation grows with the square of the spacing. Measured:
  //   kSpacing   mean error in a narrow room   time
  //   .4         .7%
  //   .3         .4%                           1
  //   .2         .3%                           1.2
  // With .6 (and .18 for kFarPatch, .1 for kLeastPatch), sensors near a window with blinds are 17% too
  // bright.
  RSPHERE_TUNED(CoarseSolution, double, kSpacing, .3);
  // Paths are followed if the viewing distance or the extent of the surface is below this multiple of a
  // patch's side. Insensitive.
  static constexpr double kHalf = .5;
  // The side of a patch is at most this fraction of the viewing distance, down to the smallest patches of its
  // surface. Measured for sensors between boards close above each other, lit by a lamp: with .5, they are .7%
  // too dark, because wide patches do not follow the light in a gap; with .25 they are .1% too dark, in an
  // equal time (tests/bench/rtrace/runs/2026-11-27-patches.txt).
  static constexpr double kNear = .25;
  // Sufficient side of a patch, relative to the viewing distance. Measured with sensors in nine daylit rooms:
  // with .09, they are 1.1% too bright below a shaft, because its light varies within a meter, and take up to
  // twice the time, because places at different distances use patches of different levels
  // (tests/bench/rtrace/runs/2026-11-27-patches.txt).
  RSPHERE_TUNED(CoarseSolution, double, kFarPatch, .02);
  // kNear, kFarPatch and kUsualShare if patches are used at the first bounce. Measured: with the three values
  // above, spherical means in four daylit rooms take 1.4 times the time for equal errors
  // (tests/bench/rtrace/runs/2026-11-27-patches.txt).
  static constexpr double kNearAtFirst = .5, kFarPatchAtFirst = .09, kUsualShareAtFirst = .008;
  // Lower bound on the side of a patch, relative to its surface's extent. Without it, patches in a corner,
  // where everything is near, would be divided without end. Measured in three daylit rooms: with .05, the
  // errors are equal and a room with a small window takes a tenth more time; with .07, its bias at -aa .05 is
  // .3 instead of .2% (tests/bench/rtrace/runs/2026-11-28-patches.txt). With .02, the time is three times as
  // long.
  RSPHERE_TUNED(CoarseSolution, double, kLeastPatch, .06);
  // Factor on kSpacing, kFarPatch and kLeastPatch in scenes without daylight openings. Measured in RADIANCE's
  // office and cabin (tests/bench/rtrace/runs/2026-11-25-lamps.txt). With 1, pictures take a third more time
  // for the same error. With 3, they take a tenth to a sixth less time, but errors of spherical means are 1.4
  // times as large. If patches are used at the first bounce, the least number of their rays grows with the
  // square of this factor, as their area does.
  RSPHERE_TUNED(CoarseSolution, double, kCoarserByLamps, 2);
  // In scenes without daylight openings, patches that are only seen by other patches are enlarged by this
  // number of levels, unless patches are used at the first bounce: 2 would then make the errors of spherical
  // means three times as large (measured).
  static constexpr int kCoarserLinksByLamps = 2;
  // Factor on the rays of a patch, in the scenes of kCoarserLinksByLamps. Measured in pictures of RADIANCE's
  // cabin and office: with 1, they take 1.4 and 1.3 times the time for the same errors; with .25, sensors in
  // a room with gaps have 1.4 times the error (tests/bench/rtrace/runs/2026-11-27-patches.txt).
  static constexpr double kFewerByLamps = .5;
  // The smallest patches of a surface are chosen as if its extent were at most this fraction of the scene's
  // longest side, because rooms on a wide ground are much smaller than the ground. Chosen by experiment.
  // Reducing it by 30% makes sensors by sun take 65% more time; increasing it by 30% has no effect beyond
  // noise.
  RSPHERE_TUNED(CoarseSolution, double, kWidestExtent, .4);
  // Number of patches across a narrow strip, such as a slat, where the patches of its level are wider than
  // the strip, but its surroundings require patches narrower than it. Measured: with 1, sensors near a window
  // with blinds are 33% too bright; with 4, 8 and 16 they are 1.2%, .8% and .6% too bright.
  RSPHERE_TUNED(CoarseSolution, int, kPartsAcross, 8);
  // One of the six sides of a ball, or a cone, is enclosed if the root mean square distance of the
  // surroundings is below kEnclosed times the radius at each of kEnclosedPlaces places on it. The threshold
  // separates two cases: shells with a gap of a third of the inner radius (ratio .47 in the middle), and a
  // ball in a tight room. In narrow shells the curvature hides most sites from the places around them, so
  // that finer and finer patches are tried, each of which serves few places. Without this rule, gathers
  // between five shells of rough trans make more than 140,000 patches.
  static constexpr size_t kEnclosedPlaces = 8;
  static constexpr double kEnclosed = .6;
  // Lower bound on the side of a patch of an enclosed surface, relative to the surface's extent. Chosen
  // with the five shells above, and tried in no other scene: a point in sphere mode takes 4 s, not minutes.
  static constexpr double kLeastPatchEnclosed = .2;
  // Number of rays of a patch for each ray of a gather (-ad plus -as). Measured in daylit rooms: .1 instead
  // of .07 takes a third more time for a tenth less error.
  RSPHERE_TUNED(CoarseSolution, double, kRays, .06);
  // A patch sends the usual number of rays if its share in the light on the room's other surfaces has this
  // value. The number of rays is proportional to that share, which minimizes the noise for a given total
  // number. The share is about the patch's area divided by the square of the room's size. Outdoors, it is
  // reduced by the fraction of sky that the patch sees, and by the square of its distance from other
  // surfaces. The value is the share of a square of 31 cm in a room of 4 m. Measured:
  // - With .008, a room with a window has a fifth more noise, and a classroom takes a fifth less time.
  // - With .012, sunlit rooms have 15% more noise, and take a tenth less time.
  // - Using the patch's mean distance to its surroundings instead of the room's size gives patches below
  //   desks and in gaps so many rays that four daylit rooms take 1.3 to 3 times the time for the same error.
  RSPHERE_TUNED(CoarseSolution, double, kUsualShare, .006);
  // Upper bound on the number of rays of a patch, relative to the usual number. Without daylight, 1 is used
  // instead. Measured: with 2.5, a sunlit classroom has 15% more noise; with 8, it has the noise of 4 and
  // takes a sixth more time.
  //
  // It also bounds the growth of the usual number by daylight. Below -aa .1, the usual number is inversely
  // proportional to -aa, because all places that see a patch share its noise. Measured: without this growth,
  // the noise of sensors in a sunlit classroom at -aa .05 is .65%. Where the growth ends, patches do not
  // become smaller either.
  RSPHERE_TUNED(CoarseSolution, double, kMoreRays, 4);
  // Patches with at least this number of rays send them from 16 places, others from 4. Measured below north
  // lights at -aa .05: with 4 places for all patches, the noise of sensors is .58 instead of .50% by an
  // overcast sky and .65 instead of .47% by sun; with 16 places from 64 rays on, it is equal, and takes a
  // tenth more time at -aa .1. Places must be random: with the four places of Gauss-Legendre quadrature in
  // all patches, sensors by sun are 1.2% too dark (tests/bench/rtrace/runs/2026-11-28-patches.txt).
  static constexpr double kManyRays = 256;
  // By daylight, the light of patches with fewer rays has no slopes, because they would be noise. Measured:
  // if all patches have at most 31 rays, slopes double the noise of spherical means in a room with a window.
  // By lamps, only links do without slopes, if there are several solutions
  // (tests/bench/rtrace/runs/2026-11-29-coves.txt).
  static constexpr double kFewestForSlopes = 32;
  // Least number of rays of a patch. Measured: with 16, the same error takes up to a sixth more time.
  RSPHERE_TUNED(CoarseSolution, double, kLeastRays, 8);
  // The same by daylight where there are several solutions, whose light is averaged: one ray from each site.
  // Measured with -Sa .01: with 8, sensors in a sunlit classroom take 1.4 times the time for the same error,
  // and sensors below north lights 1.06 (tests/bench/rtrace/runs/2026-11-29-sensors.txt).
  static constexpr double kLeastRaysOfSolutions = 4;
  // The -aa at which kSpacing of tuning::CoarseSolution is the relative side of a patch, and kRays its
  // relative number of rays.
  static constexpr double kUsualAccuracy = .1;
  // Cap on the rays of a patch. The noise is then 1/64 of the noise of one ray, less than other errors.
  static constexpr double kMostRays = 4096;
  // The light of a patch has slopes if the determinant of the covariance of its sites' places is above this.
  // It is 1/144 for places all over the patch, and 0 for places on a line.
  static constexpr float kLeastDeterminant = 2e-4f;
};

// The cells of surfaces (surface_cells.cpp).
struct SurfaceCells {
  // Number of points in a cell that are tried in turn until one lies on the surface. If the surface fills an
  // eighth of a cell, (7/8)^24 = 4% of such cells get no site.
  static constexpr int kCandidates = 24;
  // Number of edges of a polygon that are compared to align the frame with the longest. A polygon with more
  // edges is nearly round, and any frame suits it.
  static constexpr uint32_t kEdges = 16;
  // Offset from a cell's middle, relative to its side; an irregular number, unlike coordinates of scenes.
  static constexpr double kAside = .01371;
};

}  // namespace rsphere::tuning
