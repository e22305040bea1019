#include "sphere/kites.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

constexpr int kBlock = 64;

struct Block {
  double ax[kBlock], ay[kBlock], az[kBlock];
  double bx[kBlock], by[kBlock], bz[kBlock];
  double cx[kBlock], cy[kBlock], cz[kBlock];
  double ah[kBlock], bh[kBlock], ch[kBlock];  // heights
  double tangent[3][kBlock];                  // at the edge opposite to that corner
  double cosine[kBlock];
};

struct Vec {
  double x, y, z;
};
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double det(Vec a, Vec b, Vec c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

void tangents(Block& k) {
  for (int i = 0; i < kBlock; ++i) {
    const Vec a{k.ax[i], k.ay[i], k.az[i]}, b{k.bx[i], k.by[i], k.bz[i]}, c{k.cx[i], k.cy[i], k.cz[i]};
    const Vec u{a.x - c.x, a.y - c.y, a.z - c.z}, v{b.x - c.x, b.y - c.y, b.z - c.z},
        w{a.x - b.x, a.y - b.y, a.z - b.z};
    const double du = k.ah[i] - k.ch[i], dv = k.bh[i] - k.ch[i], dw = k.ah[i] - k.bh[i];
    const double uu = dot(u, u) - du * du, vv = dot(v, v) - dv * dv, ww = dot(w, w) - dw * dw;
    const double dotA = dot(w, u) - 0.5 * (uu * dw + ww * du) - du * dw;
    const double dotB = -dot(w, v) + 0.5 * (vv * dw - ww * dv) + dv * dw;
    const double dotC = dot(u, v) + 0.5 * (uu * dv + vv * du) - du * dv;
    const bool cIsApex = (ww >= uu) & (ww >= vv), aIsApex = vv >= uu;
    const double atA = det(a, w, u), atB = det(b, w, v), atC = det(c, u, v);
    const double volume = cIsApex ? atC : aIsApex ? atA : atB;
    const double area = std::sqrt(volume * volume + 0.25 * uu * vv * ww);
    const double four = 4 * area + 4 * volume;
    k.tangent[0][i] = vv * dotA / (four - vv * area);
    k.tangent[1][i] = uu * dotB / (four - uu * area);
    k.tangent[2][i] = ww * dotC / (four - ww * area);
    k.cosine[i] = volume / area;
  }
}

// Error 2^-63 relative for |t| <= 1/32.
inline double arcTangentNearZero(double t) {
  const double s = t * t;
  return t - t * s * (1 / 3.0 - s * (1 / 5.0 - s * (1 / 7.0 - s * (1 / 9.0 - s * (1 / 11.0)))));
}

void arcTangents(double (&t)[kBlock]) {
  double greatest = 0;
  for (double x : t) greatest = std::max(greatest, std::abs(x));
  if (greatest <= 1 / 32.0) {
    for (double& x : t) x = arcTangentNearZero(x);
  } else {
    for (double& x : t) x = std::abs(x) <= 1 / 32.0 ? arcTangentNearZero(x) : std::atan(x);
  }
}

struct LongVec {
  long double x, y, z;
};
long double dot(const LongVec& a, const LongVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
long double det(const LongVec& a, const LongVec& b, const LongVec& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

// 1 - 1/|site|
long double shrinkage(const Site& s) { return s.height * (1 - 1.5L * s.height); }
LongVec unit(const Site& s) {
  const long double k = shrinkage(s);
  return {s.at.x - s.at.x * k, s.at.y - s.at.y * k, s.at.z - s.at.z * k};
}
// unit(a) - unit(b), rounded at the size of the difference.
LongVec difference(const Site& a, const Site& b) {
  const long double k = shrinkage(a), l = shrinkage(b);
  return {(0.0L + a.at.x - b.at.x) - (k * a.at.x - l * b.at.x),
          (0.0L + a.at.y - b.at.y) - (k * a.at.y - l * b.at.y),
          (0.0L + a.at.z - b.at.z) - (k * a.at.z - l * b.at.z)};
}

// The plane triangle a, b, c of a hull in extended precision.
struct LongTriangle {
  long double uu, vv, ww;        // squared edges ca, cb, ab
  long double dotA, dotB, dotC;  // of the two edges at a corner
  long double volume, area;      // k and N of kites.h
  LongTriangle(const Site& a, const Site& b, const Site& c) {
    const LongVec u = difference(a, c), v = difference(b, c), w = difference(a, b);
    uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    dotA = dot(w, u), dotB = -dot(w, v), dotC = dot(u, v);
    volume = ww >= uu && ww >= vv ? det(unit(c), u, v) : vv >= uu ? det(unit(a), w, u) : det(unit(b), w, v);
    area = std::sqrt(volume * volume + uu * vv * ww / 4);
  }
};

}  // namespace

void computeKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<Kites> kites,
                  std::span<std::uint8_t> wide) {
  Block block;
  for (std::size_t first = 0; first < which.size(); first += kBlock) {
    const int n = static_cast<int>(std::min<std::size_t>(kBlock, which.size() - first));
    for (int i = 0; i < kBlock; ++i) {
      const Triangle& t = delaunay.triangles[which[first + std::min(i, n - 1)]];
      const Site &a = delaunay.sites[t.corner[0]], &b = delaunay.sites[t.corner[1]],
                 &c = delaunay.sites[t.corner[2]];
      block.ax[i] = a.at.x, block.ay[i] = a.at.y, block.az[i] = a.at.z, block.ah[i] = a.height;
      block.bx[i] = b.at.x, block.by[i] = b.at.y, block.bz[i] = b.at.z, block.bh[i] = b.height;
      block.cx[i] = c.at.x, block.cy[i] = c.at.y, block.cz[i] = c.at.z, block.ch[i] = c.height;
    }
    tangents(block);
    for (auto& t : block.tangent) arcTangents(t);
    for (int i = 0; i < n; ++i) {
      const double a = block.tangent[0][i], b = block.tangent[1][i], c = block.tangent[2][i];
      kites[first + i] = {b + c, c + a, a + b};
      wide[first + i] = !(block.cosine[i] > kLeastCosine);
    }
  }
}

long double hullAngle(const Site& a, const Site& b, const Site& c) {
  const LongTriangle t(a, b, c);
  return std::atan2(t.area, t.dotC);
}

double carefulSolidAngle(const Delaunay& delaunay, std::uint32_t site) {
  long double angles = 0, kites = 0;
  bool anyWide = false;
  delaunay.around(site, [&](std::uint32_t triangle, int i) {
    const Triangle& k = delaunay.triangles[triangle];
    const LongTriangle t(delaunay.sites[k.corner[Delaunay::kAfter[i]]],
                         delaunay.sites[k.corner[Delaunay::kBefore[i]]], delaunay.sites[site]);
    anyWide = anyWide || !(t.volume > kLeastCosine * t.area);
    angles += std::atan2(t.area, t.dotC);
    const long double four = 4 * (t.area + t.volume);
    kites +=
        std::atan(t.vv * t.dotA / (four - t.vv * t.area)) + std::atan(t.uu * t.dotB / (four - t.uu * t.area));
    return false;
  });
  return static_cast<double>(anyWide ? 2 * std::numbers::pi_v<long double> - angles : kites);
}

V3d circumcentre(const V3d& a, const V3d& b, const V3d& c) {
  // With u = a - c and v = b - c taken as the sphere bends them, |u|^2/2 below c, the normal is
  // det c + ((|u|^2 v - |v|^2 u) x c) / 2.
  const V3d u = a - c, v = b - c;
  return (c * (2 * c.dot(u.cross(v))) + (v * u.length2() - u * v.length2()).cross(c)).normalized();
}

}  // namespace rsphere
