#pragma once
// Light sources as they are seen from a point, straight or in something flat that mirrors: few, small,
// bright, and known, so that they are integrated by themselves rather than left to chance. All directions
// fall in two classes: those in which such an image of a source shows (also through panes), and the rest.
// This samples the first class; others leave it out.
#include <vector>

#include "importance/direction_sample.h"
#include "importance/silhouette.h"
#include "transport/path_tracer.h"

namespace rsphere {

class SeenSources {
 public:
  // Chooses the sources that are integrated apart: all that a view shows as sources (not illum), but for
  // distant ones wider than tuning::SeenSources::kWidestDistant; and the flat surfaces that may mirror them.
  // Keeps a reference to transport.
  explicit SeenSources(const Transport& transport);

  // Where a source may be seen from a point.
  struct Image {
    uint32_t source = 0;     // index in LightSources
    int32_t mirror = kNone;  // index in Scene::surfaces; kNone: seen straight
    Silhouette region;
    double solidAngle = 0;  // sr, if nothing hides it
    bool filled = true;     // the region shows nothing else
    double rays = 0;        // to be spent on it, on average
  };

  // The images that are integrated apart at a point, with about `most` rays for all of them by the light that
  // each may send, times mirrorFactor for mirrored ones: those not worth half a ray are left to the other
  // directions.
  std::vector<Image> findImages(const V3d& point, size_t most, double mirrorFactor) const;

  // Whether the last primary ray of the tracer showed one of a point's images.
  bool shown(const PathTracer& tracer, const std::vector<Image>& images) const;

  // Whether it showed the source of one of these images straight.
  bool shownStraight(const PathTracer& tracer, const std::vector<Image>& images) const;

  // Whether it showed a source straight that is integrated apart wherever it is seen from.
  bool shown(const PathTracer& tracer) const {
    const PathTracer::Shown& s = tracer.shown();
    return s.source != kNone && s.mirror == kNone && apart_[s.source];
  }

  // Surfaces whose sources are integrated apart where they are seen straight, by index in Scene::surfaces;
  // and those that may mirror them.
  const std::vector<bool>& apart() const { return apart_; }
  const std::vector<int32_t>& mirrors() const { return mirrors_; }

  // One traced direction to an image.
  struct Sample {
    DirectionSample direction;  // solidAngle 0 where something hides the source
    double part = 0;            // what it would be if nothing did, sr
    int aimed = 1, clear = 1;   // shadow rays to its part, and those that nothing stopped
    Ray ray;
    size_t image = 0;  // index in images
    size_t row = 0;    // of the grid that lies on it
  };

  // Directions to the images, each with the solid angle it stands for and the radiance along it; one in each
  // cell of a grid that is even by solid angle. Of an image that is seen straight 2 x 2 shadow rays
  // tell how much of the cell is hidden, and one of those that nothing stopped is followed. Where an image is
  // seen whole its solid angles sum to its own, exact for polygons, spheres and distant sources, within 0.1%
  // for others. Unbiased.
  std::vector<Sample> sample(const V3d& point, const std::vector<Image>& images, uint64_t seed,
                             PathTracer& tracer) const;

 private:
  struct Cell {
    size_t row = 0, column = 0, rows = 1, columns = 1;
  };
  void addMirrored(const V3d& point, std::vector<Image>& images) const;
  void sampleImage(const V3d& point, const Image& image, size_t rays, double solidAngle, uint64_t seed,
                   PathTracer& tracer, std::vector<Sample>& samples) const;
  void sampleCell(const V3d& point, const Image& image, const Cell& cell, Random& random, PathTracer& tracer,
                  std::vector<Sample>& samples) const;

  const Transport& transport_;
  std::vector<bool> apart_;        // by surface
  std::vector<uint32_t> sources_;  // those apart, index in LightSources
  std::vector<int32_t> mirrors_;   // index in Scene::surfaces
};

}  // namespace rsphere
