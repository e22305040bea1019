#include "glances/light_pools.h"

#include <algorithm>

#include "base/random.h"
#include "glances/tuning.h"

namespace rsphere {
LightPools::LightPools(const PreparedScene& prepared, const PlainSurfaces& surfaces, size_t pools,
                       size_t paths, uint64_t seed, Tracers tracers)
    : prepared_(prepared),
      surfaces_(surfaces),
      emission_(prepared, surfaces,
                static_cast<size_t>(static_cast<double>(paths) * (1 - LightVertices::shareOfSky(surfaces)))),
      pools_(pools),
      paths_(paths),
      seed_(seed),
      tracers_(std::move(tracers)) {
  made_.most = std::max(pools + 1, tuning::DiffuseGlances::kMost / paths);
}

double LightPools::powerOf(std::span<const uint32_t> sources) const {
  double sum = 0;
  for (const uint32_t i : sources) sum += emission_.power(LightId(i));
  return sum;
}

// The sources from which most paths for a point should start; empty if the vertices common to all places
// suffice.
std::span<const uint32_t> LightPools::preferredAt(const V3d& point) const {
  const HiddenBoxes& hidden = prepared_.lights().hidden();
  const std::span<const uint32_t> seen = hidden.notHiddenFrom(point);
  if (seen.size() == hidden.all().size()) return {};
  const double own = powerOf(seen);
  if (!(own > 0) || own >= tuning::LightPools::kFewPower * powerOf(hidden.all())) return {};
  return hidden.widestWhere(point, [&](std::span<const uint32_t> some) {
    return tuning::LightPools::kShared * powerOf(some) <= own;
  });
}

std::shared_ptr<const VertexLight> LightPools::at(const V3d& point, uint64_t set) const {
  return pool(preferredAt(point), set % pools_);
}

std::shared_ptr<const VertexLight> LightPools::pool(std::span<const uint32_t> preferred,
                                                    size_t number) const {
  std::shared_ptr<Pool> found;
  {
    const std::lock_guard lock(made_.mutex);
    std::shared_ptr<Pool>& known = made_.pools[{{preferred.begin(), preferred.end()}, number}];
    if (!known) known = std::make_shared<Pool>();
    found = known;
    found->asked = ++made_.asked;
    // The pool that has not been requested for the longest time is removed. Points that still use it keep it
    // until they are finished.
    if (made_.pools.size() > made_.most)
      made_.pools.erase(
          std::ranges::min_element(made_.pools, {}, [](const auto& p) { return p.second->asked; }));
  }
  std::call_once(found->made, [&] { found->light = made(preferred, number); });
  return found->light;
}

std::shared_ptr<const VertexLight> LightPools::made(std::span<const uint32_t> preferred,
                                                    size_t number) const {
  const SourceEmission emission = preferred.empty() ? emission_ : emission_.preferring(preferred);
  const uint64_t seed = mixBits(seed_ + number);
  if (!tracers_) return std::make_shared<const VertexLight>(prepared_, surfaces_, emission, paths_, seed);
  PathTracer tracer = tracers_();
  const auto parts = [&](const V3d& origin, const V3d& direction, int bounces, Random& random,
                         std::vector<Radiance>& found) {
    tracer.outdoors(origin, direction, bounces, random.bits(), found);
  };
  const OutdoorParts outdoors(parts);
  return std::make_shared<const VertexLight>(prepared_, surfaces_, emission, paths_, seed, &outdoors);
}

}  // namespace rsphere
