#pragma once
// Tuning constants (base/tuned.h). They determine the spacing of interpolated light, its bias, time and
// memory. "Chosen by experiment": on pictures (tests/bench/rtrace/runs/2026-11-21-interpolated.txt).
#include "base/tuned.h"

namespace rsphere::tuning {

// Constants that the irradiance cache and the coarse solution share.
struct Fields {
  // Surroundings at this distance, relative to the size of the scene, are treated as open. It bounds the side
  // of cells, and the mean distance that determines the side of patches. Chosen by experiment; raising it by
  // 30% reduces the time by 28% (sensors by sun).
  RSPHERE_TUNED(Fields, double, kOpen, .1);
  // Number of finer levels that are tried if a place sees no site or patch. Insensitive.
  static constexpr int kFinerWhereHidden = 2;
};

// The irradiance cache at the first diffuse surface (irradiance_field.cpp).
struct IrradianceField {
  // Size of the room around a site, relative to the root mean square distance of the surfaces that the site
  // sees; where it is smaller than the scene, it takes the place of the scene's size in RADIANCE's -ar.
  // Chosen by the error in thin gaps and the number of gathers, in rooms on a ground of 0 to 5 km: with 4,
  // the light between louvres is 3% too dark; with 2.5, furnished rooms need 3% more gathers.
  // Also: the side of the widest cells is -aa times kRoom times the harmonic mean distance of their
  // surroundings. Insensitive.
  RSPHERE_TUNED(IrradianceField, double, kRoom, 3.2);
  // Upper bound on the finest spacing, relative to the height of the gap that contains a place (the distance
  // to the first surface along its normal). Measured: with 1, 2.6 instead of .7% of the places between
  // louvres are wrong by a factor of 1.5; .125 is no better.
  RSPHERE_TUNED(IrradianceField, double, kFinestInGap, .25);
  // -aa divided by this is the allowed relative error of an interpolation. Chosen by experiment. In RADIANCE,
  // -aa bounds the error, and the mean error is smaller. Insensitive.
  static constexpr double kAllowed = 2.4;
  // A level of cells gives the whole answer if its error is at most the allowed one, and none of it from this
  // many times that error on; in between it is blended with the next level, to avoid visible edges. The
  // allowed error grows by this factor from level to level, because smaller cells cover less of a picture.
  // Also the safety margin of extrapolations: their relative error over a distance d is predicted as this
  // times the larger of the change that the gradients predict, and this times (d / R)^2, where R is the
  // harmonic mean distance of the surroundings. Chosen by experiment. Insensitive.
  static constexpr double kNoneAbove = 1.5;
};

// Interpolation between the sites around a place (site_interpolation.cpp). Its error is predicted from the
// change of the gradient between two sites, and from their difference, which shows edges of shadows.
struct SiteInterpolation {
  // Differences between sites below this number of standard errors are treated as noise. Chosen by
  // experiment. Insensitive.
  static constexpr double kChance = .7;
  // Divisor of the difference of the light of two sites, and of the part of it that the gradients do not
  // predict. Chosen by experiment. Insensitive.
  static constexpr double kByStep = 5;
  // Factor on the gradients of the sites. With half of each gradient, interpolation is exact for quadratic
  // functions.
  static constexpr float kSlopes = .5F;
  // Divisor of the change of the gradient along the segment between two sites. For a quadratic function f
  // that change is f'' h^2, and the error of a linear interpolation is at most f'' h^2 / 8.
  static constexpr double kBySlopes = 8;
  // Lower bound on an extrapolated light, relative to the interpolated one. Without it, light beside bright
  // surfaces becomes negative where cells are wide.
  static constexpr float kLeast = .05F;
};

// The coarse solution beyond the first diffuse surface (coarse_solution.cpp). "Measured" values were chosen
// by error and time: of 40 sensors in two daylit rooms, each with sun and with an overcast sky
// (tests/bench/rtrace/runs/2026-11-22-coarse-solution.txt), of others and of spherical means in nine daylit
// rooms (2026-11-27-patches.txt), or by lamps in RADIANCE's office and cabin (2026-11-25-lamps.txt).
struct CoarseSolution {
  // Side of a patch at -aa .1, relative to the harmonic mean distance of its surroundings. Below -aa .1 it is
  // proportional to -aa; above, to the root of -aa, since the error of an interpolation grows with the square
  // of the spacing. Measured: with .4, .3 and .2, the mean error in a narrow room is .7, .4 and .3%; .2 takes
  // 1.2 times the time.
  RSPHERE_TUNED(CoarseSolution, double, kSpacing, .3);
  // Paths are followed if the viewing distance or the extent of the surface is below this multiple of a
  // patch's side. Measured: with .5, sensors between two buildings are 1.5% too bright at -Sa .015, those of
  // a room with a door and frosted panes 1.2 +- .2% too dark at -aa .1. For equal noise, sensors then take
  // 1.35 times the time at -Sa .01, .9 times at -aa .1, and spherical means 1.05 times
  // (2026-11-30-near-patches.txt).
  RSPHERE_TUNED(CoarseSolution, double, kSidesForPaths, 2);
  // The side of a patch is at most this fraction of the viewing distance, down to the smallest patches of its
  // surface. Measured between boards close above each other: with .5, sensors are .7% too dark, with .25 .1%,
  // in an equal time.
  static constexpr double kNear = .25;
  // Sufficient side of a patch, relative to the viewing distance. Measured: with .09, sensors below a shaft
  // are 1.1% too bright, and take up to twice the time, because places at different distances use patches of
  // different levels.
  RSPHERE_TUNED(CoarseSolution, double, kFarPatch, .02);
  // kNear, kFarPatch and kUsualShare if patches are used at the first bounce. Measured: with the values
  // of other bounces, spherical means take 1.4 times the time for equal errors.
  static constexpr double kNearAtFirst = .5, kFarPatchAtFirst = .09, kUsualShareAtFirst = .008;
  // Lower bound on the side of a patch, relative to its surface's extent; without it, patches in a corner
  // would be divided without end. Measured: with .05, a room with a small window takes a tenth more time for
  // equal errors; with .07, its bias at -aa .05 is .3 instead of .2% (2026-11-28-patches.txt).
  RSPHERE_TUNED(CoarseSolution, double, kLeastPatch, .06);
  // Factor on kSpacing, kFarPatch and kLeastPatch in scenes without daylight openings. Measured: with 1,
  // pictures take a third more time for the same error; with 3, a tenth to a sixth less, but errors of
  // spherical means are 1.4 times as large. If patches are used at the first bounce, the least number of
  // their rays grows with the square of this factor, as their area does.
  RSPHERE_TUNED(CoarseSolution, double, kCoarserByLamps, 2);
  // In scenes without daylight openings, patches that are only seen by other patches are enlarged by this
  // number of levels, unless patches are used at the first bounce: 2 would then make the errors of spherical
  // means three times as large (measured).
  static constexpr int kCoarserLinksByLamps = 2;
  // Factor on the rays of a patch, in the scenes of kCoarserLinksByLamps; not on the least number of several
  // solutions. Measured: with 1, pictures take 1.3 to 1.4 times the time for the same errors, and sensors at
  // -Sa .01 1.2 to 2 times; with .25, sensors in a room with gaps have 1.4 times the error.
  static constexpr double kFewerByLamps = .5;
  // The smallest patches of a surface are chosen as if its extent were at most this fraction of the scene's
  // longest side, because rooms on a wide ground are much smaller than the ground. Chosen by experiment.
  // Reducing it by 30% makes sensors by sun take 65% more time.
  RSPHERE_TUNED(CoarseSolution, double, kWidestExtent, .4);
  // Number of patches across a narrow strip, such as a slat, where the patches of its level are wider than
  // the strip, but its surroundings require patches narrower than it. Measured: with 1, 4, 8 and 16, sensors
  // near a window with blinds are 33, 1.2, .8 and .6% too bright.
  RSPHERE_TUNED(CoarseSolution, int, kPartsAcross, 8);
  // One of the six sides of a ball, or a cone, is enclosed if the root mean square distance of the
  // surroundings is below kEnclosed times the radius at each of kEnclosedPlaces places on it. Curvature then
  // hides most sites from the places around them, so that finer and finer patches would be tried: more than
  // 140,000 between five shells of rough trans. kEnclosed is between that of shells with a gap of a third of
  // the inner radius (.47) and of a ball in a tight room.
  static constexpr size_t kEnclosedPlaces = 8;
  static constexpr double kEnclosed = .6;
  // Lower bound on the side of a patch of an enclosed surface, relative to the surface's extent. Chosen
  // with the five shells alone: a point in sphere mode takes 4 s, not minutes.
  static constexpr double kLeastPatchEnclosed = .2;
  // Number of rays of a patch for each ray of a gather (-ad plus -as). Measured: .1 instead of .07 takes a
  // third more time for a tenth less error.
  RSPHERE_TUNED(CoarseSolution, double, kRays, .06);
  // A patch sends the usual number of rays if its share in the light on the room's other surfaces has this
  // value, that of a square of 31 cm in a room of 4 m. The number is proportional to that share, which
  // minimizes the noise for a given total. The share is about the patch's area divided by the square of the
  // room's size; outdoors, it is reduced by the fraction of sky that the patch sees, and by the square of its
  // distance from other surfaces. Measured: with .008 and .012, a fifth and a tenth less time for a fifth and
  // 15% more noise. With the patch's mean distance instead of the room's size, patches in gaps get so many
  // rays that daylit rooms take 1.3 to 3 times the time.
  RSPHERE_TUNED(CoarseSolution, double, kUsualShare, .006);
  // Upper bound on the number of rays of a patch, relative to the usual number; without daylight it is 1.
  // Measured: with 2.5, a sunlit classroom has 15% more noise; with 8, it takes a sixth more time for equal
  // noise.
  // Also bounds the growth of the usual number by daylight, which below -aa .1 is inversely proportional to
  // -aa, because all places that see a patch share its noise. Where that ends, patches do not become smaller
  // either.
  RSPHERE_TUNED(CoarseSolution, double, kMoreRays, 4);
  // Patches with at least this number of rays send them from 16 places, others from 4. Measured below north
  // lights at -aa .05: with 4 places for all, the noise of sensors is .65 instead of .47% by sun. Places must
  // be random: with those of Gauss-Legendre quadrature, sensors are 1.2% too dark (2026-11-28-patches.txt).
  static constexpr double kManyRays = 256;
  // By daylight, the light of patches with fewer rays has no slopes: with slopes of at most 31 rays,
  // spherical means in a room with a window have twice the noise (measured). By lamps, only links do without
  // slopes, if there are several solutions (2026-11-29-coves.txt).
  // With several solutions, which have few rays each: measured. With 32, sensors in a cell with a window have
  // 1.2 times the variance at -Sa .01, and take a fifth more time (2026-11-30-lattices.txt).
  static constexpr double kFewestForSlopes = 32, kFewestOfSolutions = 48;
  // Least number of rays of a patch. Measured: with 16, the same error takes up to a sixth more time.
  RSPHERE_TUNED(CoarseSolution, double, kLeastRays, 8);
  // kLeastRays by daylight if there are several solutions, whose light is averaged: one ray from each site.
  // Measured: with 8, sensors in a sunlit classroom at -Sa .01 take 1.4 times the time for the same error
  // (2026-11-29-sensors.txt).
  static constexpr double kLeastRaysOfSolutions = 4;
  // The -aa at which kSpacing is the relative side of a patch, and kRays its relative number of rays.
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
