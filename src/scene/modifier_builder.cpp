#include "scene/modifier_builder.h"

#include <fmt/format.h>

#include "base/constants.h"
#include "rad_parser/printable.h"

namespace rsphere {

using rad::printable;
using rad::Type;

namespace {

// If a material has functions, stores the index of the modifier that they belong to.
void setFunctions(Material& material, ModifierId index) {
  std::visit(
      [index](auto& kind) {
        if constexpr (requires { kind.functions; }) kind.functions = index;
      },
      material);
}

}  // namespace

void ModifierBuilder::beginFile(uint32_t firstPrimitive) {
  firstPrimitive_ = firstPrimitive;
  index_.reset();
}

ModifierId ModifierBuilder::modifier(PrimitiveId described) {
  if (described == rad::kVoid) return kNone;
  modifierOf_.resize(scene_.description.primitives.size(), kUnknown);
  // The loop follows the chain from `described` to void. It avoids recursion because a file may contain
  // chains of any length.
  std::vector<PrimitiveId> chain;
  PrimitiveId next = described;
  while (next != rad::kVoid && modifierOf_[next] == kUnknown) {
    chain.push_back(next);
    next = primitive(next).modifier;
  }
  ModifierId converted = next == rad::kVoid ? kNone : modifierOf_[next];
  while (!chain.empty()) {
    const PrimitiveId i = chain.back();
    chain.pop_back();
    PrimitiveId target = i;
    while (target != rad::kVoid) {
      const rad::Primitive alias = primitive(target);
      if (alias.type != Type::alias) break;
      target = alias.aliased != rad::kVoid ? alias.aliased : target == i ? rad::kVoid : alias.modifier;
    }
    if (target != rad::kVoid) {  // an alias without a target stands for its modifier
      Made made = make(target);
      const ModifierId index(scene_.modifiers.size());
      if (auto* material = std::get_if<Material>(&made.content)) {
        setFunctions(*material, index);
        warnOfExcess(target, *material, converted);
        warnOfNegativeLight(target, *material);
      }
      scene_.modifiers.push_back(
          {std::move(made.content), std::move(made.arguments), converted, target, primitive(target)});
      converted = index;
    }
    modifierOf_[i] = converted;
  }
  return converted;
}

uint64_t ModifierBuilder::clipOf(PrimitiveId described) const {
  const auto found = clipOf_.find(described);
  return found != clipOf_.end() ? found->second : 0;
}

// The index of the latest definition of a modifier before primitive i; rad::kVoid if there is none.
PrimitiveId ModifierBuilder::definedBefore(PrimitiveId i, std::string_view name) {
  if (!index_) index_.emplace(scene_.description, firstPrimitive_);
  return index_->before(name, i);
}

// The modifier that a string argument of primitive i names: its latest definition before i; kNone for void.
ModifierId ModifierBuilder::named(PrimitiveId i, std::string_view name) {
  if (name == "void") return kNone;
  const PrimitiveArguments arguments(scene_.description, i);
  const PrimitiveId described = definedBefore(i, name);
  if (described == rad::kVoid)
    arguments.fail(fmt::format("undefined modifier \"{}\"{}", printable(name), index_->nearest(name, i)));
  // At a hit, nested modifiers recurse to the same depth, with up to 2^depth evaluations.
  if (depth_ == kDeepest) arguments.fail(fmt::format("modifiers are nested more than {} deep", kDeepest));
  ++depth_;
  const ModifierId converted = modifier(described);
  --depth_;
  return converted;
}

template <class Arguments>
ModifierBuilder::Made ModifierBuilder::mixture(PrimitiveId i, Arguments read) {
  const ModifierId foreground = named(i, read.mixed.foreground);
  return {Mixture{foreground, named(i, read.mixed.background)}, std::move(read)};
}

ModifierBuilder::Made ModifierBuilder::make(PrimitiveId i) {
  static_assert(rad::kTypes == 59, "Which modifier is a new type?");
  const PrimitiveArguments arguments(scene_.description, i);
  switch (arguments.type()) {
    case Type::brightfunc:
    case Type::colorfunc: return {Pattern{}, readFunction(arguments)};
    case Type::brightdata:
    case Type::colordata:
    case Type::specdata: return {Pattern{}, readData(arguments)};
    case Type::colorpict:
    case Type::specpict: return {Pattern{}, readPicture(arguments)};
    case Type::spectrum: return {Pattern{}, readSpectrum(arguments)};
    case Type::specfile: return {Pattern{}, readSpectrumFile(arguments)};
    case Type::specfunc: return {Pattern{}, readSpectralFunction(arguments)};
    case Type::brighttext:
    case Type::colortext: return {Pattern{}, readText(arguments)};
    case Type::texfunc: return {Texture{}, readFunction(arguments)};
    case Type::texdata: return {Texture{}, readData(arguments)};
    case Type::mixfunc: return mixture(i, readFunction(arguments));
    case Type::mixdata: return mixture(i, readData(arguments));
    case Type::mixpict: return mixture(i, readPicture(arguments));
    case Type::mixtext: return mixture(i, readText(arguments));
    case Type::plastic:
    case Type::metal: return readOpaque(arguments);
    case Type::trans: return readTrans(arguments);
    case Type::plastic2:
    case Type::metal2:
    case Type::trans2: return readAnisotropic(arguments);
    case Type::ashik2: return readAshikhmin(arguments);
    case Type::plasfunc:
    case Type::metfunc:
    case Type::transfunc: return readFunctionScatterer(arguments);
    case Type::plasdata:
    case Type::metdata:
    case Type::transdata: return readDataScatterer(arguments);
    case Type::brtdfunc: return readBrtd(arguments);
    case Type::wgmdfunc: return wgmd(i, readWgmd(arguments));
    case Type::bsdf:
    case Type::absdf: return readBsdf(arguments);
    case Type::dielectric: return readDielectric(arguments);
    case Type::interface: return readInterface(arguments);
    case Type::glass: return readGlass(arguments);
    case Type::mirror: {
      const AlternatingArguments read = readAlternating(arguments);
      return Mirror{read.color, alternate(i, read)};
    }
    case Type::prism1:
    case Type::prism2: {
      PrismArguments read = readPrism(arguments);
      return {Prism{static_cast<int>(read.images.size())}, std::move(read)};
    }
    case Type::antimatter: return antimatter(i, readAntimatter(arguments));
    case Type::mist: {
      Mist mist = readMist(arguments);
      mist.number = mists_++;
      return mist;
    }
    case Type::light: return readLight(arguments);
    case Type::illum: {
      const AlternatingArguments read = readAlternating(arguments);
      return Illum{read.color, alternate(i, read)};
    }
    case Type::glow: return readGlow(arguments);
    case Type::spotlight: return readSpotlight(arguments);
    default: arguments.fail("this type is not supported yet");  // modifier() resolves aliases
  }
}

Alternate ModifierBuilder::alternate(PrimitiveId i, const AlternatingArguments& arguments) {
  if (!arguments.alternate) return {};
  const std::string_view name = *arguments.alternate;
  if (name != "void" && definedBefore(i, name) != rad::kVoid)
    return {Alternate::Kind::modifier, named(i, name)};
  if (name != "void")  // as in rtrace
    warnOnce(i, fmt::format("undefined modifier \"{}\" is treated as void{}", printable(name),
                            index_->nearest(name, i)));
  return {Alternate::Kind::pass, kNone};
}

ModifierBuilder::Made ModifierBuilder::wgmd(PrimitiveId i, WgmdArguments read) {
  WgmdFunction& made = read.values;
  // No modifier is needed for a component that reflects or transmits nothing.
  const auto use = [&](std::string_view name, double share) {
    return share > kNegligible && name != "inherit" ? std::optional(named(i, name)) : std::nullopt;
  };
  made.reflected.modifier = use(read.reflected.modifier, made.reflected.share);
  made.transmitted.modifier = use(read.transmitted.modifier, made.transmitted.share);
  made.diffuseTransmittedModifier = use(read.diffuseTransmittedModifier, maxChannel(made.diffuseTransmitted));
  return read;
}

Material ModifierBuilder::antimatter(PrimitiveId i, const Words& clipped) {
  const PrimitiveArguments own(scene_.description, i);
  Antimatter made;
  for (size_t k = 0; k < clipped.size(); ++k) {
    const std::string_view name = clipped[k];
    if (name == "void") continue;
    const PrimitiveId described = definedBefore(i, name);
    if (described == rad::kVoid) {
      own.warn(warn_, fmt::format("unknown modifier \"{}\"{}", printable(name), index_->nearest(name, i)));
      continue;
    }
    const auto [clip, added] = clipOf_.try_emplace(described, uint64_t{1} << (clipOf_.size() % 64));
    if (added && clipOf_.size() > 64) own.fail("more than 64 modifiers are clipped by antimatter");
    made.clips |= clip->second;
    if (k == 0) made.cut = {Alternate::Kind::modifier, named(i, name)};
  }
  return made;
}

// Warns of a material from which more light leaves than arrives, once for equal definitions. If a pattern
// modifies the material there is no warning, because the pattern may multiply its color by less than 1.
void ModifierBuilder::warnOfExcess(PrimitiveId i, const Material& material, ModifierId next) {
  const std::optional<Excess> excess = excessOf(material);
  if (!excess) return;
  for (; next != kNone; next = scene_.modifiers[next].next)
    if (std::holds_alternative<Pattern>(scene_.modifiers[next].content)) return;
  warnOnce(i, fmt::format("{} {:g} is above {:.3g}, so that more light leaves the surface than arrives",
                          excess->argument, excess->value, excess->most));
}

// Warns of a source with negative radiance. It is not sampled if no channel is above 0; glow without reach is
// found by rays in any case.
void ModifierBuilder::warnOfNegativeLight(PrimitiveId i, const Material& material) {
  const std::optional<Radiance> radiance = sourceRadiance(material);
  if (!radiance || !(minChannel(radiance->color) < 0)) return;
  const bool found = std::holds_alternative<Glow>(material) && reachOf(material) <= 0;
  warnOnce(i, found || isSampled(material) ? "negative radiance: it makes negative light"
                                           : "negative radiance: it is seen, but lights nothing");
}

void ModifierBuilder::warnOnce(PrimitiveId i, const std::string& text) {
  const rad::Primitive p = primitive(i);
  if (warned_.insert(fmt::format("{} {} {}", static_cast<int>(p.type), p.name, text)).second)
    PrimitiveArguments(scene_.description, i).warn(warn_, text);
}

}  // namespace rsphere
