#pragma once
// The light vertices (light_paths/light_vertices.h) that points use, in pools: independent sets of light
// paths. In a building, only a few of the sources light a given room, and few of the paths from all sources
// reach it. Each room therefore has separate pools. Most of their paths start at the sources visible in the
// room; the others start at all remaining sources, whose light may arrive through other rooms.
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "light_paths/vertex_light.h"
#include "transport/path_tracer.h"

namespace rsphere {

// Shared by all threads.
class LightPools {
 public:
  // Makes tracers of ray mode, for the light beyond portals; none without portals.
  using Tracers = std::function<PathTracer()>;

  // pools: number of independent pools of vertices for each place. paths: number of light paths in each pool.
  // seed: determines all random numbers. Keeps references.
  LightPools(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t pools, size_t paths,
             uint64_t seed, Tracers tracers = {});

  // The vertices for a point (world), from the pool that belongs to the set of directions with this number.
  // They are computed at the first request and do not depend on other requests.
  std::shared_ptr<const VertexLight> at(const V3d& point, uint64_t set) const;
  // Vertices common to all places: their paths start at all sources, in proportion to power.
  std::shared_ptr<const VertexLight> ofAll() const { return pool({}, 0); }

 private:
  struct Pool {
    std::once_flag made;
    std::shared_ptr<const VertexLight> light;
    uint64_t asked = 0;  // number of the latest request
  };
  struct Made {
    using Key = std::pair<std::vector<uint32_t>, size_t>;  // preferred sources and number of the pool
    std::mutex mutex;                                      // guards pools and asked
    std::map<Key, std::shared_ptr<Pool>> pools;
    uint64_t asked = 0;
    size_t most = 0;  // cap on the pools in memory
  };

  std::shared_ptr<const VertexLight> pool(std::span<const uint32_t> preferred, size_t number) const;
  std::shared_ptr<const VertexLight> made(std::span<const uint32_t> preferred, size_t number) const;
  std::span<const uint32_t> preferredAt(const V3d& point) const;
  double powerOf(std::span<const uint32_t> sources) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  SourceEmission emission_;
  size_t pools_, paths_;
  uint64_t seed_;
  Tracers tracers_;
  mutable Made made_;
};

}  // namespace rsphere
