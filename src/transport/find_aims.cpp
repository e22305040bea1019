#include "transport/find_aims.h"

namespace rsphere {
namespace {

BrightSpots spotsOf(const PreparedScene& prepared, const Openings* openings) {
  return BrightSpots(prepared.scene(), prepared.tracer(), prepared.lights(), prepared.functions(), openings);
}

// Openings, unless the scene has importance goals, and their images in flat mirrors.
FoundAims findOpeningsAndImages(const PreparedScene& prepared) {
  FoundAims found;
  if (prepared.scene().importance) return found;
  found.keep(findOpenings(prepared));
  if (const Openings* const openings = found.of<Openings>()) found.keep(OpeningImages(prepared, *openings));
  return found;
}

}  // namespace

FoundAims findAimsOfGathers(const PreparedScene& prepared) {
  if (!prepared.options().hasIndirectLight()) return {};
  FoundAims found = findOpeningsAndImages(prepared);
  found.keep(spotsOf(prepared, found.of<Openings>()));
  found.keep(Highlights(prepared.scene(), prepared.tracer(), prepared.lights()));
  return found;
}

FoundAims findAimsOfPoints(const PreparedScene& prepared) {
  if (prepared.options().hasIndirectLight()) return {};
  FoundAims found = findOpeningsAndImages(prepared);
  if (const Openings* const openings = found.of<Openings>()) found.keep(spotsOf(prepared, openings));
  return found;
}

}  // namespace rsphere
