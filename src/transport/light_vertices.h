#pragma once
// Light vertices: the places at which light paths from the sources arrive on diffuse surfaces. Joined to
// paths from the eye (vertex_light.h), they bring light that these alone would meet by chance only.
//
// A light path may do what the paths of path_tracer.h may do, in the opposite order:
// - The light of a source reaches a diffuse surface straight, through panes, or by the rough highlight of a
//   surface, but by no sharp reflection: shadow rays do not follow these either.
// - A diffuse surface reflects it diffusely, sharply or by its rough highlight, up to -ab times diffusely.
#include <vector>

#include "transport/light_vertex.h"
#include "transport/plain_surfaces.h"
#include "transport/source_emission.h"

namespace rsphere {

// Shared by all threads; constant.
class LightVertices {
 public:
  // Sends paths from the sources, as many from each as its share of the power of all. Keeps references.
  // REQUIRES that PlainSurfaces::obstacle() found none.
  LightVertices(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t paths, uint64_t seed);

  // Vertices whose light goes on to other diffuse surfaces, neighbours next to each other.
  const std::vector<LightVertex>& all() const { return all_; }
  // The position after the last vertex of each cluster (vertex_clusters.h) in all().
  const std::vector<uint32_t>& clusterEnds() const { return ends_; }
  // Of vertex i of all(): the light that arrives, times the color of the material (W). diffuseShare() of it
  // is reflected.
  const Irradiance& powerOf(size_t i) const { return powers_[i]; }
  const Opaque& materialOf(size_t i) const { return *surfaces_.materialOf(hits_[i]); }

  // A vertex that the eye itself may be joined to.
  struct Visible {
    LightVertex vertex;
    Irradiance power;  // as powerOf(); of direct light, without the color of the material
    V3d direction;     // in which the light arrives (unit)
    const Opaque* material;
    Color pattern;
    bool flat;
    double length;  // from the surface, or the source, that has sent the light, world units
    // The density of shadow rays from there to the same place of the source, over the density of light paths
    // by way of both places (m2). 0 unless the light is direct.
    double shadowRays;
  };
  const std::vector<Visible>& visible() const { return visible_; }

  // Visible::shadowRays for a shadow ray from a place, if its source was drawn with this probability.
  double shadowRaysOver(const SourceSample& sample, const V3d& normal, double probability) const;

  // The share of the light that one diffuse surface sends to another at this distance (world units) for which
  // vertices are too uneven, so that rays bring it.
  double nearShare(double distance) const {
    return width_ * width_ / (distance * distance + width_ * width_);
  }
  // The part of that share that a ray leaves to joins with the eye, because it meets narrow gaps too rarely:
  // narrow as seen from the eye, at this distance from the place (world units).
  double closeShare(double distance, double fromEye) const;
  // The share of the light of a vertex that joins with an eye at this distance bring.
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
  double width() const { return width_; }  // at which nearShare() is a half, world units

  // With what probability a place follows paths from the eye for the light that is left to them: more often
  // where more of the light meets surfaces that are not known.
  double shareOfRest() const { return shareOfRest_; }
  double pathPower() const { return emission_.pathPower(); }  // brightness of each path, W
  double meanLength() const { return meanLength_; }  // from the sources to the next surfaces, world units

 private:
  class Path;
  void measure(size_t paths, uint64_t seed);
  void sort();
  double aimedDensity(LightId light, double distance, double cosine) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  SourceEmission emission_;
  double shareOfRest_ = 1;
  size_t met_ = 0, metUnknown_ = 0;  // surfaces, by light paths
  double meanLength_ = 1, width_ = 0;
  std::vector<LightVertex> all_;
  std::vector<Irradiance> powers_;
  std::vector<SurfaceId> hits_;
  std::vector<uint32_t> ends_;
  std::vector<Visible> visible_;
};

// What a place sends to the eye of light from one direction (unit), as a share of the light that arrives
// and relative to even reflection: about, for the choice of joins. view: direction (unit) of the ray that
// shows it.
double joinedReflectance(const Opaque& material, const V3d& normal, const V3d& view, const V3d& toSource);

}  // namespace rsphere
