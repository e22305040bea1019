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

// How rays and light vertices divide the light between diffuse surfaces by distance (world units).
struct NearLight {
  double width = 0;       // distance at which share() is 1/2
  double meanLength = 1;  // of light paths from sources to first surfaces

  // The fraction of the light between two diffuse surfaces at this distance that rays bring, because the
  // noise of vertices would be too large.
  double share(double distance) const { return width * width / (distance * distance + width * width); }
  // The part of share() that rays leave to joins with the eye, because they meet narrow gaps too rarely. Gaps
  // are narrow relative to fromEye, the distance of the place from the eye.
  double closeShare(double distance, double fromEye) const;
};

// A vertex that may be joined directly to the eye, the point where the answer is wanted.
struct VisibleVertex {
  LightVertex vertex;
  Irradiance power;  // as LightVertices::powerOf(); of direct light, without the color of the material
  V3d direction;     // in which the light arrives (unit)
  const Opaque* material;
  Color pattern;
  bool flat;
  double length;  // distance from the surface or the source that sent the light, world units
  // For direct light, SourceEmission::shadowRaysOver() of shadow rays from the vertex to the place on the
  // source where its path began; otherwise 0.
  double shadowRays;

  // The fraction of its light that joins bring to an eye at this distance.
  double joinedShare(const NearLight& near, double fromEye) const {
    if (vertex.way == LightVertex::diffuse) return near.closeShare(length, fromEye) * near.share(length);
    return vertex.way == LightVertex::highlight ? 1 - near.share(length) : 1;
  }
};

class VisibleVertices {
 public:
  void add(VisibleVertex vertex) { all_.push_back(std::move(vertex)); }
  void clear() { all_.clear(); }
  // Call this once, after the last vertex has been added.
  void sort(const PreparedScene& prepared);

  const std::vector<VisibleVertex>& all() const { return all_; }
  // Calls use(begin, end) for ranges of all(), ascending, that contain all vertices but some that are hidden
  // from the point.
  void from(const V3d& point, FunctionRef<void(size_t begin, size_t end)> use) const;

 private:
  static constexpr size_t kBlock = 256;

  std::vector<VisibleVertex> all_;
  std::optional<HiddenBoxes> hidden_;  // boxes around blocks of all_; none where little is hidden
};

// Shared by all threads; constant.
class LightVertices {
 public:
  // Sends paths from the sources as `emission` divides them. Keeps a reference to the surfaces.
  // REQUIRES that PlainSurfaces::obstacle() found none.
  LightVertices(const PreparedScene& prepared, const PlainSurfaces& surfaces, SourceEmission emission,
                size_t paths, uint64_t seed);

  // Vertices whose light goes on to other diffuse surfaces. Those of a cluster follow each other.
  const std::vector<LightVertex>& all() const { return all_; }
  // The position after the last vertex of each cluster (vertex_clusters.h) in all().
  const std::vector<uint32_t>& clusterEnds() const { return ends_; }
  // The light that arrives at vertex i of all(), times the color of the material (W). The fraction
  // diffuseShare() of it is reflected.
  const Irradiance& powerOf(size_t i) const { return arriving_[i].power; }
  const Opaque& materialOf(size_t i) const { return *arriving_[i].material; }

  const VisibleVertices& visible() const { return visible_; }
  const NearLight& nearLight() const { return near_; }
  const SourceEmission& emission() const { return emission_; }

  // The probability of following paths from the eye at a place, for the light that is left to them. It is
  // higher where more of the light meets unknown surfaces.
  double shareOfRest() const { return shareOfRest_; }

 private:
  class Path;
  struct Arriving {
    Irradiance power;
    const Opaque* material;
  };
  NearLight measured(const PreparedScene& prepared, size_t paths, uint64_t seed);
  void sort();

  const PlainSurfaces& surfaces_;
  SourceEmission emission_;
  double shareOfRest_ = 1;
  NearLight near_;
  std::vector<LightVertex> all_;
  std::vector<Arriving> arriving_;  // at each of all_
  std::vector<uint32_t> ends_;
  VisibleVertices visible_;
};

// Approximate reflectance of a place for light that arrives from one direction (unit) and goes to the eye, as
// a multiple of a white diffuse surface's; used to choose joins. view: direction (unit) of the ray that sees
// the place.
double joinedReflectance(const Opaque& material, const V3d& normal, const V3d& view, const V3d& toSource);

}  // namespace rsphere
