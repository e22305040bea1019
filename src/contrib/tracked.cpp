#include "contrib/tracked.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <unordered_map>

#include "rays/ray_functions.h"
#include "scene/modifier_names.h"

namespace rsphere {

Tracked::Tracked(const PreparedScene& prepared, std::vector<TrackedModifier> modifiers, Contributed what,
                 rad::Warn warn)
    : prepared_(prepared),
      modifiers_(std::move(modifiers)),
      what_(what),
      warn_(std::move(warn)),
      warned_(modifiers_.size()) {
  std::unordered_map<std::string_view, uint32_t> byName;
  std::vector<std::string> names;
  for (const TrackedModifier& modifier : modifiers_) {
    byName.emplace(modifier.name, static_cast<uint32_t>(names.size()));
    names.push_back(modifier.name);
    firstColumn_.push_back(firstColumn_.back() + modifier.bins);
  }
  for (const Finish& finish : prepared.scene().surfaces.finishes()) {
    const auto found = byName.find(finish.name);
    modifierOf_.push_back(found == byName.end() ? kNotTracked : found->second);
  }
  warnOfMissingModifiers(prepared.scene(), names, "", warn_);
  if (what_ == Contributed::coefficients) chooseLights();
}

// The coefficient of a path does not depend on the light of sources that are not tracked, unlike the value of
// a tracked surface that they light. A virtual source contributes to its relay and to the source that it
// shows.
void Tracked::chooseLights() {
  const auto& lights = prepared_.lights().all();
  for (const LightSource& light : lights) {
    const LightSource* source = &light;
    while (modifierOf(source->surface) == kNotTracked && source->isVirtual())
      source = &lights[source->relayed];
    sampledLights_.push_back(modifierOf(source->surface) != kNotTracked);
  }
  if (std::ranges::all_of(sampledLights_, std::identity())) sampledLights_.clear();
}

uint32_t Tracked::modifierOf(SurfaceId surface) const {
  return modifierOf_[prepared_.scene().surfaces.face(surface).finish];
}

int Tracked::components() const {
  const SpectralSampling* sampling = prepared_.options().sampling;
  return sampling ? static_cast<int>(sampling->count()) : 3;
}

// Whether the value of a ray is light from the surface that it hit.
// - An emitting source is black for rays whose light next-event estimation already includes, and for shadow
//   rays aimed at another source.
// - An illum shows its own light only to shadow rays. The value of any other ray is light from behind the
//   illum or of its alternate material.
// - As in RADIANCE, coefficients also include paths through an illum, and to the dark back of a source.
bool Tracked::counts(const RayEnd& end, const RayResult& result) const {
  const LightId aimedAt = end.ray.aimedAt;
  if (aimedAt != kNone && prepared_.lights().all()[aimedAt].surface != end.hit.surface) return false;
  const Scene& scene = prepared_.scene();
  const Surface& surface = scene.surfaces[end.hit.surface];
  const bool fromBehind = aimedAt == kNone && end.hit.cosine < 0;
  if (const Material* material = scene.materialOf(surface);
      aimedAt == kNone && material && std::holds_alternative<Illum>(*material))
    return what_ == Contributed::coefficients &&
           (fromBehind || !(end.context.kinds & (kAmbient | kSpecular)));
  return fromBehind || !isBlack(result.value) || isBlack(sourceRadiance(scene, surface));
}

std::optional<uint32_t> Tracked::columnOf(size_t modifier, const RayEnd& end, BinScratch& scratch) const {
  const TrackedModifier& tracked = modifiers_[modifier];
  if (tracked.zones)
    return firstColumn_[modifier] + static_cast<uint32_t>(tracked.zones->zoneAt(end.ray.direction));
  if (!tracked.bin) return firstColumn_[modifier];
  const std::optional<double> bin = tracked.bin->at(end, scratch);
  if (bin && *bin < 0) return std::nullopt;
  if (bin && *bin < tracked.bins) return firstColumn_[modifier] + static_cast<uint32_t>(*bin);
  if (warn_ && !warned_[modifier].exchange(true))
    warn_(fmt::format("bad bin number ({} ignored): modifier '{}' has bins 0 to {}",
                      bin ? fmt::format("{:.0f}", *bin) : "not finite", tracked.name, tracked.bins - 1));
  return std::nullopt;
}

void Tracked::add(const RayEnd& end, const RayResult& result, BinScratch& scratch,
                  ContributionList& to) const {
  if (end.hit.surface == kNone) return;
  const uint32_t modifier = modifierOf(end.hit.surface);
  if (modifier == kNotTracked || !counts(end, result)) return;
  const std::optional<uint32_t> column = columnOf(modifier, end, scratch);
  if (!column) return;
  Coefficient contribution = end.context.contribution * passedBy(end);
  if (what_ == Contributed::values) contribution.color *= result.value.color;
  const Color& color = contribution.color;
  if (const SpectralSampling* sampling = prepared_.options().sampling)
    return to.add(*column, color.bandsIn(*sampling).values());
  to.add(*column, std::array{color.x, color.y, color.z});
}

const ContributionList& ContributionTracer::trace(const V3d& origin, const V3d& direction, double farthest,
                                                  uint64_t seed, int rays) {
  list_.clear();
  const RayObserver observer = [this](const RayEnd& end, const RayResult& result) {
    tracked_.add(end, result, scratch_, list_);
  };
  const PathRequest request{.observer = &observer,
                            .shadows = ShownShadows::thatArrive,
                            .rays = rays,
                            .sampledLights = tracked_.sampledLights()};
  ray_ = tracer_.trace(origin, direction, farthest, seed, request);
  return list_;
}

}  // namespace rsphere
