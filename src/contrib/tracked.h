#pragma once
// Contributions of tracked modifiers to rays, summed by bins: the light that surfaces with these modifiers
// send along each path, or the coefficient of the path.
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contrib/bin_function.h"
#include "contrib/contribution_list.h"
#include "rays/prepared_scene.h"
#include "sphere/equal_zones.h"
#include "transport/path_tracer.h"

namespace rsphere {

struct TrackedModifier {
  std::string name;
  uint32_t bins = 1;
  std::optional<BinFunction> bin;  // empty: all contributions are in bin 0
  // Used instead of a function: the bins are the zones of the directions in which rays hit the modifier.
  std::shared_ptr<const EqualZones> zones{};
};

// The quantity that is summed over all rays that hit a tracked modifier.
enum class Contributed : uint8_t {
  coefficients,  // factor with which its radiance enters the primary ray's
  values         // this factor times its radiance
};

// Immutable after construction, and shared by all threads.
class Tracked {
 public:
  // Keeps a reference to the scene. warn: receives one line if surfaces lack some of the modifiers, and one
  // for each modifier with an invalid bin number, from any thread.
  Tracked(const PreparedScene& prepared, std::vector<TrackedModifier> modifiers, Contributed what,
          rad::Warn warn = {});

  const std::vector<TrackedModifier>& modifiers() const { return modifiers_; }
  // A record has a column for each bin of each modifier: all bins of the first modifier, then of the next.
  uint32_t columns() const { return firstColumn_.back(); }
  uint32_t firstColumn(size_t modifier) const { return firstColumn_[modifier]; }
  // The number of values in a column: 3, or one for each band of a spectral run.
  int components() const;
  // By LightId, the light sources whose shadow rays may contribute; null: all.
  const std::vector<bool>* sampledLights() const {
    return sampledLights_.empty() ? nullptr : &sampledLights_;
  }

  // Adds the contribution of a ray of a path. There is none if its surface is not tracked, if it is a shadow
  // ray that did not reach its source, or if it hit a light source that is sampled by shadow rays. Called for
  // each ray that an observer receives with ShownShadows::thatArrive.
  void add(const RayEnd& end, const RayResult& result, BinScratch& scratch, ContributionList& to) const;

 private:
  std::optional<uint32_t> columnOf(size_t modifier, const RayEnd& end, BinScratch& scratch) const;
  bool counts(const RayEnd& end, const RayResult& result) const;
  uint32_t modifierOf(SurfaceId surface) const;
  void chooseLights();

  const PreparedScene& prepared_;
  std::vector<TrackedModifier> modifiers_;
  const Contributed what_;
  rad::Warn warn_;
  std::vector<uint32_t> firstColumn_{0};  // of each modifier, and behind the last
  static constexpr uint32_t kNotTracked = ~uint32_t{0};
  std::vector<uint32_t> modifierOf_;  // by index of a finish; kNotTracked: none
  std::vector<bool> sampledLights_;
  mutable std::vector<std::atomic<bool>> warned_;
};

// Traces rays and sums the contributions to them. Each thread needs its own.
class ContributionTracer {
 public:
  // Keeps references. REQUIRES: nothing is interpolated (-aa 0), all shadows are tested (-dt 0, -Ss 0), and
  // the tracer is one for ray mode. If the ambient value is 0, the values of all emitters then sum to the
  // radiance along the ray.
  ContributionTracer(PathTracer tracer, const Tracked& tracked)
      : tracer_(std::move(tracer)), tracked_(tracked), list_(tracked.components()) {}

  // The contributions to a primary ray, valid until the next call. Parameters: see PathTracer::trace(); rays:
  // PathRequest::rays.
  const ContributionList& trace(const V3d& origin, const V3d& direction, double farthest, uint64_t seed,
                                int rays = 0);

  int components() const { return tracked_.components(); }

  // That ray.
  const TracedRay& ray() const { return ray_; }

 private:
  PathTracer tracer_;
  const Tracked& tracked_;
  BinScratch scratch_;
  ContributionList list_;
  TracedRay ray_;
};

}  // namespace rsphere
