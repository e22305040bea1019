#pragma once
// The light vertices (transport/light_vertices.h) that points use. In a building, few of its sources light
// a room, and paths from all of them would hardly meet it: rooms have vertices of their own, most of whose
// paths come from the sources that can be seen there. Sources elsewhere keep the rest, because their light
// may arrive by other rooms.
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "transport/vertex_light.h"

namespace rsphere {

// Shared by all threads.
class LightPools {
 public:
  // pools: independent sets of vertices for each place. paths: of each. seed: of all. Keeps references.
  LightPools(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t pools, size_t paths,
             uint64_t seed);

  // The vertices for a point (world), of the pool that a set of directions with this number uses. Made when
  // first asked for; the same for the same arguments, whatever was asked before.
  std::shared_ptr<const VertexLight> at(const V3d& point, uint64_t set) const;
  // Those of no place, whose paths come from all sources by their power.
  std::shared_ptr<const VertexLight> ofAll() const { return pool({}, 0); }

 private:
  struct Pool {
    std::once_flag made;
    std::shared_ptr<const VertexLight> light;
    uint64_t asked = 0;  // when last
  };
  using Key = std::pair<std::vector<uint32_t>, size_t>;  // preferred sources and number of the pool

  std::shared_ptr<const VertexLight> pool(std::span<const uint32_t> preferred, size_t number) const;
  std::span<const uint32_t> preferredAt(const V3d& point) const;
  double powerOf(std::span<const uint32_t> sources) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  SourceEmission emission_;
  size_t pools_, paths_, most_;  // most_: pools that are kept
  uint64_t seed_;
  mutable std::mutex mutex_;  // of the two below
  mutable std::map<Key, std::shared_ptr<Pool>> made_;
  mutable uint64_t asked_ = 0;
};

}  // namespace rsphere
