#pragma once
// The images of openings (openings.h) in flat mirrors. An image brings daylight to places that see the
// opening in the mirror, perhaps only there. It lies behind its mirror, and rays are aimed at it as at an
// opening.
#include "openings/openings.h"
#include "rays/prepared_scene.h"

namespace rsphere {

// The normal of its rectangle points along the light. Its radiance includes the reflectance; its power is an
// estimate of the light that the mirror reflects.
struct OpeningImage : Opening {
  Rectangle mirror;   // around the polygon; its normal points to the side of the light
  SurfaceId surface;  // of the mirror
  // The intersection of the mirror's plane with the line from a place above it to a place below it.
  V3d crossing(const V3d& from, const V3d& to) const;
};

// The strongest images. Missed images, and places from which other surfaces hide an image, change the
// variance, not the mean.
class OpeningImages : public AimedAtOpenings<OpeningImage> {
 public:
  // Uses polygons of mirror, or of smooth metal or plastic, outside of instances. Keeps no references.
  OpeningImages(const PreparedScene& prepared, const Openings& openings);

  // See LightFinder. Few directions are aimed at an image of which little lies within the mirror's outline.
  void aim(const AimFrom& from, Aim& aim) const;

 private:
  size_t aimed_ = 0;  // number of images that rays are aimed at
};

}  // namespace rsphere
