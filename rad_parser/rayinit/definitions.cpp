#include "rad_parser/rayinit/interface.h"

namespace rad::calc {

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
