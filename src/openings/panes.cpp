#include "openings/panes.h"

#include "rays/prepared_scene.h"

namespace rsphere {

// Cap on the number of panes that a line crosses, far above that of any building. Rounding errors could
// otherwise keep a line at one pane forever.
constexpr int kMostPanes = 1000;

static_assert(kMaterialTypes == 19, "Does diffuse light pass?");
bool lightPasses(const PreparedScene& prepared, const Surface& surface) {
  const Material* material = prepared.scene().materialOf(surface);
  if (!material || enclosesVolume(*material) || isLightSource(*material)) return false;
  if (const auto* scatterer = std::get_if<FunctionScatterer>(material)) return scatterer->transmissivity > 0;
  if (const auto* bsdf = std::get_if<BsdfMaterial>(material)) {
    if (!isBlack(bsdf->diffuseTransmitted)) return true;
    try {
      const BsdfData& data = prepared.functions().bsdf(surface.material);
      return data.transmission(true) || !isBlack(data.diffuseTransmittance(true)) ||
             !isBlack(data.diffuseTransmittance(false));
    } catch (const rad::Error&) {
      return false;  // the file's fault is reported when a ray hits the surface
    }
  }
  return isTransparent(*material) || std::holds_alternative<Prism>(*material);
}

std::optional<LastPart> beyondPanes(const Scene& scene, const Tracer& tracer, V3d origin,
                                    const V3d& direction, FunctionRef<bool(const Surface&)> passes) {
  SurfaceId from;
  for (int pane = 0; pane < kMostPanes; ++pane) {
    const Hit hit = tracer.nearest(origin, direction, kFarAway, from);
    if (hit.surface == kNone) return LastPart{origin, hit};
    const Surface& surface = scene.surfaces[hit.surface];
    if (scene.materialOf(surface) && !passes(surface)) return LastPart{origin, hit};
    from = hit.surface;
    origin += hit.distance * direction;
  }
  return {};
}

}  // namespace rsphere
