// Reads scene text and converts it for the tracer. The result is a consistent scene or rad::Error. Commands
// are disabled, so the only "!" lines that are executed are xform.
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "rad_parser/scene_file.h"
#include "scene/build_scene.h"

namespace {

bool within(rsphere::ModifierId modifier, size_t size) {
  return modifier.number() >= -1 && modifier.number() < static_cast<int64_t>(size);
}

void check(const rsphere::Scene& scene) {
  for (const rsphere::Surface& surface : scene.surfaces) {
    if (!within(surface.modifier, scene.modifiers.size()) ||
        !within(surface.material, scene.modifiers.size()))
      std::abort();
    if (scene.surfaces.primitiveOf(surface.id).index() >= scene.description.primitives.size()) std::abort();
    static_cast<void>(scene.place(surface));
    static_cast<void>(scene.modifierName(surface));
    static_cast<void>(scene.materialName(surface));
  }
  for (const rsphere::ModifierId i : scene.modifiers.ids())
    if (!within(scene.modifiers[i].next, scene.modifiers.size()) || scene.modifiers[i].next == i)
      std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  rad::ReadOptions options;
  options.commands = false;
  options.warn = [](std::string_view) {};
  try {
    check(rsphere::buildScene(rad::readSceneText(text, "fuzz.rad", options), options));
  } catch (const rad::Error&) {
  }
  return 0;
}
