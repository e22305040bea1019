#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include <cstddef>

#include "base/constants.h"
#include "base/tuned.h"

namespace rsphere::tuning {

// Light sources that are integrated separately (seen_sources.cpp).
struct SeenSources {
  // Part of the cap on the rays to one image (see kSmallestPart), as a fraction of all rays divided by the
  // number of images. Without it, the error for a small half-hidden lamp would not fall with more directions.
  // Also the number of rays below which an image in a mirror is left to the base directions: chosen by
  // experiment. A tenth of a ray is a ray at one in ten points, with ten times the weight. Insensitive.
  RSPHERE_DERIVED(SeenSources, double, kSmallShare, .1);
  // The number of rays to an image is proportional to its light raised to this power: derived. Of the n parts
  // of a half-hidden image, only those on the shadow's edge are uncertain, so that the error for light L is
  // proportional to L n^-3/4. The sum of L^2 n^-3/2 over all images, for a given sum of n, is smallest for n
  // proportional to L^(4/5).
  static constexpr double kByLight = 4. / 5;
  // Number of directions that measure, without tracing rays, how much of a region its source fills: derived.
  // An edge divides about n^1/2 of n even cells. Their errors, of .3 each, add up to .3 n^-3/4 of the region:
  // .2%.
  static constexpr size_t kShareTries = 1024;
  // Shadow rays along each side of a direction's cell on a directly visible source: measured at points where
  // a partition hides part of the goal. With 2, the error is 3% instead of 1.8%, in an equal time. With 8, no
  // effect beyond noise.
  RSPHERE_TUNED(SeenSources, size_t, kShadowsAlong, 4);
  // Cap on the rays to a small image of a source, as many as the shadow rays of one cell.
  static inline const double kUsualRays = static_cast<double>(kShadowsAlong * kShadowsAlong);
  // One ray is allowed for each part of the image of a source with this solid angle (sr): derived. The cell
  // of one of the usual 2048 base directions gets kUsualRays. The cap on the rays to one image is the largest
  // of kUsualRays, one for each such part, and kSmallShare times an even share of all rays to images. Without
  // the parts, the error below a luminous ceiling partly hidden by 36 balls is 2.9% instead of .5%.
  RSPHERE_DERIVED(SeenSources, double, kSmallestPart, 4 * kPi / 2048 / (kShadowsAlong * kShadowsAlong));
};

// The special objects and their density of directions (special_objects.h). The paper gives only the
// resulting numbers of directions: with 1 to 100 small spheres in a furnished open-plan office, 2200 to 3500
// in all. These values were chosen so that every point of examples/openplan has as many (accuracy_test.cpp,
// SendsAsManyDirectionsAsThePaper; tests/bench/importance/runs/2026-11-21-histogram.txt). They set the
// numbers of directions of -Sw v, and choose the special objects of both -Sw v and -Sw c.
struct SpecialObjects {
  // Directions per sr for an irregularity of 1, times -Sk. A hundred spheres of 0.1 m then get 1000. Reducing
  // it by 30% changes the time by -17%, raising it by 30% by +15% (Voronoi cells).
  RSPHERE_TUNED(SpecialObjects, double, kDirectionsPerSr, 32000);
  // Roughness a (rms slope) at which a highlight is half as irregular as a mirror: derived. The highlight
  // fills 4 pi a^2 sr, so that about 16 directions, four across, hit it. Rougher balls show no images of
  // light sources (glints.h).
  static constexpr double kSharpRoughness = .0065;
  // The irregularity of glass panes. It is low because objects behind a pane look as large as without it, and
  // its reflections are faint (none with a refraction of 1): 64 directions per sr, at most a few hundred.
  static constexpr double kPane = .002;
  // Objects whose radiance varies less with direction than this are treated as diffuse: derived. At this
  // threshold they would get 16 directions per sr, a tenth of the density of the default base directions.
  static inline const double kSpecialIrregularity = 16 / kDirectionsPerSr;
  // Up to this number of special objects, looking at each of them takes less time than finding out which are
  // hidden (HiddenBoxes). Measured.
  static constexpr size_t kFewHidden = 1024;
  // If octrees and meshes contain more special objects than this, each outermost instance becomes one
  // object, because the silhouettes of all objects are computed at every point. It is also the cap on pairs
  // of a mirror and a light source, whose silhouettes are computed as well; the largest mirrors are kept.
  // Insensitive.
  static constexpr size_t kMostPlacedObjects = 4096;
};

// Regions of directions used in place of exact silhouettes (silhouette.cpp, silhouette_index.cpp).
struct Silhouettes {
  // Largest half angle (rad) of an object, as seen from the point, for which a hull is computed instead of a
  // cap: derived. Hulls are computed on a plane, where rounding costs two digits of sixteen at this angle.
  // With 1.2, the error beside chrome is 30% larger, in an equal time.
  RSPHERE_DERIVED(Silhouettes, double, kWidestHull, 1.5);
  // Corners of the polygon around a circle: derived. The polygon's area is 1.3% larger than the circle's, so
  // that 1.3% of the directions to it miss the object. When searching for images on balls, light sources with
  // more corners are replaced by squares around them. Insensitive.
  static constexpr int kCorners = 16;
  // Cells along each edge of a face of the cube map that lists the silhouettes near a direction: chosen by
  // experiment. Without cells, the search among 180 special objects took 18% of the time.
  static constexpr int kSide = 6;
};

}  // namespace rsphere::tuning
