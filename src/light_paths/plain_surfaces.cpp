#include "light_paths/plain_surfaces.h"

#include <algorithm>

#include "light/surface_point.h"
#include "openings/tuning.h"
#include "shade/scattering.h"
#include "spots/light_particles.h"

namespace rsphere {
namespace {

// A line to a place on a surface ends before that place by this fraction of its length.
constexpr double kEnd = 1e-6;

template <class T>
bool holds(const Material* material) {
  return material && std::holds_alternative<T>(*material);
}

// The material of a finish if it is the surface's own modifier and no antimatter clips it; otherwise null.
const Material* materialOfFinish(const Scene& scene, const Finish& finish) {
  if (finish.modifier != finish.material || finish.clip != 0) return nullptr;
  return scene.materialAt(finish.material);
}

bool hasMist(const Scene& scene) {
  for (const auto& modifier : scene.modifiers)
    if (holds<Mist>(std::get_if<Material>(&modifier.content))) return true;
  return false;
}

bool changeNothing(const RayOptions& o) {
  return o.backFacesVisible && o.directJitter >= 1 && o.specularSampling >= 1 && o.specularThreshold <= 0 &&
         o.directThreshold <= 0 && o.chosenSources == 0 && o.ambientDivisions > 0 &&
         o.ambientExcluded.empty() && o.ambientIncluded.empty() && isBlack(o.ambientValue) &&
         maxChannel(o.mediumExtinction) <= 0;
}

Coefficient passedBy(const Glass& pane, const Hit& hit, const V3d& direction) {
  Interaction at = plainInteraction(direction, hit.normal, true);
  at.kinds = kShadow;  // no reflection
  const Scattering s = scatter(pane, at);
  return s.sharp.count > 0 ? s.sharp.path[0].coefficient : Coefficient();
}

}  // namespace

Interaction plainInteraction(const V3d& direction, const V3d& normal, bool flat, const Color& pattern) {
  Interaction at;
  at.pattern = pattern;
  at.direction = direction;
  at.normal = normal.dot(direction) > 0 ? -normal : normal;
  at.cosine = -at.normal.dot(direction);
  at.flat = flat;
  return at;
}

static_assert(kMaterialTypes == 19, "Is its answer known without following a ray?");
PlainSurfaces::PlainSurfaces(const PreparedScene& prepared, Portals portals)
    : prepared_(prepared),
      scene_(prepared.scene()),
      tracer_(prepared.tracer()),
      portals_(std::move(portals)) {
  for (const Finish& finish : scene_.surfaces.finishes()) {
    const Material* const material = materialOfFinish(scene_, finish);
    const ModifierId patterns = material ? scene_.modifiers[finish.material].next : ModifierId();
    const bool plain = material && patterns == kNone;
    const auto isEven = [&](ModifierId i) { return prepared.functions().dependsOnPlaceAlone(i); };
    PlainFinish f{.patterns = patterns};
    if (material && arePatterns(scene_, patterns, isEven)) f.opaque = std::get_if<Opaque>(material);
    if (plain) f.pane = std::get_if<Glass>(material);
    const Mirror* const mirror = plain ? std::get_if<Mirror>(material) : nullptr;
    if (mirror && mirror->alternate.kind == Alternate::Kind::none) f.mirror = mirror;
    hasPanes_ = hasPanes_ || f.pane;
    coverage_.mirrors = coverage_.mirrors || f.pane || f.mirror || (f.opaque && isPolished(*f.opaque));
    finishes_.push_back(f);
  }
  placePortals();
  findSources();
  findSurfaces();
}

// Panes that are not known, such as frosted ones, are left outdoors.
void PlainSurfaces::placePortals() {
  Random random(0);
  for (size_t i = 0; i < portals_.all().size(); ++i)
    for (int k = 0; k < tuning::Caps::kProbes; ++k) {
      const Opening& portal = portals_.all()[i];
      const double u = random.uniform(), v = random.uniform();
      const Hit hit = tracer_.nearest(portal.at(u, v), portal.normal, 2 * portals_.lift(), kNone);
      if (hit.surface == kNone || knows(hit.surface)) continue;
      portals_.moveIndoors(i);
      break;
    }
}

void PlainSurfaces::findSources() {
  const auto& lights = prepared_.lights().all();
  knownSources_.resize(lights.size());
  for (const LightId i : lights.ids()) {
    knownSources_[i] = isKnown(i);  // images come after their sources, which isKnown() looks up
    coverage_.anySource = coverage_.anySource || knownSources_[i];
    coverage_.allSources = coverage_.allSources && knownSources_[i];
  }
}

// Whether a distant source shines on the mirror of its image, but not through a portal: at one of some
// points. Light paths do not carry this light.
bool PlainSurfaces::isLitOutdoors(const LightSource& image) const {
  const V3d& towards = prepared_.lights().all()[image.relayed].center;
  Random random(image.surface.index());
  for (int i = 0; i < tuning::Caps::kProbes; ++i) {
    const V3d at = samplePoint(scene_.surfaces[image.surface].shape, scene_.vertices, random).point;
    if (!portals_.lineLeaves(at, towards, kFarAway) &&
        !isBlack(passingToSource(at, towards, kFarAway, image.surface)))
      return true;
  }
  return false;
}

static_assert(kLightForms == 8, "Are samples spread over all of it?");
bool PlainSurfaces::isKnown(LightId source) const {
  const LightSource& light = prepared_.lights().all()[source];
  if (light.isDistant() == portals_.empty()) return false;
  if (light.isVirtual())
    return finishOf(light.surface).mirror && knownSources_[light.relayed] &&
           !(light.isDistant() && isLitOutdoors(light));
  if (light.isDistant()) return prepared_.lights().constantRadiance(source);
  if (light.reach > 0) return false;
  const auto* const plane = light.as<PlaneLight>();
  // Not known: concave lamps and bent polygons, which samples may miss. A ring that is a source has no hole.
  const bool isRing = plane && std::holds_alternative<PlaneLight::Disk>(plane->map);
  if (!light.hitsWhereAimed && !isRing && !light.as<TubeLight>()) return false;
  if (light.spot && !plane) return false;
  const Surface surface = scene_.surfaces[light.surface];
  if (minChannel(sourceRadiance(scene_, surface).color) < 0) return false;
  const auto isLocal = [&](ModifierId i) { return !prepared_.functions().dependsOnDistance(i); };
  return prepared_.lights().constantRadiance(source) ||
         (surface.modifier == surface.material &&
          arePatterns(scene_, scene_.modifiers[surface.material].next, isLocal));
}

bool bringLightOf(LightId source, const PreparedScene& prepared, const PlainSurfaces& surfaces, V3d point,
                  V3d direction) {
  const Portals& portals = surfaces.portals();
  if (!surfaces.knows(source)) return false;
  if (portals.empty()) return true;
  const auto& lights = prepared.lights().all();
  for (; lights[source].isVirtual(); source = lights[source].relayed) {
    const ShapeRef mirror = prepared.scene().surfaces[lights[source].surface].shape;
    const V3d& normal = *planeNormal(mirror);
    const double cosine = normal.dot(direction),
                 distance = (planeOffset(mirror) - normal.dot(point)) / cosine;
    if (portals.lineLeaves(point, direction, distance)) return false;
    point += distance * direction;
    direction -= 2 * cosine * normal;
  }
  return portals.lineLeaves(point, direction, kFarAway);
}

void PlainSurfaces::findSurfaces() {
  double unknownArea = 0;
  for (const SurfaceId i : scene_.surfaces.ids()) {
    const Surface surface = scene_.surfaces[i];
    if (surface.finish.sensor) continue;
    const Material* const material = scene_.materialAt(surface.material);
    const bool lamp = holds<Light>(material) || holds<Spotlight>(material);
    const bool known = lamp || knows(i);
    const bool mayShine = scene_.importance ? surface.goal : lamp;
    const bool isSource = prepared_.lights().of(i) != kNone;
    const bool isDark = isBlack(sourceRadiance(scene_, surface));
    coverage_.all = coverage_.all && known && (!mayShine || isSource || isDark);
    // A glow with a positive reach is a source only up to that distance; with a negative one it lights
    // nothing.
    const auto* const glow = std::get_if<Glow>(material);
    const double reach = glow ? glow->reach : 0;
    coverage_.glows = coverage_.glows || (!isDark && (reach > 0 || (reach == 0 && !isSource)));
    if (!known && i.index() < scene_.outermostIds().size())
      unknownArea += areaOf(surface.shape, scene_.vertices);
    if (!known && !(tracer_.stopsShadows(i, true) && tracer_.stopsShadows(i, false)))
      coverage_.passUnknown = true;
  }
  coverage_.mostlyUnknown = unknownArea > 0 && unknownArea > scene_.area() / 2;
  if (!portals_.empty()) coverage_.all = false;  // some light may enter elsewhere
  if (!portals_.empty() && coverage_.anySource) coverage_.passUnknown = true;
  coverage_.allDirect = coverage_.allSources && !coverage_.passUnknown;
  coverage_.all = coverage_.all && coverage_.allDirect;
}

const char* PlainSurfaces::obstacle() const {
  if (!changeNothing(prepared_.options())) return "options";
  if (!portals_.empty()) {
    if (hasMist(scene_)) return "mist";
    return coverage_.allSources && !scene_.importance ? nullptr : "sources that are not known";
  }
  if (!prepared_.lights().distant().empty()) return "distant sources";
  if (!coverage_.anySource) return "no known sources";
  // With glances, the light that only rays find is noisier. Measured: in three rooms with a lamp and a glow,
  // 2 to 2.7 times the error in 6 to 10 times the time. Where most surfaces are not known, glances find too
  // little light to be worth their time. Measured: in a room with textured walls, an equal error in 2 to 3
  // times the time.
  if (!scene_.importance && coverage_.glows) return "surfaces that only rays find";
  if (!scene_.importance && coverage_.mostlyUnknown) return "surfaces that are not known";
  return hasMist(scene_) ? "mist" : nullptr;
}

Radiance PlainSurfaces::radianceOf(LightId source, const V3d& point, const V3d& normal, const V3d& direction,
                                   FunctionScratch& scratch) const {
  if (const Radiance* const constant = prepared_.lights().constantRadiance(source)) return *constant;
  const Surface surface = scene_.surfaces[prepared_.lights().all()[source].surface];
  const ModifierId patterns = scene_.modifiers[surface.material].next;
  return Radiance(sourceRadiance(scene_, surface).color *
                  patternOfSource(prepared_.functions(), patterns, point, normal, direction, scratch));
}

double chanceOf(LightId source, const PlainSurfaces& surfaces, const V3d& point, const V3d& normal,
                std::vector<double>& weights) {
  std::span<const uint32_t> sources;
  const double sum = surfaces.weigh(point, normal, sources, weights);
  const auto own = std::ranges::lower_bound(sources, source.index());
  if (!(sum > 0) || own == sources.end() || *own != source.index()) return 0;
  return weights[static_cast<size_t>(own - sources.begin())] / sum;
}

double PlainSurfaces::weigh(const V3d& point, const V3d& normal, std::span<const uint32_t>& sources,
                            std::vector<double>& weights) const {
  sources = prepared_.lights().hidden().notHiddenFrom(point, normal);
  const double all = prepared_.lights().choice().weigh(point, normal, sources, weights);
  if (coverage_.allSources) return all;
  double sum = 0;
  for (size_t i = 0; i < sources.size(); ++i) {
    if (!knownSources_[LightId(sources[i])]) weights[i] = 0;
    sum += weights[i];
  }
  return sum;
}

Sight PlainSurfaces::straight(const V3d& origin, const V3d& direction, double farthest,
                              SurfaceId start) const {
  Sight sight;
  sight.hit = tracer_.nearest(origin, direction, farthest, start);
  sight.distance = sight.hit.distance;
  while (sight.hit.surface != kNone) {
    const Glass* const pane = finishOf(sight.hit.surface).pane;
    if (!pane || sight.hit.perturbation != V3d(0, 0, 0)) break;
    sight.passed *= passedBy(*pane, sight.hit, direction);
    sight.hit = tracer_.nearest(origin + sight.distance * direction, direction, farthest - sight.distance,
                                sight.hit.surface);
    sight.distance += sight.hit.distance;
  }
  return sight;
}

Sight PlainSurfaces::look(const V3d& origin, const V3d& direction, double farthest, SurfaceId start) const {
  const double leaving = portals_.leaving(origin, direction, farthest);
  Sight sight = straight(origin, direction, std::min(leaving, farthest), start);
  if (sight.hit.surface == kNone && leaving < farthest) {
    sight.leaves = true;
    sight.distance = leaving;
  }
  return sight;
}

Coefficient PlainSurfaces::passing(const V3d& to, const V3d& from, SurfaceId start) const {
  const V3d between = from - to;
  const double distance = between.length();
  if (!(distance > 0)) return {};
  const V3d direction = between / distance;
  if (portals_.lineLeaves(to, direction, distance)) return {};
  return passingToSource(to, direction, distance, start);
}

Coefficient PlainSurfaces::passingToSource(const V3d& to, const V3d& direction, double distance,
                                           SurfaceId start) const {
  const double end = distance * (1 - kEnd) - 2 * scene_.samePlace;
  if (!(end > 0)) return {};
  if (tracer_.isClear(to, direction, end, start)) return Coefficient(1);
  if (!hasPanes_) return {};
  const Sight sight = straight(to, direction, end, start);
  return sight.hit.surface == kNone ? sight.passed : Coefficient();
}

PlainPlace PlainSurfaces::placeOf(const V3d& origin, const V3d& direction, const Sight& sight,
                                  FunctionScratch& scratch) const {
  PlainPlace at;
  at.surface = sight.hit.surface;
  at.point = origin + sight.distance * direction;
  at.normal = sight.hit.normal.dot(direction) > 0 ? -sight.hit.normal : sight.hit.normal;
  if (at.surface == kNone || sight.hit.perturbation != V3d(0, 0, 0) || !(at.normal.dot(direction) < 0))
    return at;
  const PlainFinish& finish = finishOf(at.surface);
  at.material = finish.opaque;
  at.flat = isFlat(scene_.surfaces[at.surface].shape);
  if (at.material && finish.patterns != kNone) at.pattern = patternAt(at, direction, sight.hit, scratch);
  return at;
}

Color PlainSurfaces::patternAt(const PlainPlace& at, const V3d& direction, const Hit& hit,
                               FunctionScratch& scratch) const {
  const FunctionPoint here{.direction = direction,
                           .normal = hit.normal,
                           .cosine = hit.cosine,
                           .point = at.point,
                           .u = hit.u,
                           .v = hit.v,
                           .path = hit.path};
  Color pattern = prepared_.functions().patterns(finishOf(at.surface).patterns, here, scratch);
  // A negative reflectance is treated as black.
  pattern.transform([](double share) { return std::max(0., share); });
  return pattern;
}

Coefficient shownOfSource(const PlainPlace& at, const V3d& view, const V3d& toSource, double solidAngle,
                          Shown shown) {
  const Interaction seen = plainInteraction(view, at.normal, at.flat, at.pattern);
  Scattering s = scatter(*at.material, seen, 0);
  if (shown == Shown::highlight) s.diffuseReflection = Color(0, 0, 0);
  return directCoefficient(s, seen, toSource, solidAngle, 1);
}

}  // namespace rsphere
