#pragma once
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "scene/modifier_arguments.h"
#include "scene/scene.h"

namespace rsphere {

// Converts the modifiers that surfaces use, and those that these name, to Scene::modifiers, each once.
class ModifierBuilder {
 public:
  // Keeps references to both. The description of the scene may grow between calls.
  ModifierBuilder(Scene& scene, const rad::Warn& warn) : scene_(scene), warn_(warn) {}

  // Begins with a file whose description has been appended to the scene's: string arguments name only
  // modifiers among the primitives from this one on.
  void beginFile(uint32_t firstPrimitive);

  // Converts the modifier at this index of the description and the chain of those that modify it. Returns its
  // index in Scene::modifiers; kNone for rad::kVoid. Throws rad::Error with a primitive's place for: wrong
  // arguments, undefined names, modifiers that name each other too deeply, and types that are not supported.
  ModifierId modifier(PrimitiveId described);

  // Surface::clip of the surfaces with the modifier at this index of the description. All modifiers of the
  // scene must have been converted before.
  uint64_t clipOf(PrimitiveId described) const;

 private:
  static constexpr ModifierId kUnknown{-2};  // not converted yet
  static constexpr int kDeepest = 64;

  rad::Primitive primitive(PrimitiveId i) const { return scene_.description.primitives[i]; }
  PrimitiveId definedBefore(PrimitiveId i, std::string_view name);
  ModifierId named(PrimitiveId i, std::string_view name);
  Content content(PrimitiveId i);
  Content mixture(PrimitiveId i, const Mixed& names);
  Alternate alternate(PrimitiveId i, const AlternatingArguments& arguments);
  std::optional<ModifierId> componentModifier(PrimitiveId i, std::string_view name, bool used);
  Material wgmd(PrimitiveId i, const WgmdArguments& arguments);
  Material antimatter(PrimitiveId i, const AntimatterArguments& arguments);
  Material mist(Mist read);
  void warnOfExcess(PrimitiveId i, const Material& material, ModifierId next);

  Scene& scene_;
  const rad::Warn& warn_;
  uint32_t firstPrimitive_ = 0;              // of the file that is being converted
  std::optional<rad::ModifierIndex> index_;  // made when a string argument first names a modifier
  int depth_ = 0;                            // of nested conversions by such names
  std::unordered_map<PrimitiveId, uint64_t> clipOf_;
  uint32_t mists_ = 0;
  std::set<std::string> excesses_;  // that were warned of, so that the copies of an array give one warning
  ById<PrimitiveId, ModifierId> modifierOf_;
};

}  // namespace rsphere
