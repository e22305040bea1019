#include "rays/volume_boundaries.h"

#include <fmt/format.h>

#include "rays/ray_functions.h"

namespace rsphere {
namespace {

// An extinction minus that of a mist, but at least that of the medium outside of all mist.
double without(double extinction, double mist, double around) {
  const double rest = extinction - mist;
  return rest < around + 1e-12 * mist ? around : rest;
}

}  // namespace

NextRay beyondMist(const PreparedScene& prepared, const CrossesMist& boundary, RayEnd& end) {
  const Mist& mist = boundary.mist;
  const auto& sources = prepared.lights().ofMists().of(mist);
  const auto addTo = [&](RaySpace& space) {
    space.medium.extinction += boundary.extinction;
    if (mist.hasAlbedo) space.medium.albedo = mist.albedo;
    if (mist.hasEccentricity) space.medium.eccentricity = mist.eccentricity;
    for (const uint16_t s : sources)
      if (!space.scatterers.add(s))
        throw rad::Error(fmt::format("more than {} light sources are scattered in the mists around a point",
                                     ScatteringSources::kMost));
  };
  NextRay next = straightOn(end);
  RaySpace& beyond = next.context.space;
  if (boundary.enters) {
    addTo(beyond);
    beyond.mist = &end;
    return next;
  }
  size_t removed = 0;
  for (const uint16_t s : sources) removed += beyond.scatterers.remove(s);
  // Not all sources were present, so the ray started inside the mist.
  if (removed < sources.size()) addTo(end.changedSpace());
  const Medium around = prepared.options().medium();
  const RayEnd* const entry = end.space().mist;
  const Medium& before = entry ? entry->medium() : around;
  beyond.medium.extinction =
      combined(end.medium().extinction, boundary.extinction, around.extinction, without);
  if (mist.hasAlbedo) beyond.medium.albedo = before.albedo;
  if (mist.hasEccentricity) beyond.medium.eccentricity = before.eccentricity;
  beyond.mist = entry ? entry->space().mist : nullptr;
  return next;
}

bool entersCut(const Scene& scene, const CrossesAntimatter& boundary, RayEnd& end) {
  const uint64_t clips = end.context.clips;
  end.clipsBeyond = boundary.enters ? clips | boundary.clips : clips & ~boundary.clips;
  if (boundary.cut.kind != Alternate::Kind::modifier) return false;
  int inside = 0;
  for (const RayEnd* e = &end; e->context.parent; e = e->context.parent) {
    const SurfaceHit& before = e->context.parent->hit;
    if ((e->context.kind & kReflections) || before.surface == kNone ||
        !(scene.surfaces[before.surface].clip & boundary.clips))
      continue;
    inside += hitFront(before) ? 1 : -1;
  }
  return inside > 0;
}

}  // namespace rsphere
