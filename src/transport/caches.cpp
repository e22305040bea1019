#include "transport/caches.h"

#include <algorithm>

#include "base/version.h"
#include "field/fingerprint.h"
#include "transport/tuning.h"

namespace rsphere {
namespace {

// A fingerprint of everything that determines gathered light, except the scene; includes the program's
// version.
uint64_t fingerprint(const RayOptions& o, bool basicRadiance, const rad::FileAccess& access) {
  // Names all members, so that this fails to compile when an option is added. Add the new option below if it
  // changes gathered light. Not used: `sampling`, because spectral runs are not stored; -aw,
  // -Sgc and, where sites are gathered, -Sh, which have no effect; -af and -Sm, which only select where and
  // how much is stored; and patchesForRecords, since without it (-I) there are no records.
  const auto& [sampling, wavelengths, directThreshold, directCertainty, directJitter, sourceSubstructuring,
               directRelays, chosenSources, directPretest, sourcesVisible, caustics, specularSampling,
               specularThreshold, ambientBounces, ambientAccuracy, ambientResolution, ambientDivisions,
               ambientSuperSamples, firstRays, ambientValue, ambientWeight, leastForPatches, raysForPatches,
               patchesForRecords, solutions, coarserLinks, ambientFile, fieldMemory, ambientExcluded,
               ambientIncluded, reflectionLimit, weightLimit, mediumExtinction, mediumAlbedo,
               mediumEccentricity, mediumSampling, definitions, backFacesVisible, uncorrelated, rotation] = o;
  Fingerprint print;
  print.add(kVersion);
  print.add(uint64_t{11});  // increase this if gathering changes without a new kVersion
  for (const double x :
       {directThreshold, directCertainty, directJitter, sourceSubstructuring, specularSampling,
        specularThreshold, ambientAccuracy, weightLimit, mediumEccentricity, mediumSampling})
    print.add(x);
  for (const Color& color : {ambientValue.color, mediumExtinction, mediumAlbedo})
    for (int c = 0; c < 3; ++c) print.add(static_cast<double>(color[c]));
  for (const int n : {directRelays, chosenSources, directPretest, ambientBounces, ambientResolution,
                      ambientDivisions, ambientSuperSamples, leastForPatches, reflectionLimit})
    print.add(static_cast<uint64_t>(n));
  if (wavelengths != WavelengthLimits())
    for (const double x : {wavelengths.shortest, wavelengths.longest}) print.add(x);
  if (rotation != 0) print.add(rotation);
  if (raysForPatches != 0) print.add(raysForPatches);
  if (solutions != 1) print.add(static_cast<uint64_t>(solutions) << 32);
  if (coarserLinks != 0) print.add(static_cast<uint64_t>(coarserLinks));
  for (const bool b : {sourcesVisible, backFacesVisible, uncorrelated, basicRadiance}) print.add(uint64_t{b});
  for (const auto* names : {&ambientExcluded, &ambientIncluded}) {
    print.add(uint64_t{names->size()});
    for (const std::string& name : *names) print.add(name);
  }
  for (const SharedDefinitions& definition : definitions) {
    print.add(definition.text);
    if (definition.isFile) addFile(print, definition.text, access);
  }
  return print.value();
}

}  // namespace

FieldOptions fieldOptions(const RayOptions& o) {
  FieldOptions field;
  // Names all members, so that this fails to compile when one is added.
  auto& [bounces, accuracy, resolution, rays, solutions, coarserLinks, patchesAtFirst, ambientValue, spectral,
         rotation, memory] = field;
  bounces = o.ambientBounces;
  accuracy = o.ambientAccuracy;
  resolution = o.ambientResolution;
  rays = o.raysForPatches > 0 ? o.raysForPatches
                              : std::max(o.ambientDivisions + o.ambientSuperSamples, o.leastForPatches);
  solutions = o.solutions;
  coarserLinks = o.coarserLinks;
  patchesAtFirst = o.leastForPatches > 0;
  ambientValue = o.ambientValue;
  spectral = o.sampling != nullptr;
  rotation = rotationBits(o);
  memory = o.fieldMemory;
  return field;
}

LitBy litBy(const Aims& aims, bool byLamps) {
  if (byLamps) return LitBy::lamps;
  if (!aims.of<Openings>()) return LitBy::other;
  const auto* const spots = aims.of<BrightSpots>();
  return spots && !spots->sunlit().empty() ? LitBy::sun : LitBy::openings;
}

int raysOfRecord(const RayOptions& o, LitBy by) {
  const int all = o.ambientDivisions + o.ambientSuperSamples;
  if (by == LitBy::other) return all;
  using Of = tuning::Interpolation;
  const auto [rays, part] = by == LitBy::lamps ? std::pair(Of::kRaysByLamps, Of::kPartByLamps)
                            : by == LitBy::sun ? std::pair(Of::kRaysBySun, Of::kPartBySun)
                                               : std::pair(Of::kRaysByOpenings, Of::kPartByOpenings);
  return static_cast<int>(
      std::clamp<double>(rays / (o.ambientAccuracy * o.ambientAccuracy), (all + part - 1) / part, all));
}

Caches makeCaches(const PreparedScene& prepared, const Aims& aims, const rad::Warn& warn) {
  const RayOptions& o = prepared.options();
  Caches caches;
  caches.aims = aims;
  if (!prepared.options().hasIndirectLight() || !(o.ambientAccuracy > 0)) return caches;
  const Scene& scene = prepared.scene();
  const Box3d& bounds = prepared.tracer().bounds();
  caches.field = std::make_unique<IrradianceField>(scene, bounds, fieldOptions(o));
  // Without a distant source, openings only transmit the light of lamps from one room to another.
  const bool isDaylit = aims.of<Openings>() && !prepared.lights().distant().empty();
  caches.byLamps = isLitByLamps(prepared);
  if (o.ambientBounces > 1) {
    FieldOptions ofPatches = fieldOptions(o);
    // Patches with more rays than -aa is worth take up to a quarter of the time of a picture, for nearly the
    // same error (2026-11-29-pictures.txt).
    if (o.patchesForRecords && isDaylit)
      ofPatches.rays = std::min<double>(ofPatches.rays, raysOfRecord(o, litBy(aims, false)));
    caches.coarse = std::make_unique<CoarseSolution>(scene, bounds, ofPatches,
                                                     isDaylit ? aims.of<Openings>()->depth() : 0);
  }
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
