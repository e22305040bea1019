#pragma once
// Starts light paths on known sources (plain_surfaces.h), their number on each in proportion to its power.
//
// Even sources send the same radiance from all points into all directions. Spots, and sources with a pattern,
// such as the light distribution of a luminaire, do not. For these, several candidates (a point and a
// direction) are drawn, and one is chosen in proportion to its power (resampled importance sampling: Talbot,
// Cline and Egbert 2005, "Importance resampling for global illumination").
#include "light/surface_point.h"
#include "transport/plain_surfaces.h"

namespace rsphere {

// Shared by all threads; constant. Keeps references.
class SourceEmission {
 public:
  // paths: the number of paths from all sources together.
  SourceEmission(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t paths);

  // The same with most paths from preferred sources (numbers of LightIds; for an image, from its source),
  // each of these paths with less power. The noise of the others is at most twice what it is without
  // preference.
  SourceEmission preferring(std::span<const uint32_t> preferred) const;

  // Of the brightness, W; approximate unless the source is even. 0 for images.
  double power(LightId source) const { return senders_[source].power; }

  // The source at which the cumulative share of paths reaches this value (0 to 1). kNone if no source has
  // power.
  LightId sourceAt(double share) const;

  struct Leaving {
    SurfacePoint from;
    V3d direction{0, 0, 1};  // unit
    Irradiance power;        // of the path, W
  };
  Leaving leave(LightId source, Random& random, FunctionScratch& scratch) const;

  // Mean power of a path, W (brightness). All paths from even sources have this power unless some sources are
  // preferred.
  double pathPower() const { return pathPower_; }

  // Factor on the light at this distance from its source (world units): the light of a spot diverges from a
  // focus behind the spot.
  double divergence(LightId source, double distance) const;
  // Whether the density at which shadow rays are aimed at the source is known.
  bool isAimedAt(LightId source) const { return senders_[source].even && aimedDensity(source, 1, 1) > 0; }
  // The density of shadow rays from a place to a point on an even source, divided by the density of light
  // paths through both places (m2). normal: at the place (unit). probability: that its source is drawn.
  double shadowRaysOver(const SourceSample& sample, const V3d& normal, double probability) const;
  // The image of a source in a mirror; kNone if there is none, or if the image lights nothing.
  LightId imageOf(LightId source, SurfaceId mirror) const;

 private:
  struct Sender {
    double power = 0;    // W, of brightness; approximate unless it is even
    double upTo = 0;     // cumulative share of the paths, up to and including this source
    double factor = 1;   // paths by preference: the number per power, relative to the mean
    double density = 0;  // of paths that begin on it (1/m2); 0: it is not even
    double area = 0;     // m2
    bool even = false;
  };
  // A candidate for the light that leaves a source.
  struct Way {
    SurfacePoint from;
    V3d direction{0, 0, 1};
    Radiance radiance{};
    double weight = 1;  // density of such light from a diffuse emitter, over the density of candidates
  };
  Way way(LightId source, Random& random, FunctionScratch& scratch) const;
  double triedPower(LightId source) const;
  double aimedDensity(LightId source, double distance, double cosine) const;
  void share();

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  ById<LightId, Sender> senders_;
  size_t paths_;
  double pathPower_ = 0;
};

}  // namespace rsphere
