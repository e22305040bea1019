#include "transport/find_aims.h"

#include "transport/find_openings.h"

namespace rsphere {
namespace {

template <class T>
std::unique_ptr<const T> unlessEmpty(T&& found) {
  return found.empty() ? nullptr : std::make_unique<const T>(std::move(found));
}

std::unique_ptr<const BrightSpots> spotsOf(const PreparedScene& prepared, const Openings* openings) {
  return unlessEmpty(BrightSpots(prepared.scene(), prepared.tracer(), prepared.lights(), openings));
}

std::unique_ptr<const OpeningImages> imagesOf(const PreparedScene& prepared, const Openings* openings) {
  return openings ? unlessEmpty(OpeningImages(prepared, *openings)) : nullptr;
}

bool looksForSpots(const PreparedScene& prepared, const Openings* openings) {
  return prepared.options().ambientAccuracy > 0 || openings;
}

}  // namespace

FoundAims findAimsOfGathers(const PreparedScene& prepared) {
  FoundAims found;
  if (!prepared.options().hasIndirectLight()) return found;
  const Scene& scene = prepared.scene();
  if (!scene.importance) found.openings = unlessEmpty(findOpenings(prepared));
  found.images = imagesOf(prepared, found.openings.get());
  if (looksForSpots(prepared, found.openings.get())) found.spots = spotsOf(prepared, found.openings.get());
  found.highlights = unlessEmpty(Highlights(scene, prepared.tracer(), prepared.lights()));
  return found;
}

FoundAims findAimsOfPoints(const PreparedScene& prepared) {
  FoundAims found;
  if (prepared.options().hasIndirectLight() || prepared.scene().importance) return found;
  found.openings = unlessEmpty(findOpenings(prepared));
  found.images = imagesOf(prepared, found.openings.get());
  if (found.openings) found.spots = spotsOf(prepared, found.openings.get());
  return found;
}

}  // namespace rsphere
