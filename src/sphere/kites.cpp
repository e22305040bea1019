#include "sphere/kites.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vector_widths.h"

namespace rsphere {
namespace {

constexpr int kBlock = 64;

struct alignas(64) Block {
  double ax[kBlock], ay[kBlock], az[kBlock], ah[kBlock];  // corners, their heights
  double bx[kBlock], by[kBlock], bz[kBlock], bh[kBlock];
  double cx[kBlock], cy[kBlock], cz[kBlock], ch[kBlock];
  double uu[kBlock], vv[kBlock], ww[kBlock];                 // squared edges, opposite to b, a, c
  double volumeA[kBlock], volumeB[kBlock], volumeC[kBlock];  // k, computed from the edges at this corner
  double volume[kBlock], area[kBlock];                       // k and N of kites.h
  double tangent[3][kBlock];                                 // at the edge opposite to each corner
};

// Compiled for several vector widths. The results do not depend on the width, because no operations are
// contracted. Each loop is written so that GCC 12 vectorizes it: it only selects between values already
// computed, and the square root has a separate loop.
RSPHERE_FOR_WIDTHS("avx512f", "avx2") void tangents(Block& k) {
  for (int i = 0; i < kBlock; ++i) {
    const double ux = k.ax[i] - k.cx[i], uy = k.ay[i] - k.cy[i], uz = k.az[i] - k.cz[i],
                 du = k.ah[i] - k.ch[i];
    const double vx = k.bx[i] - k.cx[i], vy = k.by[i] - k.cy[i], vz = k.bz[i] - k.cz[i],
                 dv = k.bh[i] - k.ch[i];
    const double wx = k.ax[i] - k.bx[i], wy = k.ay[i] - k.by[i], wz = k.az[i] - k.bz[i],
                 dw = k.ah[i] - k.bh[i];
    const double uu = ux * ux + uy * uy + uz * uz - du * du;
    const double vv = vx * vx + vy * vy + vz * vz - dv * dv;
    const double ww = wx * wx + wy * wy + wz * wz - dw * dw;
    k.uu[i] = uu, k.vv[i] = vv, k.ww[i] = ww;
    k.tangent[0][i] = vv * (wx * ux + wy * uy + wz * uz - 0.5 * (uu * dw + ww * du) - du * dw);
    k.tangent[1][i] = uu * (0.5 * (vv * dw - ww * dv) + dv * dw - (wx * vx + wy * vy + wz * vz));
    k.tangent[2][i] = ww * (ux * vx + uy * vy + uz * vz + 0.5 * (uu * dv + vv * du) - du * dv);
    k.volumeA[i] =
        k.ax[i] * (wy * uz - wz * uy) + k.ay[i] * (wz * ux - wx * uz) + k.az[i] * (wx * uy - wy * ux);
    k.volumeB[i] =
        k.bx[i] * (wy * vz - wz * vy) + k.by[i] * (wz * vx - wx * vz) + k.bz[i] * (wx * vy - wy * vx);
    k.volumeC[i] =
        k.cx[i] * (uy * vz - uz * vy) + k.cy[i] * (uz * vx - ux * vz) + k.cz[i] * (ux * vy - uy * vx);
  }
  for (int i = 0; i < kBlock; ++i) {
    const double a = k.volumeA[i], b = k.volumeB[i], c = k.volumeC[i], uu = k.uu[i], vv = k.vv[i],
                 ww = k.ww[i];
    const double aOrB = vv >= uu ? a : b, longer = vv >= uu ? vv : uu;
    k.volume[i] = ww >= longer ? c : aOrB;
    k.area[i] = uu * vv * ww;
  }
  for (int i = 0; i < kBlock; ++i) k.area[i] = std::sqrt(k.volume[i] * k.volume[i] + 0.25 * k.area[i]);
  for (int i = 0; i < kBlock; ++i) {
    const double four = 4 * k.area[i] + 4 * k.volume[i];
    k.tangent[0][i] /= four - k.vv[i] * k.area[i];
    k.tangent[1][i] /= four - k.uu[i] * k.area[i];
    k.tangent[2][i] /= four - k.ww[i] * k.area[i];
  }
}

// The relative error is 2^-63 for |t| <= 1/32.
inline double arcTangentNearZero(double t) {
  const double s = t * t;
  return t - t * s * (1 / 3.0 - s * (1 / 5.0 - s * (1 / 7.0 - s * (1 / 9.0 - s * (1 / 11.0)))));
}

RSPHERE_FOR_WIDTHS("avx512f", "avx2") void arcTangents(double (&t)[kBlock]) {
  std::uint64_t large = 0;
  for (double x : t) large += std::abs(x) > 1 / 32.0;
  if (large == 0) {
    for (double& x : t) x = arcTangentNearZero(x);
  } else {
    for (double& x : t) x = std::abs(x) > 1 / 32.0 ? std::atan(x) : arcTangentNearZero(x);
  }
}

struct LongVec {
  long double x, y, z;
};
long double dot(const LongVec& a, const LongVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
long double det(const LongVec& a, const LongVec& b, const LongVec& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

// 1 - 1/|site|, by the first two terms of its power series in Site::height; heights are within 2e-16 of 0.
long double shrinkage(const Site& s) { return s.height * (1 - 1.5L * s.height); }
LongVec unit(const Site& s) {
  const long double k = shrinkage(s);
  return {s.at.x - s.at.x * k, s.at.y - s.at.y * k, s.at.z - s.at.z * k};
}
// unit(a) - unit(b), with a rounding error relative to the difference.
LongVec difference(const Site& a, const Site& b) {
  const long double k = shrinkage(a), l = shrinkage(b);
  return {(0.0L + a.at.x - b.at.x) - (k * a.at.x - l * b.at.x),
          (0.0L + a.at.y - b.at.y) - (k * a.at.y - l * b.at.y),
          (0.0L + a.at.z - b.at.z) - (k * a.at.z - l * b.at.z)};
}

// The plane triangle a, b, c of the hull, in extended precision.
struct LongTriangle {
  long double uu, vv, ww;        // squared edges ca, cb, ab
  long double dotA, dotB, dotC;  // dot product of the two edges at each corner
  long double volume, area;      // k and N of kites.h
  LongTriangle(const Site& a, const Site& b, const Site& c) {
    const LongVec u = difference(a, c), v = difference(b, c), w = difference(a, b);
    uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
    dotA = dot(w, u), dotB = -dot(w, v), dotC = dot(u, v);
    volume = ww >= uu && ww >= vv ? det(unit(c), u, v) : vv >= uu ? det(unit(a), w, u) : det(unit(b), w, v);
    area = std::sqrt(volume * volume + uu * vv * ww / 4);
  }
};

// Calls use(i, kites, wide) for each triangle which[i].
template <class Use>
void forKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, Use&& use) {
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
      use(first + i, Kites{b + c, c + a, a + b}, !(block.volume[i] > kLeastCosine * block.area[i]));
    }
  }
}

}  // namespace

void computeKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<Kites> kites,
                  std::span<std::uint8_t> wide) {
  forKites(delaunay, which, [&](std::size_t i, const Kites& k, bool isWide) {
    kites[i] = k;
    wide[i] = isWide;
  });
}

void addKites(const Delaunay& delaunay, std::span<const std::uint32_t> which, std::span<double> area,
              std::span<std::uint8_t> spoiled) {
  forKites(delaunay, which, [&](std::size_t i, const Kites& k, bool isWide) {
    const auto& corner = delaunay.triangles[which[i]].corner;
    for (int e = 0; e < 3; ++e) area[corner[e]] += k[e];
    if (isWide)
      for (std::uint32_t c : corner) spoiled[c] = 1;
  });
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
  // Let u = a - c and v = b - c. On the sphere, a and b lie |u|^2/2 and |v|^2/2 below c. With these heights,
  // the normal is det c + ((|u|^2 v - |v|^2 u) x c) / 2.
  const V3d u = a - c, v = b - c;
  return (c * (2 * c.dot(u.cross(v))) + (v * u.length2() - u * v.length2()).cross(c)).normalized();
}

}  // namespace rsphere
