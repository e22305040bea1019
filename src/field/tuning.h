#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. They determine the spacing of
// interpolated light, and thus its bias, its time and its memory.
//
// Each comment gives the meaning and the unit, then after the colon where the value comes from. "Chosen by
// experiment" means that it was the best of some values that were tried on pictures of furnished rooms
// (tests/bench/rtrace/runs/2026-11-21-interpolated.txt), and that the results for the others were not kept.
// The last sentence of each comment gives the effect of smaller and larger values on error and time. It is
// for the case of tests/bench/sensitivity that changes most. The results are in runs/2026-11-24.txt there, or
// in runs/2026-11-22.txt for constants that have not changed since.
#include "base/tuned.h"

namespace rsphere::tuning {

// The irradiance cache and the coarse solution alike.
struct Fields {
  // The distance of open surroundings, in sizes of the scene: the side of the widest cells of the cache, and
  // for patches the largest mean distance of what they see. Chosen by experiment. 30% less: within noise; 30%
  // more: time -28% (sensors by sun; noise: error 10%, time 4%).
  RSPHERE_TUNED(Fields, double, kOpen, .1);
  // The number of finer levels that are tried where sites or patches are hidden from a place: chosen by
  // experiment. 1 or 3: within noise (sensors by sun; error below 1%, time 6%).
  RSPHERE_TUNED(Fields, int, kFinerWhereHidden, 2);
};

// The irradiance cache at the first diffuse surface (irradiance_field.cpp).
struct IrradianceField {
  // -ar relates the finest spacing to the size of the scene, in RADIANCE as here. Where the room around a
  // site is smaller than the scene (most daylight models have a wide ground), the finest spacing is in
  // proportion to the room. The size of the room, in root mean square distances of what the site sees: chosen
  // by experiment, in rooms on a ground of 0 to 5 km, by the error in thin gaps and the number of gathers. 4:
  // the light between louvres is 3% too dark; 2.5: 3% more gathers in furnished rooms.
  //
  // The side of the widest cells is -aa times the same multiple of the harmonic mean distance of their
  // surroundings: chosen by experiment. 30% less or more: within noise (picture of office; error 4%, time
  // 8%).
  RSPHERE_TUNED(IrradianceField, double, kRoom, 3.2);
  // The finest spacing is at most this multiple of the height of the gap that a place lies in (the distance
  // from the place to what lies above it along its normal): by measurement. 1: 2.6% of the places between
  // louvres are off by a factor of 1.5, instead of .7%; .125: the same errors, 3% more gathers in a furnished
  // room.
  RSPHERE_TUNED(IrradianceField, double, kFinestInGap, .25);
  // -aa divided by this is the allowed relative error of an interpolation: chosen by experiment. -aa bounds
  // the error of RADIANCE's interpolation, whose mean error is smaller. 30% less or more: within noise
  // (picture of workshop; error 4%, time 6%).
  RSPHERE_TUNED(IrradianceField, double, kAllowed, 2.4);
  // A level of cells gives all of an answer if its error is at most the allowed one, and none of it from this
  // multiple of the allowed error on; in between it is blended with the next level, so that no edge shows.
  // From level to level the allowed error grows by the same factor, because the smaller the cells, the
  // smaller the part of a picture that they cover. Chosen by experiment. 30% less or more: within noise
  // (picture by sun; error below 1%, time 4%).
  RSPHERE_TUNED(IrradianceField, double, kNoneAbove, 1.5);
};

// Interpolation between the sites around a place (site_interpolation.cpp).
struct SiteInterpolation {
  // Differences between sites below this number of standard errors are taken for noise: chosen by experiment.
  // 30% less or more: within noise (picture by sun; error 1%, time 4%).
  RSPHERE_TUNED(SiteInterpolation, double, kChance, .7);
  // The error of an interpolation is predicted from three quantities at two sites: the change of the gradient
  // (site_interpolation.cpp); the difference of their light, divided by this; and the part of that difference
  // that the gradients do not predict, divided by this too. Chosen by experiment. The last two are needed
  // because gradients do not show a shadow's edge between the sites. 30% less or more: within noise (picture
  // by sun; error 3%, time 6%).
  RSPHERE_TUNED(SiteInterpolation, double, kByStep, 5);
  // The relative error of an extrapolation over a distance d is predicted as the larger of two quantities:
  // this constant times (d / R)^2, where R is the harmonic mean distance of the surroundings; and the
  // relative change that gradients predict over d. The result is multiplied by this constant once more, as a
  // margin of safety. Chosen by experiment. 30% less or more: within noise (picture of office; error 1%, time
  // 11%).
  RSPHERE_TUNED(SiteInterpolation, double, kBeyond, 1.5);
};

// The coarse solution behind the first diffuse surface (coarse_solution.cpp): chosen in two daylit rooms (a
// classroom of 10 x 7 m, a cell with a small window), each with sun and with an overcast sky, by the error of
// 40 sensors for the time: tests/bench/rtrace/runs/2026-11-22-coarse-solution.txt.
struct CoarseSolution {
  // The side of a patch in mean distances of what it sees, at -aa .1. Above, it grows with the root of -aa,
  // since the error of an interpolation grows with the square of the spacing: by measurement. Below, it is in
  // proportion to -aa. .4: sensors in a narrow room are .7% off on average instead of .4%; .2: .3%, in a
  // fifth more time. Near a window with blinds .6, with .18 for kFarPatch and .1 for kLeastPatch, leaves
  // sensors 17% too bright.
  RSPHERE_TUNED(CoarseSolution, double, kSpacing, .3);
  // The side of a patch is at most this fraction of the distance that it is seen from. Paths are followed
  // instead of using patches where that distance is less than this multiple of a patch's side, and on
  // surfaces whose extent is less than this multiple of it. Chosen by experiment. 30% less or more: within
  // noise (picture by sun; error 2%, time 6%).
  RSPHERE_TUNED(CoarseSolution, double, kHalf, .5);
  // The side of a patch need not be smaller than this share of the distance that it is seen from: by
  // measurement, together with kSpacing.
  RSPHERE_TUNED(CoarseSolution, double, kFarPatch, .09);
  // No patch is smaller than this share of the extent of its surface: by measurement, together with kSpacing.
  // Patches in a corner, where everything is near, would otherwise be divided without end. .02: three times
  // the time.
  RSPHERE_TUNED(CoarseSolution, double, kLeastPatch, .05);
  // Factor on kSpacing, kFarPatch and kLeastPatch in scenes without openings for daylight: by measurement, in
  // RADIANCE's office and cabin (tests/bench/rtrace/runs/2026-11-25-lamps.txt). 1: a third more time for the
  // same error of pictures. 3: a tenth to a sixth less time, but errors of spherical means become 1.4 times
  // as large. Where patches serve the first bounce, the least number of their rays grows with its square, as
  // their area does.
  RSPHERE_TUNED(CoarseSolution, double, kCoarserByLamps, 2);
  // In the same scenes, patches that only other patches see are larger by so many levels, except where they
  // serve the first bounce: by measurement. There, 2 makes errors of spherical means three times as large.
  static constexpr int kCoarserLinksByLamps = 2;
  // The smallest patches of a surface are chosen as if its extent were at most this share of the scene's
  // longest side: chosen by experiment. Rooms on a wide ground are much smaller than the ground. With 30%
  // less, sensors by sun take 65% more time; 30% more is within noise (error below 1%, time 4%).
  RSPHERE_TUNED(CoarseSolution, double, kWidestExtent, .4);
  // The number of patches across a strip, such as a slat, that is narrower than its usual patches although
  // its surroundings require patches smaller than the strip: by measurement. With 1, sensors near a window
  // with blinds are 33% too bright.
  RSPHERE_TUNED(CoarseSolution, int, kPartsAcross, 4);
  // A side of a ball (a sixth of it) or of a cone is enclosed if, as seen from each of kEnclosedPlaces places
  // on it, the root mean square distance of the surroundings is below kEnclosed times the radius. This lies
  // between shells with a gap of a third of the inner radius, where the ratio is .47 in the middle, and a
  // ball in a tight room. Without this rule, gathers between five shells of rough trans make more than
  // 140,000 patches: the curvature hides most sites from the places around them, so that finer and finer
  // patches are tried, each of which serves few places.
  static constexpr size_t kEnclosedPlaces = 8;
  static constexpr double kEnclosed = .6;
  // No patch of an enclosed side is smaller than this share of the surface's extent: an estimate, tried with
  // those five shells alone (one point in sphere mode, 4 s instead of minutes).
  static constexpr double kLeastPatchEnclosed = .2;
  // The number of rays of a patch for each ray that a gather is asked for (-ad and -as): by measurement. In
  // daylit rooms, .1 instead of .07 takes a third more time for a tenth less error.
  RSPHERE_TUNED(CoarseSolution, double, kRays, .06);
  // With -aa below .1, the number of rays grows in inverse proportion to -aa, because all places that see a
  // patch share its noise. It stops growing below this -aa: by measurement. In a sunlit classroom at -aa .05
  // the noise of sensors is .65% without this growth.
  RSPHERE_TUNED(CoarseSolution, double, kFinestAccuracy, .02);
  // In a room whose surfaces all matter alike, the share of a patch in the light of the others is about its
  // area divided by the square of the room's size; outdoors, less in proportion to the sky that it sees and
  // to the square of its distance from other surfaces. A patch of this share, a square of 36 cm in a room of
  // 4 m, has the number of rays above; others have rays in proportion, which leaves the least noise for the
  // same number of all rays: by measurement. In four daylit rooms, the mean distance of what a patch sees in
  // place of the room's size gives patches below desks and in gaps so many rays that the same error takes 1.3
  // to 3 times the time. .012: 15% more noise in sunlit rooms, a tenth less time.
  RSPHERE_TUNED(CoarseSolution, double, kUsualShare, .008);
  // Bounds on the number of rays, as a multiple of the usual one; by lamps it is at most 1. By measurement:
  // .1 takes 1.3 times the time at -aa .05, for the same error; at 2.5, a sunlit classroom has 15% more
  // noise, at 8 the same as at 4 in a sixth more time.
  RSPHERE_TUNED(CoarseSolution, double, kFewerRays, .03);
  RSPHERE_TUNED(CoarseSolution, double, kMoreRays, 4);
  // The least number of rays of a patch: by measurement. 16 takes up to a sixth more time, for the same
  // error.
  RSPHERE_TUNED(CoarseSolution, double, kLeastRays, 8);
};

}  // namespace rsphere::tuning
