#include "transport/transport.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/version.h"
#include "field/coarse_solution.h"
#include "field/irradiance_field.h"
#include "scene/fingerprint.h"
#include "transport/bright_spots.h"
#include "transport/highlights.h"
#include "transport/openings.h"
#include "transport/path_tracer.h"
#include "transport/ray_functions.h"

namespace rsphere {
namespace {

// A fingerprint of everything but the scene that determines gathered light, the program's version included.
uint64_t fingerprint(const RayOptions& o, bool basicRadiance, const rad::FileAccess& access) {
  Fingerprint print;
  print.add(kVersion);
  print.add(uint64_t{7});  // changes with the method of gathering between two versions
  for (const double x :
       {o.directThreshold, o.directCertainty, o.directJitter, o.sourceSubstructuring, o.specularSampling,
        o.specularThreshold, o.ambientAccuracy, o.weightLimit, o.mediumEccentricity, o.mediumSampling})
    print.add(x);
  for (const Color& color : {o.ambientValue.color, o.mediumExtinction, o.mediumAlbedo})
    for (int c = 0; c < 3; ++c) print.add(static_cast<double>(color[c]));
  for (const int n : {o.directRelays, o.chosenSources, o.directPretest, o.ambientBounces, o.ambientResolution,
                      o.ambientDivisions, o.ambientSuperSamples, o.leastForPatches, o.reflectionLimit})
    print.add(static_cast<uint64_t>(n));
  if (o.rotation != 0) print.add(o.rotation);
  for (const bool b : {o.sourcesVisible, o.backFacesVisible, o.uncorrelated, basicRadiance})
    print.add(uint64_t{b});
  for (const auto* names : {&o.ambientExcluded, &o.ambientIncluded}) {
    print.add(uint64_t{names->size()});
    for (const std::string& name : *names) print.add(name);
  }
  for (const SharedDefinitions& definitions : o.definitions) {
    print.add(definitions.text);
    if (definitions.isFile) addFile(print, definitions.text, access);
  }
  return print.value();
}

}  // namespace

FieldOptions fieldOptions(const RayOptions& o) {
  return {o.ambientBounces,
          o.ambientAccuracy,
          o.ambientResolution,
          static_cast<double>(std::max(o.ambientDivisions + o.ambientSuperSamples, o.leastForPatches)),
          o.ambientValue,
          o.sampling != nullptr,
          o.fieldMemory};
}

Transport::Transport(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
                     bool basicRadiance, const rad::Warn& warn)
    : scene_(scene),
      options_(options),
      irradiance_(irradiance),
      basicRadiance_(basicRadiance),
      tracer_(scene, options.backFacesVisible),
      functions_(scene, warn, options.definitions, options.sampling, options.wavelengths),
      lights_(scene, options.directRelays, functions_, warn),
      presumedShadows_(scene, tracer_, lights_),
      choice_(scene, lights_),
      luminous_(scene.surfaces.size()) {
  constantRadiance_.resize(lights_.all().size());
  for (const LightId i : lights_.all().ids()) {
    if (lights_.all()[i].isVirtual()) continue;
    luminous_.add(lights_.all()[i].surface);
    const Surface& surface = scene.surfaces[lights_.all()[i].surface];
    if (surface.goal ||
        (surface.modifier == surface.material && scene.modifiers[surface.material].next == kNone))
      constantRadiance_[i] = sourceRadiance(scene, surface);
  }
  for (const SurfaceId i : scene.surfaces.ids()) {
    const Surface& s = scene.surfaces[i];
    const Material* material = scene.materialOf(s);
    if (scene.importance || !s.shape.as<Distant>() || !material) continue;
    const auto radiance = sourceRadiance(*material);
    if (radiance && maxChannel(*radiance) > kNegligible) distant_.push_back(i);
  }
  findScatterers(warn);
  if (options.ambientBounces > 0 && options.ambientDivisions > 0) {
    findAims();
    if (options.ambientAccuracy > 0) prepareInterpolation(warn);
  }
  const bool including = !options.ambientIncluded.empty();
  const auto& names = including ? options.ambientIncluded : options.ambientExcluded;
  if (names.empty()) return;
  ambient_.resize(scene.surfaces.size());
  for (const SurfaceId i : scene.surfaces.ids())
    ambient_[i] = (std::find(names.begin(), names.end(), scene.modifierName(scene.surfaces[i])) !=
                   names.end()) == including;
}

Transport::~Transport() = default;

void Transport::findAims() {
  if (!scene_.importance) {
    auto openings = std::make_unique<Openings>(*this);
    if (!openings->empty()) openings_ = std::move(openings);
  }
  if (looksForSpots()) {
    auto spots = std::make_unique<BrightSpots>(scene_, tracer_, lights_, openings_.get());
    if (!spots->empty()) spots_ = std::move(spots);
  }
  auto highlights = std::make_unique<Highlights>(scene_, tracer_, lights_);
  if (!highlights->empty()) highlights_ = std::move(highlights);
}

void Transport::prepareInterpolation(const rad::Warn& warn) {
  const Box3d& bounds = tracer_.bounds();
  field_ = std::make_unique<IrradianceField>(scene_, bounds, fieldOptions(options_));
  if (options_.ambientBounces > 1)
    coarse_ = std::make_unique<CoarseSolution>(scene_, bounds, fieldOptions(options_),
                                               openings_ ? openings_->depth() : 0);
  if (options_.sampling && !options_.ambientFile.empty()) {
    if (warn) warn("-af: nothing is kept of a spectral run (-cs above 3); the ambient file is ignored");
  } else if (!options_.ambientFile.empty())
    field_->keepIn(AmbientFile::openBeside(options_.ambientFile, fingerprint(scene_),
                                           fingerprint(options_, basicRadiance_, scene_.files), warn));
}

bool Transport::glows(SurfaceList::Beginning surfaces) const {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    const Material* material = scene_.materialOf(surface);
    const auto* glow = material ? std::get_if<Glow>(material) : nullptr;
    return glow && !isBlack(glow->radiance);
  });
}

bool Transport::isDark() const {
  return !scene_.importance && lights_.all().empty() && isBlack(options_.ambientValue) &&
         !glows(scene_.surfaces.first(scene_.surfaces.size()));
}

bool Transport::lacksSources() const {
  return !scene_.importance && lights_.all().empty() &&
         !(options_.ambientBounces > 0 && glows(scene_.outermost()));
}

LightId Transport::sourceNamed(std::string_view name) const {
  const auto& all = lights_.all();
  for (size_t i = all.size(); i-- > 0;) {
    std::string_view rest = name;
    const LightSource* light = &all[LightId(i)];
    for (; light->isVirtual(); light = &all[light->relayed]) {
      const size_t end = rest.find('>');
      if (end == rest.npos || rest.substr(0, end) != scene_.surfaceName(scene_.surfaces[light->surface]))
        break;
      rest.remove_prefix(end + 1);
    }
    if (!light->isVirtual() && rest == scene_.surfaceName(scene_.surfaces[light->surface])) return LightId(i);
  }
  return kNone;
}

void Transport::findScatterers(const rad::Warn& warn) {
  for (const Modifier& m : scene_.modifiers) {
    const auto* material = std::get_if<Material>(&m.content);
    const auto* mist = material ? std::get_if<Mist>(material) : nullptr;
    if (!mist) continue;
    if (scatterersOf_.size() <= mist->number) scatterersOf_.resize(mist->number + 1);
    auto& own = scatterersOf_[mist->number];
    for (const std::string& name : mist->sources) {
      const LightId source = sourceNamed(name);
      if (source == kNone) {
        // In a scene with goals, light sources do not emit, so that the warning would be pointless.
        if (warn && !scene_.importance)
          warn(fmt::format("{}: unknown source \"{}\"", scene_.place(m.primitive), rad::printable(name)));
        continue;
      }
      auto found = std::find(scatterers_.begin(), scatterers_.end(), source);
      if (found == scatterers_.end()) found = scatterers_.insert(found, source);
      const auto position = static_cast<uint16_t>(found - scatterers_.begin());
      if (std::find(own.begin(), own.end(), position) == own.end()) own.push_back(position);
    }
    if (scatterers_.size() > UINT16_MAX)
      throw rad::Error(scene_.place(m.primitive) + ": mists name more than 65535 light sources");
  }
}

}  // namespace rsphere
