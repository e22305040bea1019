#include "rad_parser/description_builder.h"

#include <fmt/format.h>

#include <algorithm>

#include "rad_parser/nearest_name.h"

namespace rad {

uint32_t DescriptionBuilder::addFile(std::string_view name, Place from) {
  description_.files.push_back({std::string(name), from});
  return static_cast<uint32_t>(description_.files.size() - 1);
}

uint32_t DescriptionBuilder::intern(std::string_view word) {
  if (const auto known = words_.find(word); known != words_.end()) return known->second;
  if (description_.words.size() == std::numeric_limits<uint32_t>::max())
    throw Error("too many different words");
  const auto index = static_cast<uint32_t>(description_.words.size());
  words_.emplace(description_.words.emplace_back(word), index);
  return index;
}

PrimitiveId DescriptionBuilder::modifier(std::string_view name) const {
  const auto word = words_.find(name);
  return word != words_.end() && word->second < inForce_.size() ? inForce_[word->second] : PrimitiveId();
}

std::string DescriptionBuilder::nearestModifier(std::string_view name) const {
  NearestName nearest(name);
  nearest.consider("void");
  for (const Primitive& p : description_.primitives)
    if (!isSurface(p.type)) nearest.consider(p.name);
  return nearest.hint();
}

Primitive DescriptionBuilder::begin(Type type, Place place, std::string_view name,
                                    PrimitiveId modifier) const {
  Primitive p;
  p.type = type;
  p.modifier = modifier;
  p.place = place;
  p.name = name;
  p.firstString = static_cast<uint32_t>(description_.stringArgs.size());
  p.firstReal = type == Type::polygon ? description_.vertices.size() : description_.realArgs.size();
  return p;
}

void DescriptionBuilder::addString(Primitive& p, std::string_view word) {
  if (description_.stringArgs.size() == std::numeric_limits<uint32_t>::max())
    throw error(p.place, "too many string arguments");
  description_.stringArgs.push_back(intern(word));
  ++p.strings;
}

void DescriptionBuilder::resolveAlias(Primitive& p, PrimitiveId reference, bool inherit) const {
  const Primitive r = description_.primitives[reference];
  p.aliased = r.type == Type::alias ? r.aliased : reference;
  if (inherit) p.modifier = r.modifier;
}

void DescriptionBuilder::add(const Primitive& p) {
  if (description_.primitives.size() == std::numeric_limits<int32_t>::max())
    throw error(p.place, "too many primitives");
  description_.primitives.push_back(p);
  if (isSurface(p.type)) return;
  const uint32_t word = intern(p.name);
  if (word >= inForce_.size()) inForce_.resize(std::max<size_t>(word + 1, 2 * inForce_.size()));
  inForce_[word] = description_.primitives.last();
}

Error DescriptionBuilder::error(Place place, std::string_view text, Status status) const {
  return Error(fmt::format("{}: {}", description_.at(place), text), status);
}

}  // namespace rad
