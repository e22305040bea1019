#include "rad_parser/binary/binary_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "rad_parser/number.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

// Types by their numbers in the data. Empty for a type unknown to this program.
using TypeTable = std::vector<std::optional<Type>>;

constexpr int kEnd = 255;  // in place of a type number, it ends the primitives

TypeTable readTypes(BinaryReader& input, const Warn& warn) {
  TypeTable types;
  for (;;) {
    const std::string_view name = input.string();
    if (name.empty()) return types;
    if (types.size() == kEnd) throw input.fault("too many types");
    Type type;
    if (findType(name, type)) {
      types.emplace_back(type);
    } else {
      types.emplace_back();
      if (warn)
        warn(fmt::format("{}: unknown type \"{}\"", printable(input.name(), kLongestName), printable(name)));
    }
  }
}

void readAlias(BinaryReader& input, Primitive& p, PrimitiveId modifier, DescriptionBuilder& builder) {
  const Description& d = builder.description();
  if (p.strings == 0) {
    if (modifier == kVoid) throw input.fault("an alias of nothing");
    builder.addString(p, d.primitives[modifier].name);
    return builder.resolveAlias(p, modifier, true);
  }
  const PrimitiveId reference = builder.modifier(d.string(p, 0));
  if (reference == kVoid)
    throw input.fault(fmt::format("undefined modifier \"{}\"", printable(d.string(p, 0))));
  builder.resolveAlias(p, reference, false);
}

}  // namespace

int readIndexWidth(BinaryReader& input, int magic, std::string_view otherFormat) {
  const int64_t width = input.integer(2) - magic;
  if (width < 1 || width > 8)
    throw otherFormat.empty() ? input.fault("incompatible format") : input.otherFormat(otherFormat);
  return static_cast<int>(width);
}

Cube readCube(BinaryReader& input) {
  const auto number = [&] {
    const std::optional<double> value = parseReal(input.string());
    if (!value) throw input.fault("damaged bounds");
    return *value;
  };
  Cube cube;
  for (double& x : cube.origin) x = number();
  cube.size = number();
  for (const double x : cube.origin)
    if (cube.size < 0 || !std::isfinite(x + cube.size)) throw input.fault("damaged bounds");
  return cube;
}

int64_t readPrimitives(BinaryReader& input, int width, uint32_t file, DescriptionBuilder& builder,
                       const Warn& warn) {
  Description& d = builder.description();
  const TypeTable types = readTypes(input, warn);
  for (int64_t n = 0;; ++n) {
    const int typeNumber = input.byte();
    if (typeNumber == kEnd) return n;
    const Place place{file, static_cast<uint32_t>(n + 1)};
    const auto damaged = [&](std::string_view what) {
      return Error(fmt::format("{}: {} (byte {})", d.at(place), what, input.offset()));
    };
    if (typeNumber >= static_cast<int>(types.size()))
      throw damaged(fmt::format("unknown type number {}", typeNumber));
    if (!types[typeNumber]) throw damaged("unknown type");
    const Type type = *types[typeNumber];
    const int64_t number = input.integer(width);  // -1: void
    if (number < -1 || number >= n) throw damaged(fmt::format("modifier {} does not precede it", number + 1));
    const PrimitiveId modifier(number);
    if (modifier != kVoid && d.primitives.isSurface(modifier))
      throw damaged(fmt::format("object {} is not a modifier", number + 1));
    const std::string_view name = input.string();
    if (!isSurface(type) && (name == "void" || name == "inherit"))
      throw damaged(fmt::format("no modifier can be named \"{}\"", name));
    Primitive p = builder.begin(type, place, name, modifier);
    for (uint32_t strings = input.count16(); strings > 0; --strings) builder.addString(p, input.string());
    for (uint32_t reals = input.count16(); reals > 0; --reals) builder.addReal(p, input.real());
    if (type == Type::alias) readAlias(input, p, modifier, builder);
    builder.add(p);
  }
}

}  // namespace rad
