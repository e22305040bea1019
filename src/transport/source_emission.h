#pragma once
// How known sources (plain_surfaces.h) send light out: paths from each in proportion to its power.
//
// Even sources send the same radiance from all points into all directions. Those with a pattern, such as the
// light distribution of a luminaire, and spots do not: light is tried in several ways, of which one is chosen
// in proportion to its power (resampled importance sampling: Talbot, Cline and Egbert 2005, "Importance
// resampling for global illumination").
#include "light/surface_point.h"
#include "transport/plain_surfaces.h"

namespace rsphere {

// Shared by all threads; constant. Keeps references.
class SourceEmission {
 public:
  // paths: that are sent from all sources together.
  SourceEmission(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t paths);

  // The source that a share (0 to 1) of the power of all leads to; kNone: none.
  LightId sourceAt(double share) const;

  struct Leaving {
    SurfacePoint from;
    V3d direction{0, 0, 1};  // unit
    Irradiance power;        // of the path, W
  };
  Leaving leave(LightId source, Random& random, FunctionScratch& scratch) const;

  bool isEven(LightId source) const { return senders_[source].even; }
  // Of the paths that begin on an even source (1/m2); 0 for others.
  double density(LightId source) const { return senders_[source].density; }
  double pathPower() const { return pathPower_; }  // brightness of each path, W, but for the choice of ways

  // The factor on the light that has come this far (world units): the light of a spot diverges from a focus
  // behind it.
  double divergence(LightId source, double distance) const;
  // The image of a source in a mirror; kNone if it has none, or if that lights nothing.
  LightId imageOf(LightId source, SurfaceId mirror) const;

 private:
  struct Sender {
    double power = 0;    // W, of brightness; approximate unless it is even
    double upTo = 0;     // share of the power of all sources, of those up to this one
    double density = 0;  // of paths that begin on it (1/m2)
    double area = 0;     // m2
    bool even = false;
  };
  // A way in which light may leave a source.
  struct Way {
    SurfacePoint from;
    V3d direction{0, 0, 1};
    Radiance radiance{};
    double weight = 1;  // density of even light, which goes by the cosine, over that of such ways
  };
  Way way(LightId source, Random& random, FunctionScratch& scratch) const;
  double triedPower(LightId source) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  ById<LightId, Sender> senders_;
  double pathPower_ = 0;
};

}  // namespace rsphere
