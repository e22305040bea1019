#pragma once
#include <cmath>
#include <cstdint>

// The numeric functions of the expression language that the C library does not have. Each is pure.
namespace rad::calc {

// A pseudo-random number in [0,1) that depends on x alone. Equal to the original's to rounding. Where x is so
// large that it has no fractional digits left, so does the result: it stays within [0,1).
double randomOf(double x);

// Perlin's improved noise: C2, zero at integer points, period 256 along each axis, within [-1,1].
// Beyond +-2^31 there are no fractions to interpolate with: 0.
// Source: K. Perlin, "Improving Noise", Computer Graphics 35(3), 2002.
double noise3(double x, double y, double z);

// The step of the backward difference by which noise3x, noise3y and noise3z are defined, (f(x) -
// f(x-step))/step: the values of scenes depend on it, so the exact gradient (off by 1e-3) is no substitute.
inline constexpr double kNoiseStep = .0005;

// Fractal noise: midpoint displacement on the integer lattice down to a spacing of 1/2000, within about
// [-1,1]. Beyond +-1e15: 0.
double fractalNoise3(double x, double y, double z);

}  // namespace rad::calc
