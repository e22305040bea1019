#include "transport/plain_surfaces.h"

#include <cmath>

#include "base/constants.h"
#include "shade/scattering.h"

namespace rsphere {
namespace {

// A line ends this share of its length before the place that it leads to, which lies on a surface.
constexpr double kEnd = 1e-6;

template <class T>
bool holds(const Material* material) {
  return material && std::holds_alternative<T>(*material);
}

// The material of a finish that nothing modifies, otherwise null.
const Material* unmodified(const Scene& scene, const Finish& finish) {
  if (finish.modifier != finish.material || finish.clip != 0) return nullptr;
  const Material* material = scene.materialAt(finish.material);
  return material && scene.modifiers[finish.modifier].next == kNone ? material : nullptr;
}

bool changeNothing(const RayOptions& o) {
  return o.backFacesVisible && o.directJitter >= 1 && o.specularSampling >= 1 && o.specularThreshold <= 0 &&
         o.directThreshold <= 0 && o.chosenSources == 0 && o.ambientDivisions > 0 && o.ambientAccuracy <= 0 &&
         o.ambientExcluded.empty() && o.ambientIncluded.empty() && isBlack(o.ambientValue) &&
         maxChannel(o.mediumExtinction) <= 0;
}

// Why the light of the scene's sources is not all known; null if it is.
const char* obstacleOfSources(const PreparedScene& prepared) {
  const auto& lights = prepared.lights().all();
  if (lights.empty()) return "no sources";
  if (!prepared.lights().distant().empty()) return "distant sources";
  for (const LightId i : lights.ids()) {
    const LightSource& light = lights[i];
    if (light.isVirtual() || light.isDistant()) return "mirrors or distant sources";
    if (light.reach > 0 || light.spot) return "sources with a reach or a cone";
    if (!light.hitsWhereAimed && !light.as<TubeLight>()) return "sources that samples may miss";
    const Radiance* const radiance = prepared.lights().constantRadiance(i);
    if (!radiance) return "sources with patterns";
    if (minChannel(radiance->color) < 0) return "sources that take light away";
  }
  return nullptr;
}

Coefficient passedBy(const Glass& pane, const Hit& hit, const V3d& direction) {
  Interaction at = plainInteraction(direction, hit.normal, true);
  at.kinds = kShadow;  // no reflection
  const Scattering s = scatter(pane, at);
  return s.sharp.count > 0 ? s.sharp.path[0].coefficient : Coefficient();
}

}  // namespace

Interaction plainInteraction(const V3d& direction, const V3d& normal, bool flat) {
  Interaction at;
  at.direction = direction;
  at.normal = normal.dot(direction) > 0 ? -normal : normal;
  at.cosine = -at.normal.dot(direction);
  at.flat = flat;
  return at;
}

PlainSurfaces::PlainSurfaces(const PreparedScene& prepared)
    : scene_(prepared.scene()), tracer_(prepared.tracer()) {
  for (const Finish& finish : scene_.surfaces.finishes()) {
    const Material* material = unmodified(scene_, finish);
    opaque_.push_back(material ? std::get_if<Opaque>(material) : nullptr);
    panes_.push_back(material ? std::get_if<Glass>(material) : nullptr);
    hasPanes_ = hasPanes_ || panes_.back();
    const Mirror* const mirror = material ? std::get_if<Mirror>(material) : nullptr;
    mirrors_.push_back(mirror && mirror->alternate.kind == Alternate::Kind::none ? mirror : nullptr);
  }
}

const char* PlainSurfaces::obstacle(const PreparedScene& prepared) const {
  if (!changeNothing(prepared.options())) return "options";
  if (const char* why = obstacleOfSources(prepared)) return why;
  for (const SurfaceId i : scene_.surfaces.ids()) {
    const Surface surface = scene_.surfaces[i];
    const bool lamp = holds<Light>(scene_.materialAt(surface.material));
    if (!lamp && !materialOf(i) && !paneOf(i) && !mirrorOf(i)) return "surfaces that are not plain";
    const bool shines = scene_.importance ? surface.goal : lamp;
    if (shines && prepared.lights().of(i) == kNone && !isBlack(sourceRadiance(scene_, surface)))
      return "sources that samples cannot be aimed at";
  }
  return nullptr;
}

Sight PlainSurfaces::look(const V3d& origin, const V3d& direction, double farthest, SurfaceId start) const {
  Sight sight;
  sight.hit = tracer_.nearest(origin, direction, farthest, start);
  sight.distance = sight.hit.distance;
  while (sight.hit.surface != kNone) {
    const Glass* const pane = paneOf(sight.hit.surface);
    if (!pane) break;
    sight.passed *= passedBy(*pane, sight.hit, direction);
    sight.hit = tracer_.nearest(origin + sight.distance * direction, direction, farthest - sight.distance,
                                sight.hit.surface);
    sight.distance += sight.hit.distance;
  }
  return sight;
}

Coefficient PlainSurfaces::passing(const V3d& from, const V3d& to, SurfaceId start) const {
  const V3d between = to - from;
  const double distance = between.length(), end = distance * (1 - kEnd) - 2 * kSamePlace;
  if (!(end > 0)) return {};
  const V3d direction = between / distance;
  if (tracer_.isClear(from, direction, end)) return Coefficient(1);
  if (!hasPanes_) return {};
  const Sight sight = look(from, direction, end, start);
  return sight.hit.surface == kNone ? sight.passed : Coefficient();
}

PlainPlace PlainSurfaces::placeOf(const V3d& origin, const V3d& direction, const Sight& sight) const {
  PlainPlace at;
  at.surface = sight.hit.surface;
  at.point = origin + sight.distance * direction;
  at.normal = sight.hit.normal.dot(direction) > 0 ? -sight.hit.normal : sight.hit.normal;
  if (at.surface == kNone || sight.hit.perturbation != V3d(0, 0, 0) || !(at.normal.dot(direction) < 0))
    return at;
  at.material = materialOf(at.surface);
  at.flat = isFlat(at.surface);
  return at;
}

bool PlainSurfaces::isFlat(SurfaceId surface) const {
  const ShapeRef shape = scene_.surfaces[surface].shape;
  return shape.as<Polygon>() || shape.as<Ring>() || shape.as<MeshFaces>();
}

Coefficient shownOfSource(const PlainPlace& at, const V3d& view, const V3d& toSource, double solidAngle) {
  const Interaction seen = plainInteraction(view, at.normal, at.flat);
  return directCoefficient(scatter(*at.material, seen, 0), seen, toSource, solidAngle, 1);
}

}  // namespace rsphere
