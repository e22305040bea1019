#pragma once

// Numeric functions of the language that the C library lacks. They depend only on their arguments.
namespace rad::calc {

// A pseudo-random number in [0,1) that depends only on x. Agrees with RADIANCE's rand() up to rounding. If x
// is so large that a double has no fractional digits, the result has none either, but is still within [0,1).
double randomOf(double x);

// Perlin's improved noise: twice continuously differentiable, zero at integer points, with period 256 along
// each axis, within [-1,1]. Returns 0 beyond +-2^31, where coordinates are not resolved well enough to
// interpolate. Source: K. Perlin, "Improving Noise", Computer Graphics 35(3), 2002.
double noise3(double x, double y, double z);

// The step of the backward difference (f(x) - f(x-step))/step that defines noise3x, noise3y and noise3z. It
// cannot be replaced by the exact gradient, which differs by 1e-3, because values in existing scenes depend
// on the step.
inline constexpr double kNoiseStep = .0005;

// Fractal noise by midpoint displacement on the integer lattice, down to a spacing of 1/2000. Within about
// [-1,1]. Returns 0 beyond +-1e15.
double fractalNoise3(double x, double y, double z);

}  // namespace rad::calc
