#include "points/quantities.h"

#include <algorithm>
#include <iterator>

#include "base/constants.h"

namespace rsphere {
namespace {

using Form = PointQuantity::Form;
using Add = const PointQuantity::Add&;

using A = const PointAnswer&;
using O = const SphereOptions&;

template <std::vector<PointAnswer::OwnError> PointAnswer::*errors>
void addAll(A a, O, Add add) {
  for (const PointAnswer::OwnError& error : a.*errors) add(error.channels.color, error.brightness);
}

template <Kernels::Quantity first, size_t count = 1>
void addSome(A a, O, Add add) {
  for (size_t i = first; i < first + count; ++i)
    add(a.quantityErrors[i].channels.color, a.quantityErrors[i].brightness);
}

// F and L: see the manual.
constexpr PointQuantity kQuantities[] = {
    {'o', "point", Form::place, 3, "the point", ""},
    {'v', "mean_radiance", Form::colors, 1, "mean radiance: F / (4 pi)", "W/sr/m2",
     [](A a, O, Add add) { add(a.mean.color, 0); }},
    {'e', "standard_error", Form::errors, 1,
     "standard error of the quantity before it, estimated\n(-pRGB or -pY); of v after none, o and k", "",
     [](A a, O, Add add) { add(a.standardError.color, a.brightnessError); }, 'v'},
    {'E', "scalar_irradiance", Form::colors, 1, "mean spherical (scalar) irradiance: F / 4", "W/m2",
     [](A a, O, Add add) { add(a.scalarIrradiance.color, 0); }},
    {'C', "cylindrical_irradiance", Form::colors, 1,
     "mean cylindrical irradiance about the z axis:\n(1/pi) integral of L sin(angle between d and z)", "W/m2",
     [](A a, O, Add add) { add(a.cylindricalIrradiance.color, 0); }},
    {'S', "semicylindrical_irradiance", Form::colors, 1,
     "semi-cylindrical irradiance towards -So: (1/pi)\nintegral of L sin(angle between d and z)\n"
     "(1 + cos(azimuth between d and -So))",
     "W/m2", [](A a, O o, Add add) { add(a.semicylindricalIrradiance(o.facing()).color, 0); }},
    {'h', "hemispherical_irradiance", Form::colors, 1,
     "hemispherical irradiance from above: (1/4)\nintegral of L (1 + cos(angle between d and z))", "W/m2",
     [](A a, O, Add add) { add(a.hemisphericalIrradiance().color, 0); }},
    {'H', "six_irradiances", Form::colors, 6,
     "irradiances of faces towards +x -x +y -y +z -z,\neach the integral of L max(0, d.n)", "W/m2",
     [](A a, O, Add add) {
       for (const Irradiance& face : a.facing) add(face.color, 0);
     }},
    {'u', "light_vector", Form::vector, 3,
     "light vector: integral of d times the brightness\nof L, towards the side of more light", "W/m2"},
    {'k', "directions", Form::count, 1, "number of directions used", ""},
    {'z', "zones", Form::colors, PointQuantity::kOfZones, "mean radiances of the N zones of -Sz, in turn",
     "W/sr/m2",
     [](A a, O, Add add) {
       for (const Radiance& zone : a.zones) add(zone.color, 0);
     }},
    {'Z', "zone_errors", Form::errors, PointQuantity::kOfZones,
     "standard errors of z, estimated (-pRGB or -pY)", "W/sr/m2", addAll<&PointAnswer::zoneErrors>, 'z'},
    {'e', "standard_error", Form::errors, PointQuantity::kOfZones, "", "", addAll<&PointAnswer::zoneErrors>,
     'z'},
    {'e', "standard_error", Form::errors, 1, "", "",
     [](A a, O, Add add) { add(a.standardError.color * kPi, a.brightnessError * kPi); }, 'E'},
    {'e', "standard_error", Form::errors, 1, "", "", addSome<Kernels::cylindrical>, 'C',
     Kernels::cylindrical},
    {'e', "standard_error", Form::errors, 1, "", "", addSome<Kernels::semicylindrical>, 'S',
     Kernels::semicylindrical},
    {'e', "standard_error", Form::errors, 1, "", "", addSome<Kernels::hemispherical>, 'h',
     Kernels::hemispherical},
    {'e', "standard_error", Form::errors, 6, "", "", addSome<Kernels::faces, 6>, 'H', Kernels::faces},
    {'e', "standard_error", Form::vectorErrors, 3, "", "", nullptr, 'u', Kernels::vector},
};

// The error of the quantity with this letter; null: it has none.
const PointQuantity* errorOf(char letter) {
  const auto* const found = std::find_if(std::begin(kQuantities), std::end(kQuantities),
                                         [&](const auto& q) { return q.letter == 'e' && q.of == letter; });
  return found == std::end(kQuantities) ? nullptr : found;
}

}  // namespace

std::span<const PointQuantity> pointQuantities() { return kQuantities; }

std::vector<const PointQuantity*> pointQuantities(std::string_view letters) {
  std::vector<const PointQuantity*> all;
  char before = 'v';
  for (const char letter : letters) {
    const PointQuantity* const error = letter == 'e' ? errorOf(before) : nullptr;
    all.push_back(error ? error : pointQuantity(letter));
    if (letter != 'e') before = letter;
  }
  return all;
}

const PointQuantity* pointQuantity(char letter) {
  const auto* const found = std::find_if(std::begin(kQuantities), std::end(kQuantities),
                                         [&](const PointQuantity& q) { return q.letter == letter; });
  return found == std::end(kQuantities) ? nullptr : found;
}

bool haveErrors(std::string_view letters) {
  return std::ranges::any_of(letters, [](char letter) {
    const PointQuantity* const quantity = pointQuantity(letter);
    return quantity && quantity->isError();
  });
}

Kernels::Some ownErrors(std::string_view letters) {
  Kernels::Some some;
  for (const PointQuantity* const q : pointQuantities(letters))
    if (q && q->kernel < Kernels::kQuantities)
      for (int i = 0; i < q->values; ++i) some.set(q->kernel + static_cast<size_t>(i));
  return some;
}

}  // namespace rsphere
