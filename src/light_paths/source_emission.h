#pragma once
// Starts light paths on known sources (plain_surfaces.h). The number of paths from each source is
// proportional to its power. Paths of distant sources start on portals (portals.h), by projected area.
//
// An "even" source emits the same radiance from all points in all directions. Spotlights are not even, nor
// are sources with a pattern, such as the light distribution of a luminaire. For these, several candidates (a
// point and a direction) are sampled, and one is selected with a probability proportional to its power
// (resampled importance sampling: Talbot, Cline and Egbert 2005, "Importance resampling for global
// illumination").
#include "light_paths/plain_surfaces.h"
#include "spots/light_particles.h"

namespace rsphere {

// Samples where, and in which direction, light leaves the sources. Shared by all threads, because it
// never changes. Keeps references to the scene and to `surfaces`.
class SourceEmission {
 public:
  // paths: total number of paths from all sources.
  SourceEmission(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t paths);

  // An emission with most paths from preferred sources, each of which then has less power. This at most
  // doubles the noise from other sources. preferred: numbers of LightIds; for a virtual source, its real
  // source is preferred.
  SourceEmission preferring(std::span<const uint32_t> preferred) const;

  // The power of a source by brightness, W; approximate unless the source is even; 0 for virtual sources. For
  // a distant source: the power that enters through portals if nothing hides it.
  double power(LightId source) const { return senders_[source].power; }

  // The source of the path at this position (0 to 1) in the sequence of all paths, which is ordered by
  // source. kNone if no source has any power.
  LightId sourceAt(double share) const;

  struct Leaving {
    SurfacePoint from;       // of a distant source: on a portal, facing along the light
    V3d direction{0, 0, 1};  // unit
    Irradiance power;        // of the path, W
  };
  Leaving leave(LightId source, ScrambledPoint& random, FunctionScratch& scratch) const;

  // The mean power of a path, W (brightness). All paths from even sources have this power, unless some
  // sources are preferred.
  double pathPower() const { return pathPower_; }

  // Factor on the light at this distance from its source (world units), because the light of a spotlight
  // diverges from a focus behind it.
  double divergence(LightId source, double distance) const;
  // Whether the source is even. The densities of its light paths and of shadow rays to it are then known.
  bool isEven(LightId source) const { return senders_[source].even; }
  // For a place and a point on an even source: the density of shadow rays from the place to the point,
  // divided by the density of light paths from the point to the place (m2). normal: at the place (unit).
  // probability: of selecting this source for a shadow ray.
  double shadowRaysOver(const SourceSample& sample, const V3d& place, const V3d& normal,
                        double probability) const;
  // As shadowRaysOver(), for samples of a lobe with this density per sr instead of shadow rays.
  double lobesOver(const SourceSample& sample, const V3d& normal, double density) const;
  // The image of a source in a mirror; kNone if there is none, or if the image lights nothing.
  LightId imageOf(LightId source, SurfaceId mirror) const;

 private:
  struct Sender {
    double power = 0;  // W, of brightness; approximate unless it is even
    double upTo = 0;   // cumulative fraction of the paths, including those of this source
    // Number of its paths divided by its power, relative to the mean of all sources; 1 without preference.
    double factor = 1;
    double density = 0;  // of paths that start on it (1/m2); 0: not even
    double area = 0;     // m2; of a distant source, the projected area of the portals
    bool even = false;
  };
  // A candidate for the start of a light path.
  struct Candidate : LampWay {
    Radiance radiance;
  };
  template <class Numbers>
  Candidate candidate(LightId source, Numbers& random, FunctionScratch& scratch) const;
  Leaving leaveDistant(LightId source, ScrambledPoint& random) const;
  double triedPower(LightId source) const;
  void share();

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  ById<LightId, Sender> senders_;
  size_t paths_;
  double pathPower_ = 0;
};

}  // namespace rsphere
