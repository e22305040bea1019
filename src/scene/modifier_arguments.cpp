#include "scene/modifier_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/constants.h"

namespace rsphere {
namespace {

using rad::Type;

// The number of string arguments before those that all kinds have: a mixture begins with two names.
size_t namesIn(const PrimitiveArguments& a) { return rad::isMixture(a.type()) ? 2 : 0; }
Mixed readMixed(const PrimitiveArguments& a) {
  if (namesIn(a) == 0) return {};
  return {a.string(0), a.string(1)};
}

// The function file that a string argument names. Its transform is among the arguments that follow.
FunctionFile readFunctionFile(const PrimitiveArguments& a, size_t at) {
  return {a.string(at), transformAmong(a.stringsFrom(at + 1))};
}

// The value of an expression if it is a number; otherwise the given bound.
double numberOr(std::string_view expression, double otherwise) {
  double value = 0;
  const char* const last = expression.data() + expression.size();
  const auto [end, error] = std::from_chars(expression.data(), last, value);
  return error == std::errc() && end == last ? value : otherwise;
}

bool allAre(const Words& words, std::string_view word) {
  return std::ranges::all_of(words, [&](std::string_view w) { return w == word; });
}

FunctionScatterer readScatterer(const PrimitiveArguments& a, size_t strings) {
  const bool trans = a.type() == Type::transfunc || a.type() == Type::transdata;
  a.needAtLeast(strings, trans ? 6 : 4);
  const auto r = a.reals();
  FunctionScatterer values{a.color(0), r[3], a.type() == Type::metfunc || a.type() == Type::metdata};
  if (trans) {
    values.transmissivity = r[4];
    values.transmittedSpecular = r[5];
  }
  return values;
}

}  // namespace

// ---- patterns, textures and mixtures

FunctionArguments readFunction(const PrimitiveArguments& a) {
  const size_t first = namesIn(a), count = a.type() == Type::brightfunc || a.type() == Type::mixfunc ? 1 : 3;
  a.needAtLeast(first + count + 1);
  return {readMixed(a), a.strings(first, count), readFunctionFile(a, first + count)};
}

DataArguments readData(const PrimitiveArguments& a) {
  const bool single = a.type() == Type::brightdata || a.type() == Type::mixdata || a.type() == Type::specdata;
  const size_t first = namesIn(a), count = single ? 1 : 3;
  const size_t file = first + 2 * count;
  a.needAtLeast(file + 2);
  return {readMixed(a), a.strings(first, count), a.strings(first + count, count), a.string(file),
          a.stringsFrom(file + 1)};
}

PictureArguments readPicture(const PrimitiveArguments& a) {
  const bool single = a.type() == Type::mixpict || a.type() == Type::specpict;
  const size_t first = namesIn(a), picture = first + (single ? 1 : 3);
  a.needAtLeast(picture + 4);
  return {readMixed(a),
          a.strings(first, picture - first),
          a.string(picture),
          a.strings(picture + 2, 2),
          {a.string(picture + 1), transformAmong(a.stringsFrom(picture + 4))}};
}

TextArguments readText(const PrimitiveArguments& a) {
  const size_t first = namesIn(a);
  const size_t channels = a.type() == Type::mixtext ? 0 : a.type() == Type::brighttext ? 1 : 3;
  const size_t end = 9 + 2 * channels;
  a.needAtLeast(first + 2, end);
  TextArguments text{readMixed(a), a.string(first), a.string(first + 1), a.stringsFrom(first + 2),
                     a.vector(0),  a.vector(3),     a.vector(6)};
  const auto reals = a.reals();
  for (size_t i = 0; i < channels; ++i) {
    text.foreground.push_back(reals[9 + i]);
    text.background.push_back(reals[9 + channels + i]);
  }
  if (reals.size() > end) text.spacing = reals[end];
  return text;
}

SpectrumArguments readSpectrum(const PrimitiveArguments& a) {
  a.needAtLeast(0, 5);
  const auto r = a.reals();
  if (r[0] == r[1]) a.fail("the wavelengths of the first and the last value must differ");
  return {r[0], r[1], {r.begin() + 2, r.end()}};
}

SpectrumFileArguments readSpectrumFile(const PrimitiveArguments& a) {
  a.needAtLeast(1);
  a.needAtMostStrings(1);
  return {a.string(0)};
}

SpectralFunctionArguments readSpectralFunction(const PrimitiveArguments& a) {
  a.needAtLeast(2, 2);
  const auto r = a.reals();
  if (r[0] == r[1]) a.fail("the limits of the wavelength must differ");
  return {a.string(0), readFunctionFile(a, 1), std::min(r[0], r[1]), std::max(r[0], r[1])};
}

// ---- materials without functions

Opaque readOpaque(const PrimitiveArguments& a) {
  a.needReals(5);
  return {a.color(0), a.reals()[3], a.reals()[4], a.type() == Type::metal};
}

Trans readTrans(const PrimitiveArguments& a) {
  a.needReals(7);
  const auto r = a.reals();
  return {a.color(0), r[3], r[4], r[5], r[6]};
}

Dielectric readDielectric(const PrimitiveArguments& a) {
  a.needReals(5);
  const auto r = a.reals();
  if (!(r[3] > 0)) a.fail("refractive index must be above 0");
  return {a.color(0), r[3], r[4]};
}

Interface readInterface(const PrimitiveArguments& a) {
  a.needReals(8);
  const auto r = a.reals();
  if (!(r[3] > 0 && r[7] > 0)) a.fail("refractive index must be above 0");
  return {a.color(0), r[3], a.color(4), r[7]};
}

Glass readGlass(const PrimitiveArguments& a) {
  const auto r = a.reals();
  if (r.size() != 3 && r.size() != 4) a.fail(fmt::format("expected 3 or 4 real arguments, got {}", r.size()));
  if (r.size() == 4 && !(r[3] >= 1)) a.fail("refractive index must be at least 1");
  return {a.color(0), r.size() == 4 ? r[3] : Glass{}.refraction};
}

Mist readMist(const PrimitiveArguments& a) {
  const auto r = a.reals();
  if (r.size() > 7) a.fail(fmt::format("expected at most 7 real arguments, got {}", r.size()));
  if (a.strings() > 32) a.fail(fmt::format("expected at most 32 light sources, got {}", a.strings()));
  Mist mist;
  if (r.size() > 2) mist.extinction = a.color(0);
  mist.hasAlbedo = r.size() > 5;
  if (mist.hasAlbedo) mist.albedo = a.color(3);
  mist.hasEccentricity = r.size() > 6;
  if (mist.hasEccentricity) mist.eccentricity = r[6];
  for (const std::string_view source : a.stringsFrom(0)) mist.sources.emplace_back(source);
  return mist;
}

Light readLight(const PrimitiveArguments& a) {
  a.needReals(3);
  return {a.color(0)};
}

Glow readGlow(const PrimitiveArguments& a) {
  a.needReals(4);
  return {a.color(0), a.reals()[3]};
}

Spotlight readSpotlight(const PrimitiveArguments& a) {
  a.needReals(7);
  const auto r = a.reals();
  if (!(r[3] > 0)) a.fail("zero angle");
  const V3d aim = a.vector(4);
  const double length = aim.length();
  if (!(length > 0)) a.fail("zero focus vector");
  return {a.color(0), coneSolidAngle(r[3]), aim / length, length};
}

AlternatingArguments readAlternating(const PrimitiveArguments& a) {
  a.needReals(3);
  a.needAtMostStrings(1);
  return {a.color(0), a.strings() ? std::optional(a.string(0)) : std::nullopt};
}

Words readAntimatter(const PrimitiveArguments& a) {
  a.needAtLeast(1);
  return a.stringsFrom(0);
}

// ---- materials with functions

AnisotropicArguments readAnisotropic(const PrimitiveArguments& a) {
  const bool trans = a.type() == Type::trans2;
  a.needReals(trans ? 8 : 6);
  a.needAtLeast(4);
  const auto r = a.reals();
  if (!(r[4] > kNegligible && r[5] > kNegligible)) a.fail("roughness too small");
  Anisotropic values{a.color(0), r[3], r[4], r[5], a.type() == Type::metal2, trans};
  if (trans) {
    values.transmissivity = r[6];
    values.transmittedSpecular = r[7];
  }
  return {values, {a.strings(0, 3), readFunctionFile(a, 3)}};
}

AshikhminArguments readAshikhmin(const PrimitiveArguments& a) {
  a.needReals(8);
  a.needAtLeast(4);
  const auto r = a.reals();
  if (!(r[6] > -1 && r[7] > -1)) a.fail("specular powers must be above -1");
  return {{a.color(0), a.color(3), r[6], r[7]}, {a.strings(0, 3), readFunctionFile(a, 3)}};
}

FunctionScattererArguments readFunctionScatterer(const PrimitiveArguments& a) {
  const FunctionScatterer values = readScatterer(a, 2);
  return {values, a.string(0), readFunctionFile(a, 1)};
}

DataScattererArguments readDataScatterer(const PrimitiveArguments& a) {
  const FunctionScatterer values = readScatterer(a, 4);
  return {values, a.string(0), a.string(1), readFunctionFile(a, 2), a.stringsFrom(3)};
}

BrtdArguments readBrtd(const PrimitiveArguments& a) {
  a.needAtLeast(10, 9);
  BrtdArguments made{{}, a.strings(0, 3), a.strings(3, 3), a.strings(6, 3), readFunctionFile(a, 9)};
  const auto most = [](const Words& w) {
    return std::max({numberOr(w[0], 1), numberOr(w[1], 1), numberOr(w[2], 1)});
  };
  made.values = {a.color(0),
                 a.color(3),
                 a.color(6),
                 !allAre(made.transmission, "0"),
                 !allAre(made.distribution, "0"),
                 most(made.reflection),
                 most(made.transmission)};
  return made;
}

WgmdArguments readWgmd(const PrimitiveArguments& a) {
  a.needAtLeast(13, 9);
  WgmdArguments made{{},
                     {a.string(0), a.strings(1, 3)},
                     {a.string(4), a.strings(5, 3)},
                     a.string(8),
                     {a.strings(9, 3), readFunctionFile(a, 12)}};
  const auto lobe = [](const Words& w) {
    return WgmdFunction::Lobe{numberOr(w[0], 1), numberOr(w[1], 0), numberOr(w[2], 0), {}};
  };
  WgmdFunction& values = made.values;
  values.diffuseFront = a.color(0);
  values.diffuseBack = a.color(3);
  values.diffuseTransmitted = a.color(6);
  values.reflected = lobe(made.reflected.shape);
  values.transmitted = lobe(made.transmitted.shape);
  values.transmits = made.transmitted.shape[0] != "0";
  return made;
}

BsdfArguments readBsdf(const PrimitiveArguments& a) {
  const bool aperture = a.type() == Type::absdf;
  const size_t data = aperture ? 0 : 1;
  a.needAtLeast(data + 5);
  const size_t count = a.reals().size();
  if (count > 9 || count % 3) a.fail(fmt::format("expected 0, 3, 6 or 9 real arguments, got {}", count));
  BsdfArguments made;
  if (!aperture) made.thickness = a.string(0);
  made.data = a.string(data);
  made.up = {a.strings(data + 1, 3), readFunctionFile(a, data + 4)};
  made.values.aperture = aperture;
  made.values.proxy = made.thickness && *made.thickness != "0";
  if (count >= 3) made.values.diffuseFront = a.color(0);
  if (count >= 6) made.values.diffuseBack = a.color(3);
  if (count >= 9) made.values.diffuseTransmitted = a.color(6);
  return made;
}

PrismArguments readPrism(const PrimitiveArguments& a) {
  const size_t images = a.type() == Type::prism1 ? 1 : 2;
  a.needAtLeast(4 * images + 1);
  PrismArguments made;
  for (size_t i = 0; i < images; ++i) made.images.push_back(a.strings(4 * i, 4));
  made.file = readFunctionFile(a, 4 * images);
  return made;
}

}  // namespace rsphere
