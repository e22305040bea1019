#include "rad_parser/rayinit/interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rad_parser/file_path.h"
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

// The area that a box of these sides shows along a direction.
double shownArea(const double* direction, double x, double y, double z) {
  return std::abs(direction[0]) * y * z + std::abs(direction[1]) * x * z + std::abs(direction[2]) * x * y;
}

// Luminous intensity to radiance: value, times the first real argument where there are two, over the area
// that the luminaire shows. kind: 0 as it is; 1 flat; 2 box, its sides reals 2 to 4; 3 box, seen from nearby;
// 4 upright cylinder, reals 2 and 3 its diameter and height. Source: rayinit.cal's and source.cal's functions
// corr, flatcorr, boxcorr, lboxcorr, cylcorr.
double sourceCorrection(const Point& point, std::span<const double> arguments) {
  constexpr const char* name = "source_corr";
  double value = arguments[0];
  if (point.reals.size() > 1) value *= point.reals[0];
  if (!(value > 0)) return 0;
  const auto side = [&](size_t n) { return real(point, n, name); };
  const double* d = point.inputs.data() + Dx;
  switch (kindOf(arguments[1])) {
    case 0:
      return value;
    case 1:
      return value / point.inputs[Rdot];
    case 2:
      return value / shownArea(d, side(2), side(3), side(4));
    case 3: {
      // From the ray's start each side that faces it shows itself by how far the start is beyond it.
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
    default:
      throw Error(fmt::format("{}(): the second argument must be 0, 1, 2, 3 or 4", name));
  }
}

// Degrees from -z to the ray's direction reversed.
double sourceTheta(const Point& point, std::span<const double>) {
  return kDegrees * std::acos(std::clamp(point.inputs[Dz], -1., 1.));
}

// Degrees of azimuth, folded by the photometry's symmetry: 360 none, 180 bilateral, 90 of quadrants.
double sourcePhi(const Point& point, std::span<const double> arguments) {
  double angle = kDegrees * std::atan2(-point.inputs[Dy], -point.inputs[Dx]);
  if (angle < 0) angle += 360;
  switch (kindOf(arguments[0])) {
    case 360:
      return angle;
    case 180:
      return angle < 180 ? angle : 360 - angle;
    case 90:
      if (angle >= 180) angle -= 180;
      return angle < 90 ? angle : 180 - angle;
    default:
      throw Error("source_phi(): the argument must be 90, 180 or 360");
  }
}

// What leaves the prism panel that the real arguments describe (their meaning: fprism.cal), for light along
// the ray: of the rank-th strongest direction x, y, z (0, 1, 2) or the share (3). which: above .5, counted
// are those that go on, else all; below -1.5, those that come back. Where the ray is meant for a light
// source, what goes elsewhere counts nothing, and the second is the first. Too few directions: (1, 0, 0) and
// 0. Source: rtrace's answers.
double fprismValue(const Point& point, std::span<const double> arguments) {
  constexpr const char* name = "fprism_val";
  const auto argument = [&](size_t n) { return real(point, n, name); };
  PrismPanel panel;
  panel.a = argument(1);
  panel.b = argument(2);
  panel.height = argument(4);  // the third is its thickness, which changes nothing
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
  if (!isPanel) throw Error(fmt::format("{}(): the real arguments are no prism panel", name));
  const auto in = [&](Input first) {
    return Imath::V3d(point.inputs[first], point.inputs[first + 1], point.inputs[first + 2]);
  };
  const Imath::V3d direction = in(Dx), target = in(DxA);
  const auto whole = [&](size_t n) {
    return static_cast<int>(std::trunc(std::clamp(arguments[n], -1e6, 1e6) + .5));
  };
  const int what = whole(0), which = whole(1);
  if (what < 0 || what > 3) throw Error(fmt::format("{}(): the first argument must be 0, 1, 2 or 3", name));
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
    return what == 3 ? ray.share : ray.direction[what];
  }
  return what == 0 && direction.x != 0 ? 1 : 0;
}

}  // namespace

Interface sceneInterface() {
  Interface i;
  i.inputs = {"Dx", "Dy",  "Dz",  "Nx",  "Ny",    "Nz",  "Px",  "Py",  "Pz",  "T",   "Rdot", "S",  "Tx",
              "Ty", "Tz",  "Ix",  "Iy",  "Iz",    "Jx",  "Jy",  "Jz",  "Kx",  "Ky",  "Kz",   "Ts", "Lu",
              "Lv", "NxP", "NyP", "NzP", "RdotP", "CrP", "CgP", "CbP", "DxA", "DyA", "DzA"};
  i.hosts = {{"source_corr", 2, bits({Dx, Dy, Dz, Px, Py, Pz, Rdot, Ts}), sourceCorrection},
             {"source_theta", 1, bits({Dz}), sourceTheta},
             {"source_phi", 1, bits({Dx, Dy}), sourcePhi},
             {"fprism_val", 3, bits({Dx, Dy, Dz, DxA, DyA, DzA}), fprismValue}};
  i.preludeName = "rayinit.cal";
  i.preludeText = kRayinit;
  i.searched = [](std::string_view file) { return FileAccess().remark(file); };
  return i;
}

const std::string_view kRayinit = R"cal({
  Definitions that every function file may use. A condition holds where it is positive.
  Names that end in `own are for use in here.
}

{ The primitive's real arguments: their number, and the first ten }
AC = arg(0);
A1 = arg(1);  A2 = arg(2);  A3 = arg(3);  A4 = arg(4);  A5 = arg(5);
A6 = arg(6);  A7 = arg(7);  A8 = arg(8);  A9 = arg(9);  A10 = arg(10);

{ Vectors by index from 1, for functions that take a vector as a function }
D(i) = select(i, Dx, Dy, Dz);
N(i) = select(i, Nx, Ny, Nz);
P(i) = select(i, Px, Py, Pz);
noise3a(x, y, z) : noise3x(x, y, z);
noise3b(x, y, z) : noise3y(x, y, z);
noise3c(x, y, z) : noise3z(x, y, z);
noise3d(i, x, y, z) : select(i, noise3x(x, y, z), noise3y(x, y, z), noise3z(x, y, z));
dot(a, b) : a(1)*b(1) + a(2)*b(2) + a(3)*b(3);
minor`own(a, b, i, j) : a(i)*b(j) - a(j)*b(i);
cross(i, a, b) : select(i, minor`own(a, b, 2, 3), minor`own(a, b, 3, 1), minor`own(a, b, 1, 2));

{ Constants }
PI : 3.14159265358979323846;
DEGREE : PI / 180;
FTINY : 1e-7;

{ Conditions }
and(a, b) : if(a, b, a);
or(a, b) : if(a, a, b);
not(a) : if(a, -1, 1);
xor(a, b) : if(a, not(b), b);
inside(low, x, high) : and(x - low, high - x);

{ Arithmetic }
abs(x) : max(x, -x);
sgn(x) : if(x, 1, if(-x, -1, 0));
sq(x) : x * x;
bound(low, x, high) : if(low - x, low, if(x - high, high, x));
frac(x) : x - floor(x);
mod(n, d) : n - d*floor(n/d);
tri(n, d) : abs(d - mod(n - d, 2*d));
linterp(t, at0, at1) : (1 - t)*at0 + t*at1;

{ Library functions that have a value everywhere }
Acos(x) : acos(bound(-1, x, 1));
Asin(x) : asin(bound(-1, x, 1));
Atan2(y, x) : if(sq(x) + sq(y), atan2(y, x), 0);
Exp(x) : if(-100 - x, 0, exp(x));
Sqrt(x) : if(x, sqrt(x), 0);

{ Values and colours }
noop(v) : v;
noneg(v) : max(v, 0);
clip(v) : bound(0, v, 1);
red(r, g, b) : noneg(r);
green(r, g, b) : noneg(g);
blue(r, g, b) : noneg(b);
grey(r, g, b) : noneg(.265074126*r + .670114631*g + .064811243*b);
clip_r(r, g, b) : clip(r);
clip_g(r, g, b) : clip(g);
clip_b(r, g, b) : clip(b);
clipgrey(r, g, b) : min(1, grey(r, g, b));

{ Towards `far` with the square of a distance, there from 16 on }
fade(near, far, distance) : far + if(16 - distance, (near - far)/(1 + sq(distance)), 0);

{ Cubics over t from 0 to 1: by ends and slopes, by control points, by knots }
hermite(p0, p1, r0, r1, t) :
  p0*(1 + t*t*(2*t - 3)) + p1*t*t*(3 - 2*t) + r0*t*sq(1 - t) + r1*t*t*(t - 1);
bezier(a, b, c, d, t) :
  a*(1 - t)^3 + 3*b*t*sq(1 - t) + 3*c*t*t*(1 - t) + d*t^3;
bspline(a, b, c, d, t) :
  (a*(1 - t)^3 + b*(4 + t*t*(3*t - 6)) + c*(1 + t*(3 + t*(3 - 3*t))) + d*t^3) / 6;

{ Octaves of noise from scale s up to 1, and the direction in which their sum grows }
turbulence(x, y, z, s) :
  if(s - 1.01, 0, s*abs(noise3(x/s, y/s, z/s)) + turbulence(x, y, z, 2*s));
turbulencex(x, y, z, s) :
  if(s - 1.01, 0, sgn(noise3(x/s, y/s, z/s))*noise3x(x/s, y/s, z/s) + turbulencex(x, y, z, 2*s));
turbulencey(x, y, z, s) :
  if(s - 1.01, 0, sgn(noise3(x/s, y/s, z/s))*noise3y(x/s, y/s, z/s) + turbulencey(x, y, z, 2*s));
turbulencez(x, y, z, s) :
  if(s - 1.01, 0, sgn(noise3(x/s, y/s, z/s))*noise3z(x/s, y/s, z/s) + turbulencez(x, y, z, 2*s));

{ From a uniform number to a normal one, within 4.5e-4: Abramowitz and Stegun, 26.2.23 }
quantile`own(t) :
  t - (2.515517 + t*(.802853 + t*.010328)) / (1 + t*(1.432788 + t*(.189269 + t*.001308)));
tail`own(p) : quantile`own(sqrt(-2*log(p)));
unif2norm(p) : if(.5 - p, -tail`own(p), tail`own(1 - p));
nrand(x) = unif2norm(rand(x));

{ Coordinates in a plane: V up its steepest slope, U across; x and y where the plane is level }
slope`own = sq(Nx) + sq(Ny);
U = if(slope`own - FTINY, (Py*Nx - Px*Ny)/slope`own, Px);
V = if(slope`own - FTINY, Pz - Nz*(Px*Nx + Py*Ny)/slope`own, Py);

{ Coordinates of the hemisphere about the perturbed normal: y towards the up vector that the last three real
  arguments give, z along the normal. For materials with functions or data }
upx`own = arg(AC - 2);
upy`own = arg(AC - 1);
upz`own = arg(AC);
sidex`own = upy`own*NzP - upz`own*NyP;
sidey`own = upz`own*NxP - upx`own*NzP;
sidez`own = upx`own*NyP - upy`own*NxP;
sidelength`own = sqrt(sq(sidex`own) + sq(sidey`own) + sq(sidez`own));
vx`own = sidex`own / sidelength`own;
vy`own = sidey`own / sidelength`own;
vz`own = sidez`own / sidelength`own;
ux`own = NyP*vz`own - NzP*vy`own;
uy`own = NzP*vx`own - NxP*vz`own;
uz`own = NxP*vy`own - NyP*vx`own;
Ldx(x, y, z) = x*ux`own + y*uy`own + z*uz`own;
Ldy(x, y, z) = x*vx`own + y*vy`own + z*vz`own;
Ldz(x, y, z) = x*NxP + y*NyP + z*NzP;
Idx = Ldx(-Dx, -Dy, -Dz);
Idy = Ldy(-Dx, -Dy, -Dz);
Idz = RdotP;
)cal";

}  // namespace rad::calc
