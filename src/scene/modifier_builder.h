#pragma once
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "rad_parser/description.h"
#include "rad_parser/error.h"
#include "scene/modifier_arguments.h"
#include "scene/scene.h"

namespace rsphere {

// Converts modifiers to Scene::modifiers: those that surfaces use, and those named in their arguments. Each
// is converted once.
class ModifierBuilder {
 public:
  // Keeps references to both. The description of the scene may grow between calls.
  ModifierBuilder(Scene& scene, const rad::Warn& warn) : scene_(scene), warn_(warn) {}

  // Begins a new file. Its description, starting with this primitive, has been appended to the scene's.
  // String arguments in it refer only to modifiers of the same file.
  void beginFile(uint32_t firstPrimitive);

  // Converts the modifier at this index of the description, and the chain of its own modifiers. Returns its
  // index in Scene::modifiers; kNone for rad::kVoid. Throws rad::Error with the file and line of a primitive
  // for: wrong arguments, undefined names, modifiers that name each other too deeply, and unsupported types.
  ModifierId modifier(PrimitiveId described);

  // Surface::clip of surfaces with the modifier at this index of the description. REQUIRES that all modifiers
  // of the scene have been converted.
  uint64_t clipOf(PrimitiveId described) const;

 private:
  static constexpr ModifierId kUnknown{-2};  // not converted yet
  static constexpr int kDeepest = 64;

  // Modifier::content and Modifier::arguments.
  struct Made {
    Content content;
    std::unique_ptr<const EvaluatedArguments> arguments;

    // A material without functions.
    template <class M>
    requires(std::constructible_from<Material, M> && !requires(M m) { m.functions; }) Made(M made)
        : content(std::move(made)) {}
    template <class Arguments>
    Made(Content made, Arguments read)
        : content(std::move(made)), arguments(std::make_unique<EvaluatedArguments>(std::move(read))) {}
    // A material whose arguments are its values and the data for its functions.
    template <class Arguments>
    requires requires(Arguments read) { read.values; }
    Made(Arguments read) : Made(read.values, read) {}
  };

  rad::Primitive primitive(PrimitiveId i) const { return scene_.description.primitives[i]; }
  PrimitiveId definedBefore(PrimitiveId i, std::string_view name);
  ModifierId named(PrimitiveId i, std::string_view name);
  Made make(PrimitiveId i);
  template <class Arguments>
  Made mixture(PrimitiveId i, Arguments read);
  Alternate alternate(PrimitiveId i, const AlternatingArguments& arguments);
  Made wgmd(PrimitiveId i, WgmdArguments read);
  Material antimatter(PrimitiveId i, const Words& clipped);
  void warnOfExcess(PrimitiveId i, const Material& material, ModifierId next);
  void warnOfNegativeLight(PrimitiveId i, const Material& material);
  void warnOnce(PrimitiveId i, const std::string& text);

  Scene& scene_;
  const rad::Warn& warn_;
  uint32_t firstPrimitive_ = 0;              // first primitive of the file that is being converted
  std::optional<rad::ModifierIndex> index_;  // created when a string argument first names a modifier
  int depth_ = 0;                            // nesting of conversions through names in arguments
  std::unordered_map<PrimitiveId, uint64_t> clipOf_;
  uint32_t mists_ = 0;
  std::set<std::string> warned_;  // texts of past warnings, so that the copies of an array cause one warning
  ById<PrimitiveId, ModifierId> modifierOf_;
};

}  // namespace rsphere
