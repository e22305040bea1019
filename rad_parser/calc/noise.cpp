#include "rad_parser/calc/noise.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace rad::calc {
namespace {

// Perlin's permutation of 0..255, as published with the paper.
constexpr std::array<uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,
    69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,
    94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136,
    171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122,
    60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161,
    1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124, 123, 5,   202, 38,  147, 118, 126,
    255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,  223, 183, 170, 213,
    119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253,
    19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,  242, 193,
    238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,
    222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

// Repeated twice, so that sums of an entry and a coordinate can be used as indices without reduction.
constexpr std::array<uint8_t, 512> kTwice = [] {
  std::array<uint8_t, 512> twice{};
  for (size_t i = 0; i < twice.size(); ++i) twice[i] = kPermutation[i & 255];
  return twice;
}();

// The directions from the centre of a cube to the midpoints of its 12 edges. Four of them are repeated to
// make 16.
constexpr std::array<int8_t, 3 * 16> kGradients = {
    1, 1, 0, -1, 1,  0, 1, -1, 0,  -1, -1, 0,  1, 0, 1, -1, 0,  1, 1,  0, -1, -1, 0,  -1,
    0, 1, 1, 0,  -1, 1, 0, 1,  -1, 0,  -1, -1, 1, 1, 0, 0,  -1, 1, -1, 1, 0,  0,  -1, -1};

double ramp(uint8_t hash, double x, double y, double z) {
  const int8_t* const g = &kGradients[3 * size_t{hash & 15u}];
  return g[0] * x + g[1] * y + g[2] * z;
}

double smooth(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double blend(double t, double a, double b) { return a + t * (b - a); }

// A pseudo-random number in [-1,1]. Arithmetic modulo 2^64 is intended.
double latticeRandom(int64_t seed) {
  uint64_t s = static_cast<uint64_t>(seed);
  s ^= s << 13;
  const uint64_t mixed = s * (s * s * 15731 + 789221) + 1376312589;
  return 1 - static_cast<double>(mixed & 0x7fffffff) / 1073741824.0;
}

}  // namespace

double randomOf(double x) {
  double y = x * (1 / (1 + x * x) + 2.71828182845904);
  y += .785398163397447 - std::floor(y);
  y = 1e5 / y;
  return y - std::floor(y);
}

double noise3(double x, double y, double z) {
  constexpr double limit = 2147483647;
  if (!(std::abs(x) < limit && std::abs(y) < limit && std::abs(z) < limit)) return 0;
  const auto floorOf = [](double v) {
    const int whole = static_cast<int>(v);
    return whole - (v < whole);
  };
  const int ix = floorOf(x), iy = floorOf(y), iz = floorOf(z);
  x -= ix;
  y -= iy;
  z -= iz;
  const int cx = ix & 255, cy = iy & 255, cz = iz & 255;
  const double u = smooth(x), v = smooth(y), w = smooth(z);

  // The hash of corner (i,j,k) is P[P[P[cx+i] + cy+j] + cz+k].
  const int low = kTwice[cx] + cy, high = kTwice[cx + 1] + cy;
  const auto column = [&](int from) { return kTwice[from & 255] + cz; };
  const int ll = column(low), lh = column(low + 1), hl = column(high), hh = column(high + 1);
  const auto layer = [&](int k) {
    const double zk = z - k;
    return blend(v, blend(u, ramp(kTwice[ll + k], x, y, zk), ramp(kTwice[hl + k], x - 1, y, zk)),
                 blend(u, ramp(kTwice[lh + k], x, y - 1, zk), ramp(kTwice[hh + k], x - 1, y - 1, zk)));
  };
  return blend(w, layer(0), layer(1));
}

double fractalNoise3(double x, double y, double z) {
  constexpr int64_t units = 2000;  // lattice points per unit length; their spacing is kNoiseStep
  // The seed of a lattice point is linear in its coordinates, so only seeds need to be tracked.
  constexpr std::array<int64_t, 3> kSeeds = {17, 23, 29};
  const std::array<double, 3> point = {x, y, z};
  std::array<int64_t, 3> offset;  // from the cube's origin to the point
  int64_t origin = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(point[i]) < 1e15)) return 0;
    const auto corner = static_cast<int64_t>(units * std::floor(point[i]));
    offset[i] = static_cast<int64_t>(units * point[i]) - corner;
    origin += kSeeds[i] * corner;
  }
  // Bit i of the number of a corner is set if the corner is at the far end of axis i.
  std::array<double, 8> corner;
  for (int c = 0; c < 8; ++c) {
    int64_t seed = origin;
    for (int i = 0; i < 3; ++i) seed += (c >> i & 1) * units * kSeeds[i];
    corner[c] = latticeRandom(seed);
  }
  // Repeatedly replaces the cube by the octant that contains the point. Each corner of the octant is a corner
  // of the cube, or the midpoint of an edge, of a face or of the cube. The value at a midpoint is the mean of
  // the corners of its edge, face or cube, plus a displacement in proportion to the spacing.
  constexpr std::array<double, 8> kShare = {1, 1. / 2, 1. / 2, 1. / 4, 1. / 2, 1. / 4, 1. / 4, 1. / 8};
  for (int64_t half = units / 2; half > 0; half /= 2) {
    int octant = 0;
    int64_t nearest = origin;       // seed of the corner that the octant shares with the cube
    std::array<int64_t, 3> inward;  // change of the seed along half an edge from that corner, by axis
    for (int i = 0; i < 3; ++i) {
      const bool far = offset[i] > half;
      octant |= far << i;
      nearest += far ? 2 * half * kSeeds[i] : 0;
      inward[i] = far ? -half * kSeeds[i] : half * kSeeds[i];
      if (far) {
        offset[i] -= half;
        origin += half * kSeeds[i];
      }
    }
    // sum[m] is the sum of the values at the corners of an edge, a face or the cube: the one that extends
    // from the corner that the octant shares with the cube, along the axes whose bits are set in m.
    std::array<double, 8> sum;
    for (int m = 0; m < 8; ++m) sum[m] = corner[m ^ octant];
    for (int bit = 1; bit < 8; bit *= 2) {
      for (int m = 0; m < 8; ++m) sum[m] += (m & bit) != 0 ? sum[m ^ bit] : 0;
    }
    corner[octant] = sum[0];
    const double spread = static_cast<double>(half) * kNoiseStep;
    for (int m = 1; m < 8; ++m) {
      int64_t seed = nearest;
      for (int i = 0; i < 3; ++i) seed += (m >> i & 1) * inward[i];
      corner[m ^ octant] = sum[m] * kShare[m] + spread * latticeRandom(seed);
    }
  }
  double sum = 0;
  for (double value : corner) sum += value;
  return sum / 8;
}

}  // namespace rad::calc
