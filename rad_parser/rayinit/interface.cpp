#include "rad_parser/rayinit/interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "rad_parser/error.h"
#include "rad_parser/rayinit/prism_panel.h"

namespace rad::calc {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

uint64_t bits(std::initializer_list<Input> inputs) {
  uint64_t mask = 0;
  for (Input i : inputs) mask |= uint64_t{1} << i;
  return mask;
}

int kindOf(double x) { return x > -.5 && x < 1000 ? static_cast<int>(x + .5) : -1; }

double real(const Point& point, size_t n, const char* function) {
  if (n > point.reals.size()) throw Error(fmt::format("{}(): missing real argument {}", function, n));
  return point.reals[n - 1];
}

// The projected area of a box with sides x, y and z, seen along a direction.
double projectedArea(const double* direction, double x, double y, double z) {
  return std::abs(direction[0]) * y * z + std::abs(direction[1]) * x * z + std::abs(direction[2]) * x * y;
}

// Converts luminous intensity to radiance: value (times the first real argument if there are at least two),
// divided by the projected area of the luminaire. kind is
//   0  no luminaire: the value as it is
//   1  a flat luminaire
//   2  a box, with real arguments 2 to 4 as its sides
//   3  a box seen from nearby, with the arguments of kind 2
//   4  an upright cylinder, with real arguments 2 and 3 as its diameter and height
// Source: the functions corr, flatcorr, boxcorr, lboxcorr and cylcorr of rayinit.cal and source.cal.
double sourceCorrection(const Point& point, std::span<const double> arguments) {
  constexpr const char* name = "source_corr";
  double value = arguments[0];
  if (point.reals.size() > 1) value *= point.reals[0];
  if (!(value > 0)) return 0;
  const auto side = [&](size_t n) { return real(point, n, name); };
  const double* d = point.inputs.data() + Dx;
  switch (kindOf(arguments[1])) {
    case 0: return value;
    case 1: return value / point.inputs[Rdot];
    case 2: return value / projectedArea(d, side(2), side(3), side(4));
    case 3: {
      // Each side that faces the start of the ray contributes its area, times the distance of the start from
      // its plane.
      const double distance = point.inputs[Ts];
      const double x = side(2), y = side(3), z = side(4);
      const auto beyond = [&](int axis, double length) {
        const double start = point.inputs[Px + static_cast<uint32_t>(axis)] - d[axis] * distance;
        return std::max(std::abs(start) - length / 2, 0.);
      };
      return value * distance / (beyond(0, x) * y * z + beyond(1, y) * x * z + beyond(2, z) * x * y);
    }
    case 4: {
      const double diameter = side(2), height = side(3);
      const double cosine = std::min(d[2], 1 - 1e-6);
      const double disk = std::numbers::pi / 4 * diameter * diameter;
      return value / (diameter * height * std::sqrt(1 - cosine * cosine) + disk * std::abs(cosine));
    }
    default: throw Error(fmt::format("{}(): the second argument must be 0, 1, 2, 3 or 4", name));
  }
}

// The angle between -z and the reversed ray direction, in degrees.
double sourceTheta(const Point& point, std::span<const double>) {
  return kDegrees * std::acos(std::clamp(point.inputs[Dz], -1., 1.));
}

// The azimuth in degrees, reduced by the symmetry of the photometry: 360 for none, 180 for bilateral
// symmetry, 90 for symmetry of all quadrants.
double sourcePhi(const Point& point, std::span<const double> arguments) {
  double angle = kDegrees * std::atan2(-point.inputs[Dy], -point.inputs[Dx]);
  if (angle < 0) angle += 360;
  switch (kindOf(arguments[0])) {
    case 360: return angle;
    case 180: return angle < 180 ? angle : 360 - angle;
    case 90:
      if (angle >= 180) angle -= 180;
      return angle < 90 ? angle : 180 - angle;
    default: throw Error("source_phi(): the argument must be 90, 180 or 360");
  }
}

// The prism panel described by the real arguments, as in fprism.cal. The third, the panel's thickness, has no
// effect.
PrismPanel panelOf(const Point& point, const char* function) {
  const auto argument = [&](size_t n) { return real(point, n, function); };
  PrismPanel panel;
  panel.a = argument(1);
  panel.b = argument(2);
  panel.height = argument(4);
  panel.index = argument(5);
  panel.threshold = argument(6);
  const int coated = kindOf(argument(7));
  panel.coated = coated == 1   ? PrismPanel::Coated::upper
                 : coated == 2 ? PrismPanel::Coated::lower
                               : PrismPanel::Coated::nothing;
  panel.coating = coated == 4 ? 0 : argument(8);
  panel.tolerance = argument(9);
  const double aim = argument(10);
  const bool isPanel = panel.a >= 0 && panel.b >= 0 && panel.a + panel.b > 0 && panel.height > 0 &&
                       panel.index >= 1 && panel.threshold >= 0 && panel.threshold < 1 &&
                       (coated == 1 || coated == 2 || coated == 4) && panel.coating >= 0 &&
                       panel.coating <= 1 && panel.tolerance > 0 && aim >= 0;
  if (!isPanel) throw Error(fmt::format("{}(): the real arguments do not describe a prism panel", function));
  return panel;
}

// One of the directions in which a prism panel emits the light that arrives along the ray. Arguments:
//   value  0, 1, 2: x, y or z of the direction; 3: its share of the light
//   which  .5 or more: only light that passes through the panel; -1.5 or less: only returned light; else all
//   rank   1 for the strongest direction, 2 for the second
// If the ray is aimed at a light source, directions that miss it by more than real argument 10 (radians about
// z) have the share 0, and rank 2 also means the strongest one. If there are fewer directions than `rank`,
// the direction is (1, 0, 0) with share 0. Source: output of rtrace.
double fprismValue(const Point& point, std::span<const double> arguments) {
  constexpr const char* name = "fprism_val";
  const PrismPanel panel = panelOf(point, name);
  const double aim = real(point, 10, name);
  const auto in = [&](Input first) {
    return Imath::V3d(point.inputs[first], point.inputs[first + 1], point.inputs[first + 2]);
  };
  const Imath::V3d direction = in(Dx), target = in(DxA);
  const auto whole = [&](size_t n) {
    return static_cast<int>(std::trunc(std::clamp(arguments[n], -1e6, 1e6) + .5));
  };
  const int value = whole(0), which = whole(1);
  if (value < 0 || value > 3) throw Error(fmt::format("{}(): the first argument must be 0, 1, 2 or 3", name));
  PanelRays found;
  if (direction.x != 0) found = raysThrough(panel, direction.normalized());
  int rank = whole(2);
  const auto angle = [](const Imath::V3d& v) { return std::atan2(v.y, v.x); };
  if (target.length2() > 0) {
    if (rank == 2) rank = 1;
    for (PanelRay& ray : found.all()) {
      if (std::abs(angle(ray.direction) - angle(target)) > aim) ray.share = 0;
    }
  }
  std::stable_sort(found.all().begin(), found.all().end(),
                   [](const PanelRay& r, const PanelRay& s) { return r.share > s.share; });
  const double side = direction.x < 0 ? -which : which;
  for (const PanelRay& ray : found.all()) {
    if (ray.direction.x * side < 0 || --rank != 0) continue;
    return value == 3 ? ray.share : ray.direction[value];
  }
  return value == 0 && direction.x != 0 ? 1 : 0;
}

}  // namespace

Interface sceneInterface(const FileAccess& access) {
  Interface i;
  i.inputs = {"Dx", "Dy",  "Dz",  "Nx",  "Ny",    "Nz",  "Px",  "Py",  "Pz",  "T",   "Rdot", "S",  "Tx",
              "Ty", "Tz",  "Ix",  "Iy",  "Iz",    "Jx",  "Jy",  "Jz",  "Kx",  "Ky",  "Kz",   "Ts", "Lu",
              "Lv", "NxP", "NyP", "NzP", "RdotP", "CrP", "CgP", "CbP", "DxA", "DyA", "DzA"};
  i.hosts = {{"source_corr", 2, bits({Dx, Dy, Dz, Px, Py, Pz, Rdot, Ts}), sourceCorrection},
             {"source_theta", 1, bits({Dz}), sourceTheta},
             {"source_phi", 1, bits({Dx, Dy}), sourcePhi},
             {"fprism_val", 3, bits({Dx, Dy, Dz, DxA, DyA, DzA}), fprismValue}};
  i.preludeName = "rayinit.cal";
  i.preludeText = *builtInFile(i.preludeName);
  i.searched = [access](std::string_view file, bool inScene) { return access.remark(file, inScene); };
  return i;
}

}  // namespace rad::calc
