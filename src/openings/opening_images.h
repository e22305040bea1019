#pragma once
// The images of openings (openings.h) in flat mirrors. An image brings daylight to places that see the
// opening in the mirror, perhaps only there. It lies behind its mirror, and rays are aimed at it as at an
// opening.
#include <span>
#include <vector>

#include "openings/openings.h"
#include "rays/prepared_scene.h"

namespace rsphere {

// Missed images, and places from which other surfaces hide an image, change the variance, not the mean.
class OpeningImages {
 public:
  // Uses polygons of mirror, or of smooth metal or plastic, outside of instances. Keeps no references.
  OpeningImages(const PreparedScene& prepared, const Openings& openings);

  struct Image {
    Rectangle place;    // of the image; its normal points along the light
    Rectangle mirror;   // around the polygon; its normal points to the side of the light
    SurfaceId surface;  // of the mirror
    double filled;      // as Opening::filled
    double radiance;    // W/sr/m2, the opening's mean radiance times the reflectance
    double power;       // estimate of the light that the mirror reflects, as Opening::power
    // The height of a place (world) above the mirror.
    double above(const V3d& at) const { return (at - mirror.corner).dot(mirror.normal); }
    // The intersection of the mirror's plane with the line from a place above it to a place below it.
    V3d crossing(const V3d& from, const V3d& to) const;
  };
  // The strongest images, in descending order of power.
  std::span<const Image> all() const { return images_; }
  bool empty() const { return images_.empty(); }
  // The mean brightness (W/sr/m2) behind the openings, on their dark sides: Openings::inside().
  double inside() const { return inside_; }

  // See LightFinder. Few directions are aimed at an image of which little lies within the mirror's outline.
  using Aim = Openings::Aim;
  static constexpr AimedAt kKind = AimedAt::openings;
  void aim(const AimFrom& from, Aim& aim) const;
  V3d sample(const Aim& aim, double u1, double u2, double u3) const;
  double density(const Aim& aim, const V3d& direction) const;

 private:
  std::vector<Image> images_;
  size_t aimed_ = 0;  // number of images that rays are aimed at
  double inside_;
};

}  // namespace rsphere
