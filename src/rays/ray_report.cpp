#include "rays/ray_report.h"

#include "rays/ray_functions.h"
#include "shade/scattering.h"

namespace rsphere {

RayAnswer answerOf(const Scene& scene, const TracedRay& ray) {
  RayAnswer a;
  a.origin = ray.origin;
  a.direction = ray.direction;
  a.value = ray.value;
  a.contribution = ray.contribution;
  a.mirroredContribution = ray.mirrored;
  a.unmirroredContribution = ray.value - ray.mirrored;
  a.mirroredLength = ray.mirroredLength;
  a.unmirroredLength = ray.unmirroredLength;
  a.effectiveLength = apparentLength(ray);
  a.firstLength = ray.length;
  a.u = ray.u;
  a.v = ray.v;
  a.point = ray.point;
  if (ray.surface == kNone) return a;
  const Surface& surface = scene.surfaces[ray.surface];
  a.unperturbedNormal = ray.fromBehind != ray.insideOut ? -ray.normal : ray.normal;
  a.normal = ray.normal;
  if (ray.perturbation.length2() > 0) {
    // If the surface has no material, its normal has not been turned towards the ray.
    const double side = ray.cosine < 0 ? -1 : 1;
    Interaction at;
    at.direction = ray.direction;
    at.normal = side * ray.normal;
    at.cosine = side * ray.cosine;
    at.perturbation = side * ray.perturbation;
    double cosine = 0;
    a.normal = side * perturbedNormal(at, cosine);
  }
  a.surface = {scene, surface.id};
  a.modifier = scene.modifierName(surface);
  a.material = scene.materialName(surface);
  return a;
}

RayAnswer branchAnswer(const PreparedScene& prepared, const RayEnd& end, const RayResult& result) {
  RayAnswer a = answerOf(prepared.scene(), TracedRay(end, result));
  a.rayWeight = end.context.weight;
  const Color& color = result.value.color;
  const bool dark = color.x + color.y + color.z <= 3 * kNegligible;
  const LightId aimedAt = end.ray.aimedAt;
  if (aimedAt != kNone && dark && prepared.lights().all()[aimedAt].surface != end.hit.surface)
    a.contribution = {};
  return a;
}

bool needsValue(std::string_view letters) {
  return letters.find_first_of("veVrxlRXnW") != std::string_view::npos;
}

}  // namespace rsphere
