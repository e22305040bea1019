#include "rad_parser/primitive.h"

#include <algorithm>
#include <array>

#include "rad_parser/nearest_name.h"

namespace rad {
namespace {

constexpr std::array<std::string_view, kTypes> kNames = {
    "source",     "sphere",     "bubble",   "polygon",   "cone",       "cup",        "cylinder",
    "tube",       "ring",       "instance", "mesh",      "light",      "illum",      "glow",
    "spotlight",  "mirror",     "prism1",   "prism2",    "mist",       "plastic",    "metal",
    "trans",      "plastic2",   "metal2",   "trans2",    "ashik2",     "dielectric", "interface",
    "glass",      "plasfunc",   "metfunc",  "transfunc", "BRTDfunc",   "plasdata",   "metdata",
    "transdata",  "BSDF",       "aBSDF",    "WGMDfunc",  "antimatter", "texfunc",    "texdata",
    "colorfunc",  "brightfunc", "specfunc", "colordata", "brightdata", "specdata",   "colorpict",
    "brighttext", "colortext",  "spectrum", "specfile",  "specpict",   "mixfunc",    "mixdata",
    "mixpict",    "mixtext",    "alias"};

struct NamedType {
  std::string_view name;
  Type type = Type::alias;
};

constexpr auto kByName = [] {
  std::array<NamedType, kTypes> sorted;
  for (int i = 0; i < kTypes; ++i) sorted[i] = {kNames[i], static_cast<Type>(i)};
  std::ranges::sort(sorted, {}, &NamedType::name);
  return sorted;
}();

}  // namespace

std::string_view typeName(Type type) { return kNames[static_cast<size_t>(type)]; }

bool findType(std::string_view name, Type& type) {
  const auto at = std::ranges::lower_bound(kByName, name, {}, &NamedType::name);
  if (at == kByName.end() || at->name != name) return false;
  type = at->type;
  return true;
}

std::string nearestType(std::string_view name) {
  NearestName nearest(name);
  for (const std::string_view type : kNames) nearest.consider(type);
  return nearest.hint();
}

}  // namespace rad
