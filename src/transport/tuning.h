#pragma once
// The tuning constants of this folder (base/tuned.h), by subsystem. They change the variance of light and its
// time. Those of Interpolation and DirectLight::kAlwaysTested also change its mean, as -aa and -dt do.
//
// Each comment gives the meaning and the unit, then after the colon where the value comes from. "Chosen by
// experiment" means that it was the best of some values that were tried on furnished rooms, and that the
// results for the others were not kept. The last sentence says what less and more of the constant do to error
// and time in the case of tests/bench/sensitivity where it matters most (runs/2026-11-22.txt there).
#include <cstddef>

#include "base/tuned.h"

namespace rsphere::tuning {

// Caps that limit time: of each gather, and at start.
struct Caps {
  // Openings, spots and highlights on balls that are aimed at from one point, and parts of sources that one
  // ball shows; the brightest are kept. Half as many spots are of light from openings, and highlights on
  // cylinders, which cost more: chosen by experiment, because every aimed ray asks all of them for its
  // density. 30% less or more: within noise (sensors by sun; error 5%, time 4%).
  RSPHERE_TUNED_ROOM(Caps, size_t, kAimed, 64);
  // Panes and holes that are probed, balls and cylinders that are looked at; the largest are kept. 30% less
  // or more: the same answers in all cases.
  RSPHERE_TUNED(Caps, size_t, kAsked, 1024);
};

// Patches of strong direct light that indirect rays are aimed at (bright_spots.cpp).
struct BrightSpots {
  // Particles that are traced from the sources, and as many from distant sources through openings: chosen by
  // experiment. A spot that reflects a hundredth of the light is found by 80 of them. 30% less or more:
  // within noise (sensors by sun; error 9%, time 5%).
  RSPHERE_TUNED(BrightSpots, double, kParticles, 8192);
  // A spot reflects at least this many times more light per area than surfaces do on average: chosen by
  // experiment. For light that enters through openings, which few rays of a patch of the coarse solution
  // meet, it is half of that: by measurement in a sunlit classroom, where spots of 6 and more leave 1.55% of
  // noise at sensors, of 3 1.16%, of 2 1.27%.
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
  // Polygons belong to one wall if their normals and their distances from the scene's corner, in sizes of the
  // scene, agree to this: far more than rounding, far less than a wall's thickness.
  static constexpr double kSameNormal = 1e-6, kSamePlane = 1e-5;
  // Cells along each side of a wall, within which holes are known: so that the edges of a door in a wall of
  // 10 m are right within 16 cm. What is missed changes the variance only.
  static constexpr int kCells = 64;
  // The wall is at this share of a hole's outline at least: at three sides of a door, but not around the
  // space between the legs of desks in a row.
  static constexpr double kSurrounded = .6;
  // Cap on the number of walls that are looked at, of which the largest are chosen, to limit the time at
  // start.
  static constexpr size_t kMostWalls = 256;
};

// Portals of daylight that indirect rays are aimed at (find_openings.cpp, openings.cpp).
struct Openings {
  // Panes, and holes without panes, that are smaller than this share of the largest face of the scene's box
  // are ignored, because every opening costs time in every gather: chosen by experiment. A door of 2 m2 is
  // found in a scene of up to 1400 m. 30% less or more: the same answers in all cases.
  RSPHERE_TUNED(Openings, double, kLeastArea, 1e-6);
  // Probe rays on each side of a pane: chosen by experiment. 30% less: time +30%; 30% more: time +30%
  // (sensors by panes; noise: error 19%, time 4%), because other panes are then found to be openings.
  RSPHERE_TUNED(Openings, int, kProbes, 32);
  // The bright side of an opening is at least this many times brighter than the dark one: between windows,
  // for which it is 2 to 8 by day, since panes also mirror the bright side, and panes between two rooms, for
  // which it is about 1. Diffusing windows (1.6) and windows behind sunlit blinds (1.1) are found by the sky
  // that is seen through them (kMoreSky). At 3, two of four windows of a sunlit classroom are not found, and
  // sensors have 2.7 times the noise of light from the sky.
  RSPHERE_TUNED(Openings, double, kBrighter, 1.7);
  // Regardless of brightness, the side from which at least so many times more light of the sky is seen
  // without reflections is the bright one, if that light is at least this share of all: chosen by experiment.
  // Sunlit blinds behind a pane are as bright as the sky; through them the sky is hardly seen.
  RSPHERE_TUNED(Openings, double, kMoreSky, 3);
  RSPHERE_TUNED(Openings, double, kLeastSky, .1);
  // A hole belongs to an opening that is parallel to it (cosine) and whose middle is nearer than this share
  // of the shortest side: the faces of a wall are nearer to each other than a door is wide.
  static constexpr double kParallel = .99, kSameHole = .5;
  // Coplanar panes are merged to one opening, and the cells of a hole are taken for one, if they fill at
  // least this share, half, of the rectangle around them, so that most directions to it meet them. .91: the
  // same answers in all cases.
  static constexpr double kFilled = .5;
  // The form factor to an opening is estimated from its middle and from four points that are this share of
  // its sides away from its edges: chosen by experiment. 30% less: error +2%; 30% more: within noise (sensors
  // by sun; noise: error 5%, time 5%).
  RSPHERE_TUNED(Openings, double, kInset, .1);
};

// The control variate of sphere mode (radiance_guess.cpp).
struct RadianceGuess {
  // Directions that the guess is fitted to: chosen by experiment; a quarter of the directions of the default.
  // 30% less or more: within noise (points by sun; error 4%, time 5%).
  RSPHERE_TUNED(RadianceGuess, size_t, kFitGlances, 128);
  // Cap on the number of sources that are guessed one by one; those that contribute most are kept, and the
  // others become ambient light: chosen by experiment, to limit the time. 30% less or more: within noise
  // (points in workshop; error 7%, time 4%).
  RSPHERE_TUNED(RadianceGuess, size_t, kMostLights, 32);
  // Shadow rays that estimate the mean visibility of a source: chosen by experiment. 30% less or more: within
  // noise (points in workshop; error 11%, time 4%).
  RSPHERE_TUNED(RadianceGuess, double, kShadowRays, 12);
  // If a source adds more than this many times the mean guess at a place, shadow rays to fixed points on it
  // replace its mean visibility: chosen by experiment. This concerns a few percent of the glances, which
  // carry most of the light. 30% less or more: within noise (points beside goal; error 4%, time 3%).
  RSPHERE_TUNED(RadianceGuess, double, kBright, 16);
  // The fixed points are the square of the first number; if only some of them are visible, the place is in
  // penumbra, and they are the square of the second: by experiment. Beside a goal, penumbrae cause most of
  // the error of the guess. 1 or 3: within noise (points beside goal; error below 1%, time 4%).
  RSPHERE_TUNED(RadianceGuess, int, kSeenSide, 2);
  // 30% less or more: within noise (points beside goal; error below 1%, time 4%).
  RSPHERE_TUNED(RadianceGuess, int, kPenumbraSide, 4);
  // The form factor of a source with four corners is exact within this many times its radius: by
  // calculation. Beyond, it is that of a small surface, with an error of up to a seventh at grazing angles,
  // which is accurate enough for a guess. 30% less: within noise; 30% more: time +10% (points beside goal;
  // noise: error 10%, time 3%).
  RSPHERE_TUNED(RadianceGuess, double, kNear, 3);
  // Following an indirect ray takes about as long as this many guesses for each bounce that it may still
  // make: by measurement. 30% less or more: within noise (points in office; error 1%, time 1%).
  RSPHERE_TUNED(RadianceGuess, double, kBouncePrice, 30);
  // Cap on the guesses for each followed ray: chosen by experiment. 30% less or more: within noise (points in
  // workshop; error below 1%, time 4%).
  RSPHERE_TUNED(RadianceGuess, double, kMostGuesses, 6);
};

// Next-event estimation (direct_light.cpp).
struct DirectLight {
  // The brightest contributions that are tested for shadows whatever -dt says: chosen by experiment. 1 or 3:
  // within noise (picture of workshop; error below 1%, time 5%).
  RSPHERE_TUNED(DirectLight, size_t, kAlwaysTested, 2);
};

// Whether shadow rays or samples of the lobe estimate the light of sources in rough highlights
// (shared_highlights.cpp).
struct SharedHighlights {
  // If the lobe's density in a direction (per sr) times the solid angle of the source is below this, shadow
  // rays alone estimate the light from there: chosen by experiment. One shadow ray then brings at most this
  // multiple of the lobe's whole light.
  RSPHERE_TUNED(SharedHighlights, double, kLeast, .25);
};

// Which directions of gathers are aimed (gather_directions.cpp): shares of them in proportion to the light
// that probably comes from openings, from spots and from elsewhere. The figures are the work, variance times
// time, of paths without interpolation in four daylit rooms: a narrow and a wide one, by an overcast sky and
// by the sun.
struct GatherDirections {
  // The share of directions at openings, and of those at spots, for each share of the light that these
  // probably bring: by measurement. For openings, the work at .5 is 1.3, .9, 1 and 1 times that at .7, at .3
  // it is 7.8, 2.4, 1.1 and 1.2 times. For spots it is the same within its noise from .5 to .9.
  RSPHERE_TUNED(GatherDirections, double, kAimed, .7);
  // The light from elsewhere, relative to the smaller of two estimates that are made near openings, where
  // rooms are brighter than farther inside: by measurement. At 1 the work is 4.8, 2.3, .8 and 1 times that at
  // .5.
  RSPHERE_TUNED(GatherDirections, double, kFartherInside, .5);
  // The share falls by this multiple of the form factor to all openings, because rays hit openings that fill
  // much of the view without being aimed: chosen by experiment. 30% less or more: within noise (sensors by
  // sun; error 6%, time 5%).
  RSPHERE_TUNED(GatherDirections, double, kSeenAnyway, 2);
  // A smaller share of aimed directions is not worth the work: chosen by experiment. 30% less or more: within
  // noise (sensors by sun; error 4%, time 7%).
  RSPHERE_TUNED(GatherDirections, double, kTooFew, .02);
};

// Highlights of light sources on rough balls and cylinders, which indirect rays are aimed at (highlights.h,
// source_parts.cpp, highlight_lobe.cpp, ball_highlights.cpp, cylinder_highlights.cpp). Values without an
// origin are estimates that have not been varied. All of them change the variance and the time of answers,
// not their mean.
struct Highlights {
  // They are aimed at if they would add this multiple of the squared mean radiance to the variance of a
  // direction that meets them by chance: by measurement in an open-plan office with 50 rough balls and 51
  // rough legs (-ab 1 -ad 64), at a desk, above one and at the ceiling. At .2, only the desk gains.
  //          noise                   work relative to none
  //     none  2.61%  .92%  2.84%     1     1     1
  //     .1     .44%  .49%  2.84%     1.12  1.03  1.00
  //     .05    .44%  .20%  2.71%     1.13  1.04  1.01
  //     .02    .23%  .28%  2.58%     1.16  1.07  1.02
  RSPHERE_TUNED(Highlights, double, kLeast, .05);
  // Gathers of this many rays look for highlights on cylinders: by measurement in the same office, where that
  // takes as long as two rays. If single rays did so too, spherical means would take half as long again for
  // the same noise.
  RSPHERE_TUNED(Highlights, int, kMany, 16);
  // The multiple of kLeast for balls in other gathers, whose noise is larger: by measurement of spherical
  // means in the same office, for the same noise. They take 3% more work than without balls; at 1, 6%.
  // Conversely, kLeast divided by this is the threshold for a single highlight on a cylinder, of which many
  // add up. 30% less or more: within noise (picture of office; error below 1%, time 6%).
  RSPHERE_TUNED(Highlights, double, kLeastOfFew, 10);
  // A source is divided so that half the width of a part is at most this, relative to its distance from the
  // surface, because the highlight of a wider part is noticeably curved.
  RSPHERE_TUNED(Highlights, double, kHalf, .25);
  // Ratio of the extent of the aimed directions to that of the highlight, and of the region around the image
  // of a source in a mirroring ball (importance/glints.h) to that of the image. Without a margin, directions
  // would seldom meet the edge, and a part of the image would be left out. 30% less or more: within noise
  // (points beside chrome; error 9%, time 1%).
  RSPHERE_TUNED(Highlights, double, kWider, 1.2);
  // Cosines of surfaces seen edge-on are not taken to be smaller than this: of reflections, whose highlight
  // would have no extent; of bright spots, whose normal is a mean; and the sine between a cylinder and a
  // distant source along it. 30% less or more: within noise (sensors by sun; error 5%, time 5%).
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

// Light paths (light_vertices.h). Lengths are shares of the mean length from the sources to the first
// surfaces. By measurement in the open-plan office with a goal or lit (-Sn 512, -ab 3): rms of answers.
struct LightVertices {
  // Surfaces that a light path may meet: a bound for mirrors that face each other. Roulette ends nearly all
  // before.
  RSPHERE_TUNED(LightVertices, int, kMostHits, 100);
  // Paths that measure that mean length.
  RSPHERE_TUNED(LightVertices, size_t, kTried, 1024);
  // The distance at which a half of the light between diffuse surfaces is left to near rays. .05: error +40%
  // around the goal; .2 and .3: within noise.
  RSPHERE_TUNED(LightVertices, double, kWidth, .15);
  // The distance at which a half of that is left to joins with the eye, as a share of the eye's distance, or
  // of the mean length if that is less. Without it, one answer in 200 around the goal is 10% too bright: the
  // eye looks into the gap of 2 mm between a sheet of paper and the goal. .01: error +10% around the goal, in
  // a tenth less time; .4: within noise.
  RSPHERE_TUNED(LightVertices, double, kClose, .1);
  // The share of the places in view that follow paths from the eye for what is left to these, relative to the
  // share of light paths that meet something unknown, and at least.
  RSPHERE_TUNED(LightVertices, double, kRest, 4);
  RSPHERE_TUNED(LightVertices, double, kLeastRest, .125);
};

// Light that leaves sources (source_emission.h).
struct SourceEmission {
  // Directions in which light from a source with a pattern or a cone is tried, of which one is followed.
  RSPHERE_TUNED(SourceEmission, int, kTries, 8);
  // Those that tell its power, and what is added for light that they may miss, in units of its radiance
  // without patterns.
  RSPHERE_TUNED(SourceEmission, int, kTriesForPower, 1024);
  RSPHERE_TUNED(SourceEmission, double, kMissed, .01);
};

// Light vertices as seen from a place (vertex_light.h).
struct VertexLight {
  // Clusters of vertices, whose light at a place is estimated, and the vertices that are drawn from them.
  // The time of both is what a shadow ray takes. 256: variance of this light -25%, half as long again for
  // all; 512: -50%, twice as long.
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kClusters, 128);
  RSPHERE_TUNED_ROOM(VertexLight, size_t, kCandidates, 8);
  // How far apart vertices are that face opposite ways, as a share of twice the size of the scene. .12:
  // variance of this light up to three times as large.
  RSPHERE_TUNED(VertexLight, double, kFacing, .05);
  // Candidates that get a shadow ray. 8: within noise.
  RSPHERE_TUNED(VertexLight, int, kJoined, 2);
  // Specularity of rough surfaces from which on those that mirrors show get the shadow rays of others: one
  // alone would leave their highlights to chance, and brushed steel beside the goal would bring 14 W/sr/m2
  // from a surface that emits 1.
  RSPHERE_TUNED(VertexLight, double, kStrong, .1);
  // The share of surfaces that a reflection shows at which a gather looks for light that has come to them by
  // another reflection, which vertices do not bring.
  RSPHERE_TUNED(VertexLight, double, kFollowed, .25);
};

// How many rays a ray splits into (ray_limits.h).
struct RayLimits {
  // The number of descendants of a gather's ray, apart from the ancestors of the next one, beyond which weak
  // ones are followed by Russian roulette; for a primary ray of sphere mode, for each of the -ad + -as rays:
  // by measurement. 99% of the directions in a room with a chrome column have fewer (-ab 6, -ad 4), those in
  // a closed metal cylinder up to 1000.
  //
  // Sharp paths of a gather's ray are followed by Russian roulette once their weight is below the inverse of
  // this, with a probability in proportion to their weight. Gathers begin with a weight of 1/2, so that one
  // of their rays has at most half as many descendants at a time on average; without a limit their number
  // doubles at each surface of nested transparent objects, up to -lr. 32: a fifth less time with three nested
  // cylinders that reflect and transmit a tenth; more noise behind a pane that transmits 5%.
  RSPHERE_TUNED(RayLimits, double, kMostDescendants, 64);
  // The same for a patch of the coarse solution, for each of its rays: by measurement. Between two boxes of
  // rough trans most patches would have 16 to 40, between two of rough metal 7 to 9. With 8, a point before
  // the boxes of trans takes twice the time, for the same noise.
  RSPHERE_TUNED(RayLimits, double, kMostOfPatch, 2);
  // A primary ray of sphere mode and a ray of a gather ask for so many patches whatever their weight, and for
  // about so many further ones, each with a probability in proportion to its weight: by measurement. Where
  // surfaces reflect and transmit in lobes, a ray asks for 5 patches in an open-plan office and for 12
  // between boxes of rough trans. Most of them contribute little, and each has rays of its own. Without a
  // limit, a point before the boxes takes twice the time. Directions within the boxes then have a standard
  // deviation of 6%, with 1 and 1 of 90%, with 2 and 4 of 37%.
  RSPHERE_TUNED(RayLimits, int, kAsked, 2);
  RSPHERE_TUNED(RayLimits, double, kFurther, 8);
  // Both for a ray of a patch, of which there are many: the least. With 4 and no further ones, the point
  // before the boxes takes twice the time, for the same noise.
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
