// Shading of materials that bound volumes: mist, and antimatter, which cuts other surfaces away.
#include <fmt/format.h>

#include "transport/ray_functions.h"
#include "transport/surface_shading.h"

namespace rsphere {
namespace {

// An extinction minus that of a mist, but at least that of the medium outside of all mist.
double without(double extinction, double mist, double around) {
  const double rest = extinction - mist;
  return rest < around + 1e-12 * mist ? around : rest;
}

}  // namespace

// A ray that enters or leaves a volume of mist.
bool SurfaceShading::shadeMaterial(Ray& ray, const Mist& mist, ModifierId behind) {
  Rgb extinction = mist.extinction;
  if (!isBlack(extinction)) {
    applyModifiers(ray, behind);
    extinction *= ray.pattern;
  }
  const auto& sources = t_.scatterersOf(mist);
  const auto addTo = [&](Ray& r) {
    r.medium.extinction += extinction;
    if (mist.hasAlbedo) r.medium.albedo = mist.albedo;
    if (mist.hasEccentricity) r.medium.eccentricity = mist.eccentricity;
    for (const uint16_t s : sources)
      if (!r.scatterers.add(s))
        throw rad::Error(fmt::format("more than {} light sources are scattered in the mists around a point",
                                     ScatteringSources::kMost));
  };
  Ray child;
  inherit(child, ray, kTransmitted);
  if (ray.cosine > 0) {
    addTo(child);
    child.mist = &ray;
  } else {
    size_t removed = 0;
    for (const uint16_t s : sources) removed += child.scatterers.remove(s);
    // The ray began inside the mist.
    if (removed < sources.size()) addTo(ray);
    const Medium around = t_.medium();
    const Medium& before = ray.mist ? ray.mist->medium : around;
    for (int i = 0; i < 3; ++i)
      child.medium.extinction[i] = without(ray.medium.extinction[i], extinction[i], around.extinction[i]);
    if (mist.hasAlbedo) child.medium.albedo = before.albedo;
    if (mist.hasEccentricity) child.medium.eccentricity = before.eccentricity;
    child.mist = ray.mist ? ray.mist->mist : nullptr;
  }
  follower_.passOn(child, ray);
  return true;
}

bool SurfaceShading::shadeMaterial(Ray& ray, const Antimatter& antimatter, ModifierId) {
  if (ray.cosine > 0)
    ray.clipsBeyond = ray.clips | antimatter.clips;
  else
    ray.clipsBeyond = ray.clips & ~antimatter.clips;
  if (antimatter.cut.kind == Alternate::Kind::modifier) {
    // If the ray has entered more of the volumes that are cut away than it has left, it hits the cut here.
    int inside = 0;
    for (const Ray* r = &ray; r->parent; r = r->parent) {
      const Ray& before = *r->parent;
      if ((r->kind & kReflections) || before.surface == kNone ||
          !(t_.scene().surfaces[before.surface].clip & antimatter.clips))
        continue;
      inside += hitFront(before) ? 1 : -1;
    }
    if (inside > 0) {
      // The material lies on the other side of the antimatter's surface: a ray that leaves the antimatter
      // enters a dielectric, and the reverse.
      flip(ray);
      ray.insideOut = !ray.insideOut;
      return shade(ray, antimatter.cut.modifier);
    }
  }
  follower_.pass(ray);
  return true;
}

}  // namespace rsphere
