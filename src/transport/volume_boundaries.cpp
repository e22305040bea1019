#include "transport/volume_boundaries.h"

#include <fmt/format.h>

#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// An extinction minus that of a mist, but at least that of the medium outside of all mist.
double without(double extinction, double mist, double around) {
  const double rest = extinction - mist;
  return rest < around + 1e-12 * mist ? around : rest;
}

}  // namespace

Ray beyondMist(const PreparedScene& prepared, const CrossesMist& boundary, Ray& ray) {
  const Mist& mist = boundary.mist;
  const auto& sources = prepared.scatterersOf(mist);
  const auto addTo = [&](Ray& r) {
    r.medium.extinction += boundary.extinction;
    if (mist.hasAlbedo) r.medium.albedo = mist.albedo;
    if (mist.hasEccentricity) r.medium.eccentricity = mist.eccentricity;
    for (const uint16_t s : sources)
      if (!r.scatterers.add(s))
        throw rad::Error(fmt::format("more than {} light sources are scattered in the mists around a point",
                                     ScatteringSources::kMost));
  };
  Ray child;
  inherit(child, ray, kTransmitted);
  if (boundary.enters) {
    addTo(child);
    child.mist = &ray;
    return child;
  }
  size_t removed = 0;
  for (const uint16_t s : sources) removed += child.scatterers.remove(s);
  // The ray began inside the mist.
  if (removed < sources.size()) addTo(ray);
  const Medium around = prepared.medium();
  const Medium& before = ray.mist ? ray.mist->medium : around;
  child.medium.extinction = combined(ray.medium.extinction, boundary.extinction, around.extinction, without);
  if (mist.hasAlbedo) child.medium.albedo = before.albedo;
  if (mist.hasEccentricity) child.medium.eccentricity = before.eccentricity;
  child.mist = ray.mist ? ray.mist->mist : nullptr;
  return child;
}

bool entersCut(const Scene& scene, const CrossesAntimatter& boundary, Ray& ray) {
  ray.clipsBeyond = boundary.enters ? ray.clips | boundary.clips : ray.clips & ~boundary.clips;
  if (boundary.cut.kind != Alternate::Kind::modifier) return false;
  int inside = 0;
  for (const Ray* r = &ray; r->parent; r = r->parent) {
    const Ray& before = *r->parent;
    if ((r->kind & kReflections) || before.surface == kNone ||
        !(scene.surfaces[before.surface].clip & boundary.clips))
      continue;
    inside += hitFront(before) ? 1 : -1;
  }
  return inside > 0;
}

}  // namespace rsphere
