#include "answer/column_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "points/quantities.h"
#include "records/output_colors.h"

namespace rsphere {
namespace {

// The names of the -o letters of rays and directions in -defaults; rtrace has none for c. For letters of
// points: points/quantities.h.
struct LetterName {
  char letter;
  std::string_view name;
};
constexpr LetterName kLetterNames[] = {{'t', "trace"},
                                       {'o', "origin"},
                                       {'d', "direction"},
                                       {'r', "reflect_contrib"},
                                       {'R', "reflect_length"},
                                       {'x', "unreflect_contrib"},
                                       {'X', "unreflect_length"},
                                       {'v', "value"},
                                       {'e', "standard_error"},
                                       {'V', "contribution"},
                                       {'l', "length"},
                                       {'L', "first_length"},
                                       {'p', "point"},
                                       {'n', "normal"},
                                       {'N', "unperturbed_normal"},
                                       {'s', "surface"},
                                       {'w', "weight"},
                                       {'W', "coefficient"},
                                       {'m', "modifier"},
                                       {'M', "material"},
                                       {'~', "tilde"},
                                       {'i', "record"}};

// Different names with -Su.
constexpr LetterName kGlareLetterNames[] = {{'o', "eye"},
                                            {'d', "gaze"},
                                            {'u', "UGR"},
                                            {'v', "illuminance"},
                                            {'b', "background"},
                                            {'g', "DGP"},
                                            {'U', "UGR_error"},
                                            {'V', "illuminance_error"},
                                            {'B', "background_error"},
                                            {'G', "DGP_error"},
                                            {'n', "glare_sources"},
                                            {'t', "threshold"}};
// Names for the list of glare sources (-Su -Sd).
constexpr LetterName kSourceLetterNames[] = {
    {'o', "eye"},         {'l', "luminance"},         {'L', "luminance_error"},
    {'w', "solid_angle"}, {'W', "solid_angle_error"}, {'p', "position_index"}};

std::string_view nameIn(std::span<const LetterName> names, char letter) {
  for (const LetterName& known : names)
    if (known.letter == letter) return known.name;
  return "";
}

using Suffixes = std::vector<std::string>;

const Suffixes kSingle{""}, kAxes{"_x", "_y", "_z"}, kFaces{"_+x", "_-x", "_+y", "_-y", "_+z", "_-z"};

Suffixes numbered(int count) {
  Suffixes all;
  for (int i = 1; i <= count; ++i) all.push_back(fmt::format("_{}", i));
  return all;
}

Suffixes ofColors(const ColorOptions& color) {
  const int count = OutputColors(color).count();
  if (count == 1) return kSingle;
  if (color.space == ColorSpace::rgb) return {"_r", "_g", "_b"};
  if (color.space == ColorSpace::xyz) return {"_X", "_Y", "_Z"};
  return numbered(count);
}

// The suffixes of a ray's or a direction's letter.
Suffixes suffixesOf(char letter, const AnswerOptions& options) {
  if (letter == '~') return {};
  const bool glare = options.sphereMode && options.sphere.glare.wanted;
  if (std::string_view(glare ? "od" : "odpnN").find(letter) != std::string_view::npos) return kAxes;
  if (letter == 'c' && !glare) return {"_u", "_v"};
  const bool color = !glare && std::string_view("veVrxW").find(letter) != std::string_view::npos;
  return color ? ofColors(options.color) : kSingle;
}

}  // namespace

std::string_view letterName(char letter, const AnswerOptions& options) {
  if (options.sphereMode && options.sphere.glare.wanted) {
    const auto name = options.sphere.everyDirection ? nameIn(kSourceLetterNames, letter)
                                                    : nameIn(kGlareLetterNames, letter);
    if (!name.empty()) return name;
  }
  if (options.sphereMode && !options.sphere.everyDirection)
    if (const PointQuantity* const quantity = pointQuantity(letter)) return quantity->name;
  return nameIn(kLetterNames, letter);
}

std::vector<std::vector<std::string>> columnNames(const AnswerOptions& options) {
  std::vector<std::vector<std::string>> names;
  const auto add = [&](std::string_view name, const Suffixes& first, const Suffixes& second, bool ofParts) {
    const size_t parts = ofParts ? options.contributors.size() : 0;
    names.emplace_back();
    for (size_t part = 0; part < std::max<size_t>(1, parts); ++part)
      for (const std::string& a : first)
        for (const std::string& b : second)
          names.back().push_back(
              fmt::format("{}{}{}{}", name, a, b, parts > 0 ? fmt::format(".{}", part + 1) : ""));
  };
  const bool points = options.sphereMode && !options.sphere.everyDirection && !options.sphere.glare.wanted;
  if (!points) {
    for (const char letter : options.outputs) {
      const std::string_view name = letterName(letter, options);
      const bool ofParts = std::string_view("veVrx").find(letter) != std::string_view::npos;
      add(name.empty() ? "local" : name, kSingle, suffixesOf(letter, options), ofParts);
    }
    return names;
  }
  for (const PointQuantity* const quantity : pointQuantities(options.outputs)) {
    using Form = PointQuantity::Form;
    const Form form = quantity->form;
    const std::string name = quantity->isError() ? fmt::format("{}_error", pointQuantity(quantity->of)->name)
                                                 : std::string(quantity->name);
    if (form == Form::colors || form == Form::errors)
      add(name,
          quantity->values == PointQuantity::kOfZones ? numbered(options.sphere.zones)
          : quantity->values == 6                     ? kFaces
                                                      : kSingle,
          ofColors(options.color), true);
    else
      add(name, kSingle, form == Form::count ? kSingle : kAxes, form != Form::place && form != Form::count);
  }
  return names;
}

int componentCount(const AnswerOptions& options) {
  size_t count = 0;
  for (const auto& ofLetter : columnNames(options)) count += ofLetter.size();
  return static_cast<int>(count);
}

}  // namespace rsphere
