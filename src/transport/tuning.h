#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. They change the variance of light and its
// time. Those of Interpolation and DirectLight::kAlwaysTested also change its mean, as -aa and -dt do.
//
// Each comment gives the meaning and the unit, then after the colon where the value comes from. "Chosen by
// experiment" means that it was the best of some values that were tried on furnished rooms, and that the
// results for the others were not kept. The last sentence gives the effect of smaller and larger values on
// error and time, in the case of tests/bench/sensitivity where it is largest (runs/2026-11-22.txt there).
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// Caps that limit the time of each gather, and the time at start.
struct Caps {
  // Cap on each of: the openings, the spots and the highlights on balls that are aimed at from one point, and
  // the parts of sources that one ball shows; the brightest are kept. The cap is half of this for spots of
  // light from openings, and for highlights on cylinders, which cost more. Chosen by experiment: every aimed
  // ray has to evaluate the density of all of them. 30% less or more: within noise (sensors by sun; error 5%,
  // time 4%).
  RSPHERE_TUNED_ROOM(Caps, size_t, kAimed, 64);
  // Cap on the panes and holes that are probed, on the balls and cylinders that are examined for highlights,
  // and on the targets of a point that may be fitted (Targets::kFewestFitted); the largest are kept. 30% less
  // or more: the same answers in all cases.
  //
  // It is also the number of light paths that measure the mean distance from the sources to the first
  // surfaces, the least number in a batch of light paths, and the number of directions that estimate the
  // power of a source with a pattern or a cone: means are known within 3% if single values vary as much as
  // their mean. And it is the cap on the surfaces that a light path meets, for mirrors that face each other;
  // Russian roulette ends nearly all paths earlier.
  RSPHERE_TUNED(Caps, size_t, kAsked, 1024);
  // Rays that measure a mean brightness: on each side of a pane, around a point in sphere mode, and at least
  // to each opening that may matter there. Also the shadow rays that measure the mean visibility of a source
  // (radiance_guess.cpp). Chosen by experiment. A mean is then known within 18% if single
  // values vary as much as their mean. For panes, 30% less: time +30%; 30% more: time +30% (sensors by panes;
  // noise: error 19%, time 4%), because other panes are then found to be openings. For points, 30% less or
  // more: within noise (points beside goal; error 16%, time 7%).
  RSPHERE_TUNED(Caps, int, kProbes, 32);
};

// Patches of strong direct light that indirect rays are aimed at (bright_spots.cpp).
struct BrightSpots {
  // Particles that are traced from the sources; as many again are traced from distant sources through
  // openings. Chosen by experiment. A spot that reflects a hundredth of the light is found by 80 of them. 30%
  // less or more: within noise (sensors by sun; error 9%, time 5%).
  RSPHERE_TUNED(BrightSpots, double, kParticles, 8192);
  // A spot reflects at least this many times more light per area than surfaces do on average: chosen by
  // experiment. The threshold is half of that for light that enters through openings, because few rays of a
  // patch of the coarse solution hit its spots: by measurement in a sunlit classroom, where the noise at
  // sensors is 1.55% with a threshold of 6, 1.16% with 3, and 1.27% with 2.
  //
  // Aiming also has to pay for itself, because it makes a path 25% more expensive. Directions are aimed only
  // if the worth of all spots together (Node::worth) exceeds the same multiple of the worth that all surfaces
  // would have if they were lit evenly: by measurement.
  //   scene                                  worth   noise with aiming
  //   room with a lit lampshade                 31   one third
  //   open-plan office, around a goal            8   two thirds
  //   small room, around a goal                  2   slightly less
  // 30% less or more: the same answers in all cases. For light that enters through openings, any gain pays:
  // the spots of the same classroom are worth 2.3.
  RSPHERE_TUNED(BrightSpots, double, kBrighter, 5);
};

// Holes in walls (holes.cpp).
struct Holes {
  // Polygons belong to one wall if their normals agree within kSameNormal, and their distances from the
  // scene's corner within kSamePlane times the size of the scene: far more than rounding, far less than a
  // wall's thickness.
  static constexpr double kSameNormal = 1e-6, kSamePlane = 1e-5;
  // Grid cells along each side of a wall. Holes are found to within a cell: the edges of a door in a wall of
  // 10 m are right within 16 cm. Errors change only the variance.
  static constexpr int kCells = 64;
  // Least fraction of a hole's outline that borders on the wall. A door has the wall on three sides, and
  // passes; the space between the legs of desks in a row does not.
  static constexpr double kSurrounded = .6;
  // Cap on the number of walls that are searched, to limit the time at start; the largest are kept.
  static constexpr size_t kMostWalls = 256;
};

// Portals of daylight that indirect rays are aimed at (find_openings.cpp, openings.cpp).
struct Openings {
  // Panes, and holes without panes, are ignored if their area is below this fraction of the largest face of
  // the scene's box, because every opening costs time in every gather: chosen by experiment. A door of 2 m2
  // is found in a scene of up to 1400 m. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(Openings, double, kLeastArea, 1e-6);
  // A pane or hole is an opening if one side is at least this many times brighter than the other. The value
  // lies between the ratios of windows, 2 to 8 by day since panes also mirror the bright side, and of panes
  // between two rooms, about 1. Diffusing windows (1.6) and windows behind sunlit blinds (1.1) are below it;
  // the sky that is seen through them identifies them (kMoreSky). At 3, two of four windows of a sunlit
  // classroom are not found, and sensors have 2.7 times the noise of light from the sky.
  RSPHERE_TUNED(Openings, double, kBrighter, 1.7);
  // Regardless of brightness, a side is the bright one if at least kMoreSky times more unreflected sky light
  // arrives from it than from the other, and that is at least kLeastSky of all its light: chosen by
  // experiment. Sunlit blinds behind a pane are as bright as the sky, but the sky is hardly seen through
  // them.
  RSPHERE_TUNED(Openings, double, kMoreSky, 3);
  RSPHERE_TUNED(Openings, double, kLeastSky, .1);
  // A hole is the same as an opening that is parallel to it (cosine of the angle at least kParallel) and
  // whose middle is nearer than kSameHole times the shortest side of both: the two faces of a wall are nearer
  // to each other than a door is wide.
  static constexpr double kParallel = .99, kSameHole = .5;
  // Coplanar panes are merged into one opening, and the cells of a hole are taken as one opening, if they
  // fill at least this fraction of their bounding rectangle, so that most directions to the rectangle meet
  // them. With .91, the answers of all cases of tests/bench/sensitivity are the same.
  static constexpr double kFilled = .5;
};

// The control variate of sphere mode (radiance_guess.cpp).
struct RadianceGuess {
  // If a source adds more than this many times the mean guess at a place, a shadow ray to the source's middle
  // replaces the mean visibility: chosen by experiment. This concerns a few percent of the glances, which
  // carry most of the light. 30% less or more: within noise (points beside goal; error 4%, time 3%).
  RSPHERE_TUNED(RadianceGuess, double, kBright, 16);
};

// Next-event estimation (direct_light.cpp).
struct DirectLight {
  // Number of the brightest contributions that are always tested for shadows, regardless of -dt: chosen by
  // experiment. 1 or 3: within noise (picture of workshop; error below 1%, time 5%).
  RSPHERE_TUNED(DirectLight, size_t, kAlwaysTested, 2);
};

// Whether shadow rays or samples of the lobe estimate the light of sources in rough highlights
// (shared_highlights.cpp).
struct SharedHighlights {
  // If the lobe's density in a direction (per sr) times the solid angle of the source is below this, shadow
  // rays alone estimate the light from that direction: chosen by experiment. One shadow ray then adds at most
  // this multiple of the light of the whole lobe.
  RSPHERE_TUNED(SharedHighlights, double, kLeast, .25);
};

// Which directions of gathers are aimed (gather_directions.cpp): shares of them in proportion to the light
// that probably comes from openings, from spots and from elsewhere. The figures are the work, variance times
// time, of paths without interpolation in four daylit rooms: a narrow and a wide one, by an overcast sky and
// by the sun.
struct GatherDirections {
  // The fraction of directions that are aimed at openings is this times the fraction of the light that
  // probably comes from openings; likewise for spots. By measurement, for openings in the four rooms: the
  // work at .5 is 1.3, .9, 1 and 1 times that at .7; at .3 it is 7.8, 2.4, 1.1 and 1.2 times that. For spots
  // it is the same within noise from .5 to .9.
  RSPHERE_TUNED(GatherDirections, double, kAimed, .7);
  // Factor on the estimate of the light from elsewhere, the smaller of two. Both are made near openings,
  // where rooms are brighter than farther inside. By measurement: at 1 the work is 4.8, 2.3, .8 and 1 times
  // that at .5.
  RSPHERE_TUNED(GatherDirections, double, kFartherInside, .5);
};

// Highlights of light sources on rough balls and cylinders, which indirect rays are aimed at (highlights.h,
// source_parts.cpp, highlight_lobe.cpp, ball_highlights.cpp, cylinder_highlights.cpp). Values without an
// origin are estimates that have not been varied. All of them change the variance and the time of answers,
// not their mean.
struct Highlights {
  // Highlights are aimed at if, met only by chance, they would add more than this multiple of the squared
  // mean radiance to the variance of a direction: by measurement in an open-plan office with 50 rough balls
  // and 51 rough legs (-ab 1 -ad 64), at a desk, above one and at the ceiling. At .2, only the desk gains.
  //          noise                   work relative to none
  //     none  2.61%  .92%  2.84%     1     1     1
  //     .1     .44%  .49%  2.84%     1.12  1.03  1.00
  //     .05    .44%  .20%  2.71%     1.13  1.04  1.01
  //     .02    .23%  .28%  2.58%     1.16  1.07  1.02
  RSPHERE_TUNED(Highlights, double, kLeast, .05);
  // Gathers of at least this many rays look for highlights on cylinders: by measurement in the same office,
  // where the search takes as long as two rays. If single rays searched too, spherical means would take half
  // as long again for the same noise.
  RSPHERE_TUNED(Highlights, int, kMany, 16);
  // Factor on kLeast for balls in gathers of fewer rays, whose noise is larger: by measurement of spherical
  // means in the same office. For the same noise, they take 3% more work than without aiming at balls; with a
  // factor of 1, 6%. Conversely, kLeast divided by this is the threshold for a single highlight on a
  // cylinder, because many of them add up. 30% less or more: within noise (picture of office; error below 1%,
  // time 6%).
  RSPHERE_TUNED(Highlights, double, kLeastOfFew, 10);
  // A source is divided so that half the width of a part is at most this, relative to its distance from the
  // surface, because the highlight of a wider part is noticeably curved.
  RSPHERE_TUNED(Highlights, double, kHalf, .25);
  // How many times wider than the highlight the distribution of aimed directions is, and how many times wider
  // than the image of a source in a mirroring ball (importance/glints.h) the region around it is. Without a
  // margin, directions would seldom meet the edge, and a part of the image would be left out. 30% less or
  // more: within noise (points beside chrome; error 9%, time 1%).
  RSPHERE_TUNED(Highlights, double, kWider, 1.2);
  // Lower bound on the cosine at surfaces seen edge-on. It applies to reflections, whose highlight would have
  // no extent; to bright spots, whose normal is a mean; and to the sine of the angle between a cylinder's
  // axis and a distant source. 30% less or more: within noise (sensors by sun; error 5%, time 5%).
  RSPHERE_TUNED(Highlights, double, kEdgeOn, .05);
};

// When and how light is interpolated (indirect_light.cpp, final_gather.cpp).
struct Interpolation {
  // The cosine of the greatest tilt of a perturbed normal for which light is interpolated: chosen by
  // experiment. The moments of gathered light give the light at more tilted normals less accurately. 30%
  // less: within noise; 30% more: time -23% (picture of workshop; noise: error 13%, time 4%).
  RSPHERE_TUNED(Interpolation, double, kLeastUpright, .7);
  // The number of rays by which the mean distance, and the harmonic mean distance, of the surroundings of a
  // site are estimated: chosen by experiment. 30% less or more: within noise (picture by sun; error 3%, time
  // 5%).
  RSPHERE_TUNED(Interpolation, int, kReachRays, 16);
};

// Light paths (light_vertices.h). Lengths are relative to the mean distance from the sources to the first
// surfaces. The values were measured in the open-plan office, with a goal or with its lamps (-Sn 512, -ab 3);
// errors are the rms errors of answers.
struct LightVertices {
  // The distance at which half of the light between diffuse surfaces is left to rays that look for near
  // surfaces (NearLight::share()). .05: error +40% around the goal; .2 and .3: within noise.
  RSPHERE_TUNED(LightVertices, double, kWidth, .15);
  // The distance between diffuse surfaces at which those rays leave half of their light to joins with the eye
  // (NearLight::closeShare()), relative to the distance from the eye or the mean distance, whichever is
  // less. Without these joins, one answer in 200 around the goal is 10% too bright: the eye looks into the
  // gap of 2 mm between a sheet of paper and the goal. .01: error +10% around the goal, in a tenth less time;
  // .4: within noise.
  RSPHERE_TUNED(LightVertices, double, kClose, .1);
  // The fraction of the places in view at which paths from the eye are followed, for the light that is left
  // to them. It is kRest times the fraction of light path hits that are on unknown surfaces, and at least
  // kLeastRest.
  RSPHERE_TUNED(LightVertices, double, kRest, 4);
  RSPHERE_TUNED(LightVertices, double, kLeastRest, .125);
};

// Light that leaves sources (source_emission.h).
struct SourceEmission {
  // The radiance that is added, in the power of a source with a pattern or a cone, for light that the
  // directions to estimate it may miss; in units of the source's radiance without patterns.
  RSPHERE_TUNED(SourceEmission, double, kMissed, .01);
};

// Light vertices as seen from a place (vertex_light.h).
struct VertexLight {
  // Number of clusters of vertices, and of the candidates that are drawn from them at each place, by
  // estimates of the clusters' light there. Both together take as long as a shadow ray. 256 clusters:
  // variance of this light -25%, half as long again for the whole estimate; 512: -50%, 2.5 times as long.
  // A path from a source with a pattern or a cone has as many candidates, of which one is followed.
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kClusters, 128);
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kCandidates, 8);
  // When vertices are clustered, those that face opposite ways are taken to be this far apart, in units of
  // twice the diagonal of the box around all vertices. .12: variance of this light up to three times as
  // large.
  RSPHERE_TUNED(VertexLight, double, kFacing, .05);
  // Candidates that get a shadow ray. 8: within noise.
  RSPHERE_TUNED(VertexLight, int, kJoined, 2);
  // Rough surfaces that are seen in a mirror usually get one shadow ray; from this specularity on, they get
  // those of ordinary next-event estimation. A single ray would leave their highlights to chance: brushed
  // steel beside the goal would bring 14 W/sr/m2 from a surface that emits 1.
  RSPHERE_TUNED(VertexLight, double, kStrong, .1);
  // The probability of a gather at a surface that is seen in a reflection. The gather looks for light that
  // has reached the surface by another reflection, which vertices do not bring.
  RSPHERE_TUNED(VertexLight, double, kFollowed, .25);
};

// How many rays a ray splits into (ray_limits.h).
struct RayLimits {
  // If a gather's ray has more than this number of descendants, further weak ones are followed by Russian
  // roulette. The ancestors of the further one are not included. For a primary ray of sphere mode, the limit
  // is this number times -ad + -as. By measurement: 99% of the directions in a room with a chrome column have
  // fewer (-ab 6, -ad 4), those in a closed metal cylinder up to 1000.
  //
  // Sharp paths of a gather's ray are followed by Russian roulette once their weight is below the inverse of
  // this, with a probability in proportion to their weight. Gathers begin with a weight of 1/2, so that one
  // of their rays has at most half as many descendants at a time on average; without a limit their number
  // doubles at each surface of nested transparent objects, up to -lr. 32: a fifth less time with three nested
  // cylinders that reflect and transmit a tenth; more noise behind a pane that transmits 5%.
  RSPHERE_TUNED(RayLimits, double, kMostDescendants, 64);
  // The limit for a patch of the coarse solution is this number times its rays: by measurement. Without a
  // limit, most patches between two boxes of rough trans would have 16 to 40 per ray, and between two of
  // rough metal 7 to 9. With 8, a point before the boxes of trans takes twice the time, for the same noise.
  RSPHERE_TUNED(RayLimits, double, kMostOfPatch, 2);
  // A primary ray of sphere mode and a ray of a gather use kAsked patches regardless of weight, and about
  // kFurther more, each with a probability in proportion to its weight: by measurement. Where surfaces
  // reflect and transmit in lobes, a ray asks for 5 patches in an open-plan office and for 12 between boxes
  // of rough trans. Most of them contribute little, and each has rays of its own. Without a limit, a point
  // before the boxes takes twice the time. The standard deviation of directions within the boxes is then 6%;
  // with kAsked 1 and kFurther 1 it is 90%, with 2 and 4 it is 37%.
  RSPHERE_TUNED(RayLimits, int, kAsked, 2);
  RSPHERE_TUNED(RayLimits, double, kFurther, 8);
  // Patches, without further ones, that a ray of a patch uses: the least possible, because such rays are
  // many. With 4, the point before the boxes takes twice the time, for the same noise.
  static constexpr int kAskedByPatch = 1;
};

// Sharp reflection and refraction (specular_light.cpp).
struct SpecularLight {
  // Sharp paths of indirect rays are followed by Russian roulette if their weight is below this share of the
  // weight of the ray that arrives: by measurement. One in three reflections of a pane is followed. In four
  // daylit rooms without interpolation it saves 3 to 22% of the time to equal noise; at 1, the noise is up to
  // half as much again.
  RSPHERE_TUNED(SpecularLight, double, kWeakBranch, .25);
};

}  // namespace rsphere::tuning
