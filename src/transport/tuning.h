#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. They affect the variance of light and the
// computing time. Those of Interpolation also affect the mean, as -aa does.
//
// Each comment gives the meaning, the unit and the origin of the value. "Chosen by experiment": it was the
// best of some values that were tried on furnished rooms; the results of the others were not kept.
// "Insensitive": changing it by 30% had no effect beyond noise in tests/bench/sensitivity
// (runs/2026-11-22.txt).
#include <cstddef>

#include "base/tuned.h"
#include "light/tuning.h"

namespace rsphere::tuning {

// Caps that limit the time of each gather, and the time at start.
struct Caps {
  // Cap on each of these numbers; the brightest ones are kept:
  // - the openings, the spots and the highlights on balls at which rays from one point are aimed;
  // - the parts of sources of which one ball shows highlights.
  // The cap is half of this for spots of light from openings, and for highlights on cylinders, which cost
  // more. Chosen by experiment: the densities of all of them are evaluated for each aimed ray. Insensitive.
  RSPHERE_TUNED_ROOM(Caps, size_t, kAimed, 64);
  // Cap on the panes and holes that are probed, on the balls and cylinders that are examined for highlights,
  // and on the targets of a point that may be fitted (Targets::kFewestFitted); the largest are kept.
  // Insensitive.
  //
  // The same number is used for
  // - the light paths that measure the mean distance from the sources to the first surfaces,
  // - the least number of light paths in a batch,
  // - the directions that estimate the power of a source with a pattern or a cone. If single values vary as
  //   much as their mean, such means are known within 3%;
  // - the cap on the surfaces that a light path hits, for mirrors that face each other. Russian roulette ends
  //   nearly all paths earlier.
  RSPHERE_TUNED(Caps, size_t, kAsked, 1024);
  // Number of rays that measure a mean brightness: on each side of a pane, around a point in sphere mode, and
  // (as a minimum) to each opening that may matter there. Chosen by experiment. A mean is then known within
  // 18% if single values vary as much as their mean.
  // - For panes, changing it by 30% either way increases the time by 30%, because other panes are then
  //   classified as openings.
  // - For points: insensitive.
  RSPHERE_TUNED(Caps, int, kProbes, 32);
};

// Spots of strong direct light, at which indirect rays are aimed (bright_spots.cpp).
struct BrightSpots {
  // Number of particles traced from the sources; the same number is traced from distant sources through
  // openings. Derived: if all of them hit spots, a spot is hit by 128 on average, and its power is known
  // within 9%, 1/sqrt(128). 80 particles find a spot that reflects a hundredth of the light. Insensitive.
  static inline const double kParticles = 128. * Caps::kAimed;
  // A spot reflects at least this many times as much light per area as the mean of all surfaces. Chosen by
  // experiment. For light that enters through openings, the threshold is half of this, because few rays of a
  // patch of the coarse solution hit its spots. Measured in a sunlit classroom:
  //   threshold   noise at sensors
  //   6           1.55%
  //   3           1.16%
  //   2           1.27%
  //
  // Aiming makes a path 25% more expensive, so that it has to reduce the noise enough. Directions are only
  // aimed if the worth of all spots together (Node::worth) exceeds this multiple of the worth that all
  // surfaces would have under uniform light. Measured:
  //   scene                             relative worth   noise relative to no aiming
  //   room with a lit lampshade         31               one third
  //   open-plan office, around a goal    8               two thirds
  //   small room, around a goal          2               slightly less than 1
  // Insensitive. For light that enters through openings, no minimum worth is required; in the same classroom
  // the relative worth is 2.3.
  RSPHERE_TUNED(BrightSpots, double, kBrighter, 5);
};

// Holes in walls (holes.cpp).
struct Holes {
  // Polygons belong to one wall if their normals agree within kSameNormal, and their distances from the
  // scene's corner within kSamePlane times the size of the scene. The tolerances are far above rounding
  // errors, and far below the thickness of a wall.
  static constexpr double kSameNormal = 1e-6, kSamePlane = 1e-5;
  // Grid cells along each side of a wall. The edges of a hole are found to within a cell, which is 16 cm for
  // a door in a wall of 10 m. Errors affect only the variance.
  static constexpr int kCells = 64;
  // Smallest fraction of a hole's outline that borders on the wall. A door, which has the wall on three
  // sides, passes. The space between the legs of a row of desks does not.
  static constexpr double kSurrounded = .6;
  // Cap on the number of walls that are searched, to limit the time at start; the largest are kept.
  static constexpr size_t kMostWalls = 256;
};

// Portals of daylight, at which indirect rays are aimed (find_openings.cpp, openings.cpp).
struct Openings {
  // Panes and holes are ignored if their area is below this fraction of a wall as wide and as high as the
  // scene, because each opening costs time in each gather. Derived: a window of 6 x 6 cm is found in a room
  // of 3 m on a ground of 1 km, and a door of 2 m2 in a city of 10 km by 200 m. Insensitive.
  static constexpr double kLeastArea = 1e-6;
  // A pane or hole is an opening if one side is at least this many times brighter than the other. Typical
  // ratios:
  //   windows by day, which also mirror the bright side   2 to 8
  //   diffusing windows                                   1.6
  //   windows behind sunlit blinds                        1.1
  //   panes between two rooms                             about 1
  // Diffusing windows and windows behind blinds are recognized by the sky that is seen through them
  // (kMoreSky). With 3, two of the four windows of a sunlit classroom are not found, and the noise of sensors
  // from sky light is 2.7 times as large.
  RSPHERE_TUNED(Openings, double, kBrighter, 1.7);
  // Regardless of brightness, one side is the bright side of an opening if two conditions hold: at least
  // kMoreSky times as much unreflected sky light arrives from it as from the other side, and sky light is at
  // least kLeastSky of all light from it. Chosen by experiment. Sunlit blinds beside a pane are as bright as
  // the sky on its other side, but little sky is seen through them.
  RSPHERE_TUNED(Openings, double, kMoreSky, 3);
  RSPHERE_TUNED(Openings, double, kLeastSky, .1);
  // A hole is treated as the same opening as another one if both are parallel (cosine of the angle at least
  // kParallel) and the distance between their middles is below kSameHole times the shortest side of both.
  // This finds the two faces of a wall, which are nearer to each other than a door is wide.
  static constexpr double kParallel = .99, kSameHole = .5;
  // Rays are aimed at the image of an opening in a mirror that reflects at least this fraction of the light
  // of all openings. Derived: light that is left to unaimed rays and reaches one of a thousand of them has
  // an error of a third of itself with 8192 rays, .3% of the whole.
  static constexpr double kLeastMirrored = .01;
  // Coplanar panes are merged into one opening, and the cells of a hole are treated as one opening, if they
  // fill at least this fraction of their bounding rectangle. Most directions towards the rectangle then hit
  // them. With .91, the answers of all cases of tests/bench/sensitivity are the same.
  static constexpr double kFilled = .5;
};

// Rays that a sensor (-I) adds where its gather is noisy (indirect_light.cpp).
struct SensorNoise {
  // Rays are added until the standard error of the gather is at most -aa divided by kAccuracy, or until
  // kMostAdded times -as are added. Chosen by experiment. kAccuracy: with 8, variance x time is 1.27 times as
  // large as without added rays in a room of glass and metal, because two halves are stratified worse than a
  // whole; with 12 it is 1.10 times as large (tests/bench/rtrace/runs/2026-11-26-sensors.txt).
  // kMostAdded: with 8, sensors below a shaft have an error of 2.3% in .36 s (-as 512); with 24, 1.3% in
  // .44 s (tests/bench/rtrace/runs/2026-11-27-patches.txt).
  static constexpr double kAccuracy = 12, kMostAdded = 24;
  // If the rays to be added are fewer than those already sent divided by this, none are added, because so few
  // would be unevenly distributed over the hemisphere.
  static constexpr int kFewestAdded = 8;
};

// Openings as light sources of paths from both ends (portals.cpp).
struct Portals {
  // An opening with less than this fraction of the radiance of the brightest one is no portal: paths from the
  // eye find its light. Rays to a false opening, such as a hole in the plane of the desk tops of a
  // classroom, would be lost.
  RSPHERE_TUNED(Portals, double, kLeastRadiance, .2);
};

// The balance between shadow rays and samples of the lobe in the estimate of rough highlights of sources
// (shared_highlights.cpp).
struct SharedHighlights {
  // If the lobe's density in a direction (per sr) times the solid angle of the source is below this, only
  // shadow rays estimate the light from that direction. Derived: a shadow ray then adds at most a quarter of
  // the light of the whole lobe.
  RSPHERE_DERIVED(SharedHighlights, double, kLeast, .25);
};

// The fractions of the directions of gathers that are aimed (gather_directions.cpp). They are proportional to
// the estimated light from openings, from spots and from elsewhere. The tables give variance x time of paths
// without interpolation, relative to the chosen value, in four daylit rooms: a narrow and a wide one, each
// with an overcast sky and with sun.
struct GatherDirections {
  // Ratio of the fraction of directions aimed at openings to the estimated fraction of the light from them;
  // the same for spots. Measured for openings:
  //   value   variance x time in the four rooms
  //   .5      1.3  .9   1    1
  //   .3      7.8  2.4  1.1  1.2
  // For spots, the results from .5 to .9 do not differ beyond noise.
  RSPHERE_TUNED(GatherDirections, double, kAimed, .7);
  // Factor on the estimate of the light from elsewhere, which is the smaller of two estimates. Both are made
  // near openings, where rooms are brighter than farther inside. Measured:
  //   value   variance x time in the four rooms
  //   1       4.8  2.3  .8   1
  RSPHERE_TUNED(GatherDirections, double, kFartherInside, .5);
};

// Highlights of light sources on rough balls and cylinders, at which indirect rays are aimed (highlights.h,
// source_parts.cpp, highlight_lobe.cpp, ball_highlights.cpp, cylinder_highlights.cpp). Values without a
// stated origin are estimates that have not been varied. All affect the variance and the computing time, not
// the mean.
struct Highlights {
  // Rays are aimed at a highlight if otherwise, hit only by chance, it would add more than this multiple of
  // the squared mean radiance to the variance of a direction. Measured in an open-plan office with 50 rough
  // balls and 51 rough legs (-ab 1 -ad 64), at three points: at a desk, above a desk, and at the ceiling.
  // With .2, only the first improves.
  //          noise                   work relative to no aiming
  //   none   2.61%  .92%  2.84%     1     1     1
  //   .1      .44%  .49%  2.84%     1.12  1.03  1.00
  //   .05     .44%  .20%  2.71%     1.13  1.04  1.01
  //   .02     .23%  .28%  2.58%     1.16  1.07  1.02
  RSPHERE_TUNED(Highlights, double, kLeast, .05);
  // Gathers with at least this number of rays search for highlights on cylinders. Derived: in the same
  // office, a search takes as long as two rays, at most an eighth of these. If single rays searched too,
  // spherical means would take 1.5 times the time for the same noise.
  RSPHERE_DERIVED(Highlights, int, kMany, 16);
  // Factor on kLeast for balls, in gathers with fewer rays than kMany, whose noise is larger. Measured for
  // spherical means in the same office: relative to no aiming at balls, the work for the same noise increases
  // by 3%; with a factor of 1, by 6%. kLeast divided by this is also the threshold for each single highlight
  // on cylinders, because many of them add up. Insensitive.
  RSPHERE_TUNED(Highlights, double, kLeastOfFew, 10);
  // Largest half-width of a part of a source, relative to its distance from the surface. The highlight of a
  // wider part would be noticeably curved. Also for the parts of sources whose images in mirroring balls are
  // targets (importance/glints.h). Derived: see SourceParts::kNear.
  static constexpr double kHalf = SourceParts::kNear / 2;
  // Ratio of the width of the distribution of aimed directions to the width of the highlight. Also the ratio
  // of the region around the image of a source in a mirroring ball (importance/glints.h) to that image.
  // Without this margin, few directions would hit the edge, and a part of the image would be lost.
  // Insensitive.
  RSPHERE_TUNED(Highlights, double, kWider, 1.2);
  // Lower bound on cosines, for surfaces seen edge-on. It is used for reflections, whose highlight would have
  // no extent; for bright spots, whose normal is a mean; and for the sine of the angle between a cylinder's
  // axis and a distant source. Insensitive.
  RSPHERE_TUNED(Highlights, double, kEdgeOn, .05);
};

// When and how light is interpolated (indirect_light.cpp, final_gather.cpp).
struct Interpolation {
  // Light is interpolated unless a texture tilts the normal by an angle whose cosine is below this. Chosen by
  // experiment. For more tilted normals, the moments of gathered light are less accurate. Reducing it by 30%
  // has no effect beyond noise; increasing it by 30% reduces the time by 23% (picture of workshop).
  RSPHERE_TUNED(Interpolation, double, kLeastUpright, .7);
  // Number of rays of a record of the irradiance cache times the square of -aa, where shadow rays find all
  // light: at most -ad plus -as, and at least half of these. The error of interpolation, which -aa bounds, is
  // then larger than the noise of the records. Measured: at -aa .15, with 333 instead of 640 rays, pictures
  // of RADIANCE's cabin and office take a quarter less time for nearly the same errors. In a sunlit
  // classroom, errors would be a fifth larger (tests/bench/rtrace/runs/2026-11-27-patches.txt).
  RSPHERE_TUNED(Interpolation, double, kRaysByLamps, 7.5);
  // Number of rays that estimate the distances around a site (root mean square and harmonic mean): derived.
  // If single distances vary as much as their mean, that is known within 25%, half of the step between the
  // sides of cells, which are powers of two. Insensitive.
  static constexpr int kReachRays = 16;
};

// Light paths (light_vertices.h). Lengths are relative to the mean distance from the sources to the first
// surfaces. Measured in the open-plan office, around a goal or with its lamps (-Sn 512, -ab 3). "Error" is
// the rms error of answers.
struct LightVertices {
  // Distance at which rays towards near surfaces estimate half of the light between diffuse surfaces
  // (NearLight::share()). Joins of a point with light paths hardly increase in number below it
  // (DiffuseGlances). Measured: with .05, the error around the goal is 40% larger; .2 and .3 have no
  // effect beyond noise.
  //
  // It is also the distance at which those rays leave half of their light to joins with the eye
  // (NearLight::closeShare()), relative to the smaller of the distance from the eye and the mean distance.
  // Without these joins, one answer in 200 around the goal is 10% too bright, because the eye sees a gap of
  // 2 mm between a sheet of paper and the goal. Measured for this use: with .01, the error around the goal is
  // 10% larger, in a tenth less time; .4 has no effect beyond noise.
  RSPHERE_TUNED(LightVertices, double, kWidth, .15);
};

// The light of vertices at a place (vertex_light.h).
struct VertexLight {
  // kClusters: number of clusters of vertices. kCandidates: number of vertices that are sampled at each
  // place, by estimates of the clusters' light. Both together take as long as a shadow ray. Measured:
  //   clusters   variance of this light   time of the whole estimate
  //   128         1                       1
  //   256         .75                     1.5
  //   512         .5                      2.5
  // A light path from a source with a pattern or a cone also has kCandidates candidates, one of which is
  // followed.
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kClusters, 128);
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kCandidates, 8);
  // One more candidate is sampled from the vertices next to a place whose light is not bounded there, which
  // are found by a grid of cubes. The value is the mean number of them in the cube of such a vertex, unless
  // they are farther apart than LightVertices::kWidth. Measured on a wall close to a ceiling that mirrors
  // light: relative variance without this candidate 39; with the value 1, 2, 4, 8, 16: 5.1, 3.5, 2.0, 4.1, 8.
  RSPHERE_TUNED(VertexLight, double, kInCube, 4);
  // When vertices are clustered, this is the distance that is assigned to opposite normals, in units of twice
  // the diagonal of the box around all vertices. With .12, the variance of this light is up to three times as
  // large.
  RSPHERE_TUNED(VertexLight, double, kFacing, .05);
  // Number of candidates that get a shadow ray. 8 has no effect beyond noise.
  RSPHERE_TUNED(VertexLight, int, kJoined, 2);
  // Rough surfaces that are seen in a mirror usually get one shadow ray. If their specularity is at least
  // this, they get the shadow rays of ordinary next-event estimation instead, because a single ray would make
  // their highlights too noisy: brushed steel beside a goal of radiance 1 would show up to 14 W/sr/m2.
  RSPHERE_TUNED(VertexLight, double, kStrong, .1);
  // Probability of a gather at a surface that is seen in a reflection. The gather estimates light that has
  // reached the surface by another reflection, which vertices do not provide.
  //
  // At a place that the eye sees directly, a path from the eye estimates the light that light paths do not
  // bring. It is always followed if at least this fraction of the hits of light paths are on unknown
  // surfaces. If fewer are, the probability is proportional to their fraction, but at least half of this.
  RSPHERE_TUNED(VertexLight, double, kFollowed, .25);
};

// Limits on the number of rays into which a ray splits (ray_limits.h).
struct RayLimits {
  // If a ray of a gather has more than this number of descendants, further ones of low weight are subject to
  // Russian roulette. The ancestors of a further descendant are not counted. For a primary ray of sphere
  // mode, the limit is this number times -ad plus -as. Measured: 99% of the directions in a room with a
  // chrome column have fewer descendants (-ab 6, -ad 4); those in a closed metal cylinder have up to 1000.
  //
  // Sharp paths of a gather's ray are subject to Russian roulette if their weight is below the inverse of
  // this; the probability of survival is proportional to their weight. Gathers start with a weight of 1/2, so
  // that a ray has on average at most half this number of descendants at a time. Without a limit, that number
  // doubles at each surface of nested transparent objects, up to -lr. With 32, three nested cylinders that
  // reflect and transmit a tenth take a fifth less time, but there is more noise behind a pane that transmits
  // 5%.
  RSPHERE_TUNED(RayLimits, double, kMostDescendants, 64);
  // The number of rays into which a ray may split regardless of weight: derived. A surface that it hits may
  // reflect one and transmit one. It is used for
  // - the descendants of each ray of a patch of the coarse solution, on average. Measured: without a limit,
  //   most patches between two boxes of rough trans would have 16 to 40 descendants per ray; between boxes of
  //   rough metal, 7 to 9. With 8, a point in front of the boxes of trans takes twice the time for the same
  //   noise;
  // - the patches that a ray of a gather, or a primary ray of sphere mode, uses regardless of weight.
  static constexpr int kFreely = 2;
  // Such a ray uses about kFurther more patches, with probabilities proportional to weight. Where surfaces
  // reflect and transmit in lobes, a ray requests 5 patches in an open-plan office, and 12 between boxes of
  // rough trans. Most contribute little, and each has rays of its own: without a limit, a point in front of
  // the boxes takes twice the time. Measured standard deviation of directions between the boxes:
  //   kFreely   kFurther
  //   2         8          6%
  //   2         4          37%
  //   1         1          90%
  RSPHERE_TUNED(RayLimits, double, kFurther, 8);
  // Number of patches that each ray of a patch uses; there are no further ones. It is the least possible
  // number, because such rays are numerous. With 4, the point in front of the boxes takes twice the time for
  // the same noise.
  static constexpr int kAskedByPatch = 1;
};

// Sharp reflection and refraction (specular_light.cpp).
struct SpecularLight {
  // Sharp paths of indirect rays are subject to Russian roulette if their weight, relative to the weight of
  // the arriving ray, is below this. One in three reflections by a pane is then followed. Measured in four
  // daylit rooms without interpolation: it reduces the time for the same noise by 3 to 22%. With 1, the noise
  // is up to 1.5 times as large.
  RSPHERE_TUNED(SpecularLight, double, kWeakBranch, .25);
};

}  // namespace rsphere::tuning
