#include "pictures/pixel_tracer.h"

#include <algorithm>
#include <variant>

#include "base/colorimetry.h"
#include "base/random.h"
#include "pictures/tuning.h"
#include "rays/ray_functions.h"

namespace rsphere {
namespace {

static_assert(kMaterialTypes == 19, "Do neighboring pixels share its light?");
// Whether gloss changes little between neighboring pixels: its lobe is wider than a few pixels, and neither a
// pattern nor a texture varies it.
bool sharesGloss(const Material& material, const SurfaceHit& hit) {
  if (hit.perturbation != V3d(0, 0, 0)) return false;
  if (const auto* opaque = std::get_if<Opaque>(&material))
    return opaque->roughness >= tuning::Pictures::kLeastRoughness &&
           (!opaque->metal || hit.pattern == Color(1, 1, 1));
  const auto* trans = std::get_if<Trans>(&material);
  return trans && trans->roughness >= tuning::Pictures::kLeastRoughness && hit.pattern == Color(1, 1, 1);
}

double roughnessOf(const Material& material) {
  if (const auto* opaque = std::get_if<Opaque>(&material)) return opaque->roughness;
  const auto* trans = std::get_if<Trans>(&material);
  return trans ? trans->roughness : 0;
}

// Whether the light of sources changes little between neighboring pixels except at shadows. Any finer
// variation is then noise in soft shadows.
bool sharesDirect(const Material& material, const SurfaceHit& hit) {
  if (hit.perturbation != V3d(0, 0, 0) || hit.pattern != Color(1, 1, 1)) return false;
  return std::holds_alternative<Opaque>(material) || std::holds_alternative<Trans>(material);
}

// The number of panes of glass that a ray from the eye has passed straight; -1 if it was deflected.
int panesBefore(const RayEnd& end, const Scene& scene) {
  int panes = 0;
  for (const RayEnd *at = &end, *before = at->context.parent; before;
       at = before, before = at->context.parent, ++panes) {
    if (at->context.kind != kTransmitted || at->ray.direction != before->ray.direction) return -1;
    const Material* const passed = scene.materialOf(scene.surfaces[before->hit.surface]);
    if (passed && !std::holds_alternative<Glass>(*passed)) return -1;
  }
  return panes;
}

// Which surfaces sharp reflections and refractions show to the eye, and where the first of them begins.
struct Images {
  SurfaceHit mirror;  // surface kNone: none
  double distance = 0;
  uint64_t hash = 0;
};

// Adds the image of a surface that gathers, seen by a path without rough reflections.
void addImage(const RayEnd& shown, const Scene& scene, Images& images) {
  uint64_t hash = 0;
  const RayEnd* mirror = &shown;
  for (const RayEnd* at = &shown; at; at = at->context.parent) {
    hash = mixBits(hash + 4 * static_cast<uint64_t>(at->hit.surface.number() + 1) + at->context.kind);
    if (at->context.parent && panesBefore(*at, scene) < 0) mirror = at->context.parent;
  }
  images.hash += hash;
  if (images.mirror.surface != kNone) return;
  images.mirror = mirror->hit;
  images.distance = mirror->context.pathLength + mirror->hit.length;
}

}  // namespace

PixelTracer::PixelTracer(const V3d& point, const Transport& transport)
    : point_(point),
      prepared_(transport.prepared()),
      tracer_(transport.pathTracer({FirstBounce::gathered})),
      separates_(!hasMedia(prepared_)) {}

PixelSample PixelTracer::trace(const V3d& direction, uint64_t seed, PixelParts parts) {
  if (!separates_) parts = PixelParts::all;
  const PixelSample sample = traceOnce(direction, seed, parts);
  const bool separated = sample.seen.material != kNone;
  if (!separated && (sample.leftOut.indirect || sample.leftOut.lobes))
    return traceOnce(direction, seed, PixelParts::all);
  if (separated && sample.leftOut.lobes && !sample.sharesGloss)
    return traceOnce(direction, seed, PixelParts::noIndirect);
  return sample;
}

PixelSample PixelTracer::traceOnce(const V3d& direction, uint64_t seed, PixelParts parts) {
  // The surface that the pixel shows, which may be behind panes. All light is as it arrives at the eye.
  SurfaceHit shown;
  int panes = 0;
  double distance = 0;
  Radiance value, indirect, gloss, brought;  // brought: light of all rays that the surface sends out
  const RayEnd* from = nullptr;
  Images images;
  Radiance mirrored;
  const RayEnd* imaged = nullptr;
  // Whether sharp reflections or refractions show a surface without a pattern.
  const auto isImage = [&](const RayEnd& end) {
    constexpr unsigned kSharp = kPrimary | kReflected | kRefracted | kTransmitted;
    return !(end.context.kinds & ~kSharp) && end.hit.pattern == Color(1, 1, 1) &&
           panesBefore(end, prepared_.scene()) < 0;
  };
  // Children are observed before their parents: the first straight ray to finish is the one that ends at the
  // surface, and the rays of the surface are the ones just before it.
  const RayObserver separate = [&](const RayEnd& end, const RayResult& result) {
    const PathContext& ray = end.context;
    const Radiance arriving = result.value * ray.contribution;
    if (ray.kind & kAmbient && isImage(*ray.parent)) {
      mirrored += arriving;
      if (ray.parent != imaged &&
          maxChannel(ray.parent->context.contribution) > tuning::Pictures::kFaintImage)
        addImage(*ray.parent, prepared_.scene(), images);
      imaged = ray.parent;
    }
    if (shown.surface != kNone) return;
    if (const int passed = panesBefore(end, prepared_.scene()); passed >= 0) {
      if (end.hit.surface == kNone) return;
      shown = end.hit;
      panes = passed;
      distance = ray.pathLength + end.hit.length;
      value = arriving;
      if (from != &end) indirect = gloss = brought = {};
      return;
    }
    if (!ray.parent || panesBefore(*ray.parent, prepared_.scene()) < 0) return;
    if (from != ray.parent) indirect = gloss = brought = {};
    from = ray.parent;
    if (ray.kind & kAmbient) indirect += arriving;
    if (ray.kind & kSpecular) gloss += arriving;
    if (!(ray.kind & kShadow)) brought += arriving;
  };
  const TracedRay ray = tracer_.trace(point_, direction, 0, seed,
                                      {.observer = &separate,
                                       .leavesOutIndirect = parts != PixelParts::all,
                                       .leavesOutLobes = parts == PixelParts::restAlone});
  const SpectralSampling* const sampling = prepared_.options().sampling;
  PixelSample sample;
  sample.leftOut = ray.leftOut;
  sample.shown = ray.shown;
  sample.rest = shownRgb(ray.value.color, sampling);
  sample.pattern = shownRgb(shown.pattern, sampling);
  if (separates_ && images.mirror.surface != kNone) {
    sample.mirrored = shownRgb(mirrored.color, sampling);
    sample.rest -= sample.mirrored;
    const ModifierId of = prepared_.scene().surfaces[images.mirror.surface].material;
    sample.mirror = {of,
                     Imath::V3f(images.distance * direction),
                     Imath::V3f(images.mirror.normal),
                     static_cast<float>(images.distance),
                     0,
                     static_cast<uint32_t>(images.hash)};
  } else {
    mirrored = {};
  }
  // Indirect light is divided by the pattern, which is impossible if the pattern is black in a channel.
  const V3d& pattern = sample.pattern;
  if (shown.surface == kNone || !separates_ || !(std::min({pattern.x, pattern.y, pattern.z}) > 0))
    return sample;
  const ModifierId id = prepared_.scene().surfaces[shown.surface].material;
  const Material* const material = prepared_.scene().materialAt(id);
  if (!material) return sample;
  sample.sharesGloss = sharesGloss(*material, shown);
  sample.sharesDirect = sharesDirect(*material, shown);
  if (!sample.sharesGloss) gloss = {};
  const Radiance direct = sample.sharesDirect ? value - brought : Radiance();
  sample.rest = shownRgb((ray.value - indirect - gloss - direct - mirrored).color, sampling);
  sample.indirect = shownRgb(indirect.color, sampling) / pattern;
  sample.gloss = shownRgb(gloss.color, sampling);
  sample.direct = shownRgb(direct.color, sampling);
  sample.seen = {id,
                 Imath::V3f(distance * direction),
                 Imath::V3f(shown.normal),
                 static_cast<float>(distance),
                 panes,
                 0,
                 static_cast<float>(roughnessOf(*material))};
  return sample;
}

}  // namespace rsphere
