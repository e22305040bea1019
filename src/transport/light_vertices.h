#pragma once
// Light vertices: the places at which light paths from the sources arrive on diffuse surfaces. Joined to
// paths from the eye (vertex_light.h), they bring light that paths from the eye alone would meet only by
// chance.
//
// Light paths are the paths of path_tracer.h, traced in the opposite direction:
// - The light of a source reaches the first diffuse surface directly, through panes, or by a rough highlight,
//   but not by a sharp reflection, because shadow rays do not follow sharp reflections either.
// - Surfaces on the way reflect it diffusely, sharply or by a rough highlight, diffusely at most -ab times.
#include <optional>
#include <vector>

#include "transport/function_ref.h"
#include "transport/hidden_boxes.h"
#include "transport/light_vertex.h"
#include "transport/plain_surfaces.h"
#include "transport/source_emission.h"

namespace rsphere {

// Shared by all threads; constant.
class LightVertices {
 public:
  // Sends paths from the sources as `emission` divides them. Keeps references to the first two.
  // REQUIRES that PlainSurfaces::obstacle() found none.
  LightVertices(const PreparedScene& prepared, const PlainSurfaces& surfaces, SourceEmission emission,
                size_t paths, uint64_t seed);

  // Vertices whose light goes on to other diffuse surfaces. Those of a cluster follow each other.
  const std::vector<LightVertex>& all() const { return all_; }
  // The position after the last vertex of each cluster (vertex_clusters.h) in all().
  const std::vector<uint32_t>& clusterEnds() const { return ends_; }
  // The light that arrives at vertex i of all(), times the color of the material (W). The fraction
  // diffuseShare() of it is reflected.
  const Irradiance& powerOf(size_t i) const { return powers_[i]; }
  const Opaque& materialOf(size_t i) const { return *surfaces_.materialOf(hits_[i]); }

  // A vertex that may be joined directly to the eye, the point where the answer is wanted.
  struct Visible {
    LightVertex vertex;
    Irradiance power;  // as powerOf(); of direct light, without the color of the material
    V3d direction;     // in which the light arrives (unit)
    const Opaque* material;
    Color pattern;
    bool flat;
    double length;  // distance from the surface or the source that sent the light, world units
    // For direct light, the density of shadow rays from the vertex to the place on the source where its path
    // began, divided by the density of light paths through both places (m2); otherwise 0.
    double shadowRays;
  };
  const std::vector<Visible>& visible() const { return visible_; }
  // Calls use(begin, end) for ranges of visible(), ascending, that contain all vertices but some that
  // are hidden from the point.
  void visibleFrom(const V3d& point, FunctionRef<void(size_t begin, size_t end)> use) const;

  // The same ratio as Visible::shadowRays, for a shadow ray whose source was drawn with this probability.
  // normal: at the origin of the ray (unit).
  double shadowRaysOver(const SourceSample& sample, const V3d& normal, double probability) const;

  // The fraction of the light between two diffuse surfaces at this distance (world units) that rays bring,
  // because the noise of vertices would be too large.
  double nearShare(double distance) const {
    return width_ * width_ / (distance * distance + width_ * width_);
  }
  // The part of nearShare() that rays leave to joins with the eye, because they meet narrow gaps too rarely.
  // Gaps are narrow relative to fromEye, the distance of the place from the eye (world units).
  double closeShare(double distance, double fromEye) const;
  // The fraction of a vertex's light that joins bring to an eye at this distance.
  double joinedShare(const Visible& v, double fromEye) const {
    switch (v.vertex.way) {
      case LightVertex::diffuse:
        return closeShare(v.length, fromEye) * nearShare(v.length);
      case LightVertex::highlight:
        return 1 - nearShare(v.length);
      default:
        return 1;
    }
  }
  double width() const { return width_; }  // distance at which nearShare() is 1/2, world units

  // The probability of following paths from the eye at a place, for the light that is left to them. It is
  // higher where more of the light meets unknown surfaces.
  double shareOfRest() const { return shareOfRest_; }
  double pathPower() const { return emission_.pathPower(); }  // brightness of each path, W
  double meanLength() const { return meanLength_; }           // from sources to first surfaces, world units

 private:
  class Path;
  static constexpr size_t kBlock = 256;
  void findHidden();
  void measure(size_t paths, uint64_t seed);
  void sort();
  double aimedDensity(LightId light, double distance, double cosine) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  SourceEmission emission_;
  double shareOfRest_ = 1;
  size_t met_ = 0, metUnknown_ = 0;  // numbers of surfaces that light paths have met
  double meanLength_ = 1, width_ = 0;
  std::vector<LightVertex> all_;
  std::vector<Irradiance> powers_;
  std::vector<SurfaceId> hits_;
  std::vector<uint32_t> ends_;
  std::vector<Visible> visible_;
  std::optional<HiddenBoxes> hidden_;  // boxes around blocks of visible_; none where little is hidden
};

// Approximate reflectance of a place for light that arrives from one direction (unit) and goes to the eye, as
// a multiple of a white diffuse surface's; used to choose joins. view: direction (unit) of the ray that sees
// the place.
double joinedReflectance(const Opaque& material, const V3d& normal, const V3d& view, const V3d& toSource);

}  // namespace rsphere
