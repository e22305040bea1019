#pragma once
// Light vertices: the places where light paths from the sources hit diffuse surfaces. Connected to paths from
// the eye (bidirectional path tracing: vertex_light.h), they provide light that paths from the eye alone
// would find only by chance.
//
// Light paths are the paths of path_tracer.h in the opposite direction:
// - A source lights the first diffuse surface directly, through panes, or by a rough highlight. Sharp
//   reflections are excluded, because shadow rays do not follow them either; but those of importance are not,
//   since rays from the goals find the same light.
// - Later surfaces reflect the light diffusely, sharply or by a rough highlight, with at most -ab diffuse
//   reflections.
// - Daylight enters through portals (portals.h), and paths end where they leave through a portal. Except for
//   direct sunlight, daylight comes from the sky and from other surfaces, and sharp reflections transport it,
//   too.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <vector>

#include "base/function_ref.h"
#include "light_paths/light_vertex.h"
#include "light_paths/plain_surfaces.h"
#include "light_paths/sky_emission.h"
#include "light_paths/source_emission.h"
#include "occluders/hidden_boxes.h"

namespace rsphere {

// The light between two diffuse surfaces is divided by their distance (world units): rays estimate the light
// of near surfaces, light vertices the light of far ones.
struct NearLight {
  double width = 0;       // distance at which share() is 1/2
  double meanLength = 1;  // of light paths from the sources to the first surfaces
  // Distance at which joinedOfMirrored() is 1/2: that between vertices of mirrored light, at most `width`.
  double mirroredWidth = 0;

  // The fraction that rays estimate at this distance, because vertices would make it too noisy. It falls with
  // the fourth power of the distance: far away, few rays meet bright surfaces, and they would be noisier than
  // vertices.
  double share(double distance) const { return shareAt(distance, width); }
  // The same with another distance at which it is 1/2.
  static double shareAt(double distance, double half) {
    const double ratio = distance * distance / (half * half);
    return 1 / (1 + ratio * ratio);
  }
  // The distance at which share() has this value, which is above 0.
  double distanceOf(double share) const { return width * std::sqrt(std::sqrt((1 - share) / share)); }
  // The fraction of share() that is left to joins of the place with the eye, because rays rarely hit narrow
  // gaps. A gap is narrow if it is small compared with fromEye, the distance of the place from the eye. Joins
  // use the bounded kernel of light between diffuse surfaces.
  double closeShare(double distance, double fromEye) const;
  // The fraction of mirrored light (LightVertex::mirrored) at a place that joins of the place with the eye
  // estimate; rays from the place estimate the rest. Closer to a surface than the vertices of this light are
  // to each other, most answers would find none of them nearby, and lack its light: 2 cm below a light shelf,
  // the light that a window reflects onto the shelf, 7% of all, was missing in eleven of twelve answers.
  // Farther away, rays would be noisier: with the half at `width`, answers beside a wall of mirror have up to
  // four times the error (tests/bench/rtrace/runs/2026-11-29-rooms.txt).
  double joinedOfMirrored(double fromEye) const { return 1 - shareAt(fromEye, mirroredWidth); }
};

// A vertex that may be connected directly to the eye, which is the point whose answer is computed.
struct VisibleVertex {
  LightVertex vertex;
  Irradiance power;  // as LightVertices::powerOf(); for direct light, without the color of the material
  V3d direction;     // of the arriving light (unit)
  const Opaque* material;
  Color pattern;
  bool flat;
  double length;   // distance from the surface or source that sent the light, world units
  V3d normal;      // as vertex.normal(), in double precision
  LightId source;  // for direct light: where the light path began, and the cosine there
  double cosineAtSource;

  // The fraction of the vertex's light that joins with an eye at this distance estimate.
  double joinedShare(const NearLight& near, double fromEye) const {
    if (vertex.way == LightVertex::diffuse) return near.closeShare(length, fromEye) * near.share(length);
    if (vertex.way == LightVertex::mirrored) return near.joinedOfMirrored(fromEye);
    return vertex.way == LightVertex::highlight ? 1 - near.share(length) : 1;
  }
};

class VisibleVertices {
 public:
  void add(VisibleVertex vertex) { all_.push_back(std::move(vertex)); }
  // Removes all vertices, and reserves memory for `times` as many.
  void clearFor(double times);
  // Call this once, after the last vertex has been added.
  void sort(const PreparedScene& prepared);

  const std::vector<VisibleVertex>& all() const { return all_; }
  // Calls use(begin, end) for ascending index ranges of all(). They contain all vertices except some that are
  // hidden from the point.
  void from(const V3d& point, FunctionRef<void(size_t begin, size_t end)> use) const;
  // Memory for the result of LightVertices::shadowRaysTo() for a vertex of all(); 0: not computed yet.
  std::atomic<double>& shadowRaysTo(const VisibleVertex& v) const {
    return shadowRays_[static_cast<size_t>(&v - all_.data())];
  }

 private:
  static constexpr size_t kBlock = 256;

  std::vector<VisibleVertex> all_;
  std::optional<HiddenBoxes> hidden_;  // boxes around blocks of all_; empty if little is hidden
  mutable std::vector<std::atomic<double>> shadowRays_;
};

// Shared by all threads. Constant, except for values that are computed when they are first needed.
class LightVertices {
 public:
  // Sends paths from the sources, distributed as in `emission`. Keeps a reference to the surfaces. outdoors:
  // null without portals. REQUIRES that PlainSurfaces::obstacle() found none.
  LightVertices(const PreparedScene& prepared, const PlainSurfaces& surfaces, SourceEmission emission,
                size_t paths, uint64_t seed, const OutdoorParts* outdoors = nullptr);

  // The fraction of the paths that start on portals, with light of the sky; the others start on sources.
  static double shareOfSky(const PlainSurfaces& surfaces);

  // Vertices that send light to other diffuse surfaces. The vertices of a cluster are consecutive.
  const std::vector<LightVertex>& all() const { return all_; }
  // For each cluster (vertex_clusters.h), the index in all() after its last vertex.
  const std::vector<uint32_t>& clusterEnds() const { return ends_; }
  // The light that arrives at vertex i of all(), multiplied by the color of the material (W). The vertex
  // reflects the fraction diffuseShare() of it.
  const Irradiance& powerOf(size_t i) const { return arriving_[i].power; }
  const Opaque& materialOf(size_t i) const { return *arriving_[i].material; }

  const VisibleVertices& visible() const { return visible_; }
  // SourceEmission::shadowRaysOver() for shadow rays from a vertex of visible() to the place on the source
  // where the light path began. Computed when it is first needed: in a building, most vertices are in other
  // rooms. REQUIRES direct light.
  double shadowRaysTo(const VisibleVertex& vertex) const;
  const NearLight& nearLight() const { return near_; }
  const SourceEmission& emission() const { return starts_.onSources; }
  // Mean power of a path, W (brightness).
  double pathPower() const { return starts_.pathPower; }

  // The probability of following a path from the eye at a place, for the light that neither vertices nor rays
  // to near surfaces estimate. It increases with the fraction of light that hits unknown surfaces.
  double shareOfRest() const { return shareOfRest_; }

 private:
  class Path;
  struct Arriving {
    Irradiance power;
    const Opaque* material;
  };
  NearLight measured(const PreparedScene& prepared, size_t paths, uint64_t seed,
                     const OutdoorParts* outdoors);
  void sort();

  // Where light paths start.
  struct Starts {
    Starts(SourceEmission emission, const Portals& portals, double shareOfSky, size_t paths);

    SourceEmission onSources;
    double shareOfSky;  // LightVertices::shareOfSky()
    SkyEmission onPortals;
    double pathPower;  // mean, W (brightness)
  };

  const PlainSurfaces& surfaces_;
  Starts starts_;
  double shareOfRest_ = 1;
  NearLight near_;
  std::vector<LightVertex> all_;
  std::vector<Arriving> arriving_;  // index: as in all_
  std::vector<uint32_t> ends_;
  VisibleVertices visible_;
};

// Approximate reflectance of a place for light from one direction towards the eye, relative to a white
// diffuse surface; used to select joins. toSource: direction to the source (unit). view: direction of the ray
// from the eye (unit).
double joinedReflectance(const Opaque& material, const V3d& normal, const V3d& view, const V3d& toSource);

}  // namespace rsphere
