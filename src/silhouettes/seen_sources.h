#pragma once
// Images of light sources as seen from a point, directly or in a flat mirror. They are few, small and bright,
// and their positions are known, so they are integrated separately instead of being hit by chance. This file
// samples directions that show an image, perhaps through panes. All other directions of a set ignore light
// from these images.
#include <optional>
#include <vector>

#include "points/direction_sample.h"
#include "silhouettes/silhouette.h"
#include "transport/path_tracer.h"

namespace rsphere {

class SeenSources {
 public:
  // Chooses the sources that are integrated separately, and the flat surfaces that may mirror them. All
  // sources are chosen except illums, because a viewer does not see illums as sources. Keeps a reference to
  // the prepared scene.
  explicit SeenSources(const PreparedScene& prepared);

  // An image of a source as seen from a point.
  struct Image {
    LightId source;
    SurfaceId mirror;  // kNone: seen directly
    Silhouette region;
    double solidAngle = 0;  // of the region, sr
    bool filled = true;     // whether the source fills the region
    double rays = 0;        // number of samples on average
  };

  // The images that are integrated separately at a point. About `most` rays are divided among them according
  // to the unoccluded light of each image; mirrorFactor multiplies the rays to mirrored images. Mirrored
  // images with fewer rays than tuning::SeenSources::kSmallShare are left to the other directions.
  std::vector<Image> findImages(const V3d& point, size_t most, double mirrorFactor) const;

  // Whether the source that a primary ray showed is one of a point's images.
  bool isOne(const ShownSource& shown, const std::vector<Image>& images) const;

  // Whether a primary ray showed the source of one of the images directly, not mirrored.
  bool isOneStraight(const ShownSource& shown, const std::vector<Image>& images) const;

  // Whether a primary ray showed, directly, a source that is integrated separately at all points.
  bool isApart(const ShownSource& shown) const {
    return shown.source != kNone && shown.mirror == kNone && apart_[shown.source];
  }

  // Whether there are sensors (scene/sensors.h) among the sources.
  bool haveSensors() const { return haveSensors_; }

  // By surface: whether it is a source that is integrated separately where it is directly visible.
  const ById<SurfaceId, bool>& apart() const { return apart_; }
  // The flat surfaces that may mirror these sources.
  const std::vector<SurfaceId>& mirrors() const { return mirrors_; }

  // One traced direction to an image.
  struct Sample {
    DirectionSample direction;  // solidAngle: 0 if something hides the source
    double part = 0;            // solid angle of its cell if nothing hides the source, sr
    int aimed = 1, clear = 1;   // shadow rays to its cell; how many of them reached the source
    TracedRay ray;
    size_t image = 0;   // index in images
    size_t row = 0;     // of the image's grid
    double chance = 1;  // probability that the image is sampled; below 1 if there are more images than rays
  };

  // Directions to the images, each with the solid angle that it represents and the radiance along it. There
  // is one in each cell of a grid of equal solid angles. For an image that is seen directly, shadow rays
  // (tuning::SeenSources::kShadowsAlong) measure the visible fraction of the cell, and one of the
  // unobstructed ones is traced. If nothing hides an image, the solid angles of its directions sum to its
  // solid angle: exactly for polygons, spheres and distant sources, within 0.1% for others. The estimate is
  // unbiased.
  std::vector<Sample> sample(const PathsFrom& paths, const std::vector<Image>& images, uint64_t seed) const;

 private:
  // The rays to one image, and the solid angle that they represent if the source fills its region.
  struct Share {
    size_t rays = 0;
    double solidAngle = 0;  // sr
  };
  // A cell of the grid on an image, and the random numbers for its sample.
  struct Cell {
    size_t row = 0, column = 0, rows = 1, columns = 1;
    Random& random;
  };
  void setExtent(Image& image, const V3d& eye, const Silhouette* window = nullptr) const;
  V3d directionIn(const Image& image, const V3d& eye, double u, double v) const;
  void addMirrored(const V3d& point, std::vector<Image>& images) const;
  std::vector<Sample> sampleImage(const PathsFrom& paths, const Image& image, const Share& share,
                                  uint64_t seed) const;
  double filledShare(const Image& image, const V3d& eye, Random& random) const;
  // Empty if no part of the source is in the cell.
  std::optional<Sample> sampleStraight(const PathsFrom& paths, const Image& image, const Cell& cell) const;
  std::optional<Sample> sampleMirrored(const PathsFrom& paths, const Image& image, const Cell& cell) const;

  const PreparedScene& prepared_;
  ById<SurfaceId, bool> apart_;
  std::vector<LightId> sources_;  // those integrated separately
  std::vector<SurfaceId> mirrors_;
  bool haveSensors_ = false;
};

}  // namespace rsphere
