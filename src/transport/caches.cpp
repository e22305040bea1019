#include "transport/caches.h"

#include <algorithm>

#include "base/version.h"
#include "scene/fingerprint.h"

namespace rsphere {
namespace {

// A fingerprint of everything but the scene that determines gathered light, the program's version included.
uint64_t fingerprint(const RayOptions& o, bool basicRadiance, const rad::FileAccess& access) {
  Fingerprint print;
  print.add(kVersion);
  print.add(uint64_t{7});  // increase it if the method of gathering changes between two versions
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
  if (o.coarserLinks != 0) print.add(static_cast<uint64_t>(o.coarserLinks));
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
          o.coarserLinks,
          o.ambientValue,
          o.sampling != nullptr,
          o.fieldMemory};
}

Caches makeCaches(const PreparedScene& prepared, const Aims& aims, const rad::Warn& warn) {
  const RayOptions& o = prepared.options();
  Caches caches;
  caches.aims = aims;
  if (!prepared.options().hasIndirectLight() || !(o.ambientAccuracy > 0)) return caches;
  const Scene& scene = prepared.scene();
  const Box3d& bounds = prepared.tracer().bounds();
  caches.field = std::make_unique<IrradianceField>(scene, bounds, fieldOptions(o));
  // Where there is no distant source, openings only bring the light of lamps from one room to another.
  const bool isDaylit = aims.openings && !prepared.lights().distant().empty();
  if (o.ambientBounces > 1)
    caches.coarse = std::make_unique<CoarseSolution>(scene, bounds, fieldOptions(o),
                                                     isDaylit ? aims.openings->depth() : 0);
  if (o.ambientFile.empty()) return caches;
  if (o.sampling) {
    if (warn) warn("-af: nothing is kept of a spectral run (-cs above 3); the ambient file is ignored");
  } else {
    caches.field->keepIn(AmbientFile::openBeside(
        o.ambientFile, fingerprint(scene), fingerprint(o, prepared.basicRadiance(), scene.files), warn));
  }
  return caches;
}

}  // namespace rsphere
