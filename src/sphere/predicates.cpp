#include "sphere/predicates.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace rsphere {
namespace {

// A sum of non-overlapping doubles, smallest first. Its sign is the sign of the last one.
template <int N>
struct Expansion {
  std::array<double, N> part;
  int size = 0;
  void append(double x) {
    if (x != 0) part[size++] = x;
  }
  int sign() const { return size == 0 ? 0 : part[size - 1] > 0 ? 1 : -1; }
};

// Adds one double and keeps the parts non-overlapping (Shewchuk's grow-expansion with zero elimination).
template <int N>
void grow(Expansion<N>& e, double x) {
  int kept = 0;
  for (int i = 0; i < e.size; ++i) {
    const auto [high, low] = sum(x, e.part[i]);
    if (low != 0) e.part[kept++] = low;
    x = high;
  }
  e.size = kept;
  e.append(x);
}

template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<N + M> r;
  std::copy_n(a.part.begin(), a.size, r.part.begin());
  r.size = a.size;
  for (int i = 0; i < b.size; ++i) grow(r, b.part[i]);
  return r;
}

template <int N>
Expansion<2 * N> operator*(const Expansion<N>& a, double b) {
  Expansion<2 * N> r;
  for (int i = 0; i < a.size; ++i) {
    const auto [high, low] = product(a.part[i], b);
    grow(r, low);
    grow(r, high);
  }
  return r;
}

template <int N, int M>
Expansion<2 * N * M> operator*(const Expansion<N>& a, const Expansion<M>& b) {
  Expansion<2 * N * M> r;
  for (int i = 0; i < b.size; ++i) {
    const Expansion<2 * N> row = a * b.part[i];
    for (int j = 0; j < row.size; ++j) grow(r, row.part[j]);
  }
  return r;
}

template <int N>
Expansion<N> operator-(Expansion<N> a) {
  for (int i = 0; i < a.size; ++i) a.part[i] = -a.part[i];
  return a;
}

Expansion<2> exactProduct(double a, double b) {
  const auto [high, low] = product(a, b);
  Expansion<2> r;
  r.append(low);
  r.append(high);
  return r;
}

Expansion<4> exactMinor(double a, double b, double c, double d) {
  return exactProduct(a, d) + -exactProduct(b, c);
}

// 1 + |p|^2
Expansion<7> exactWeight(const V3d& p) {
  Expansion<1> one;
  one.append(1);
  return ((exactProduct(p.x, p.x) + exactProduct(p.y, p.y)) + exactProduct(p.z, p.z)) + one;
}

Expansion<24> exactDeterminant(const V3d& a, const V3d& b, const V3d& c) {
  return (exactMinor(b.x, b.y, c.x, c.y) * a.z + exactMinor(c.x, c.y, a.x, a.y) * b.z) +
         exactMinor(a.x, a.y, b.x, b.y) * c.z;
}

// The determinant of rows (p[i], p[j], 1 + |p|^2).
int signOfWeighted(const V3d& a, const V3d& b, const V3d& c, int i, int j) {
  return ((exactMinor(b[i], b[j], c[i], c[j]) * exactWeight(a) +
           exactMinor(c[i], c[j], a[i], a[j]) * exactWeight(b)) +
          exactMinor(a[i], a[j], b[i], b[j]) * exactWeight(c))
      .sign();
}

// The sign of a determinant of rows (x, y, z, 1 + |p|^2), positive where p lies beyond the plane of a, b, c.
int exactSide(const V3d& a, const V3d& b, const V3d& c, const V3d& p) {
  return ((exactDeterminant(p, b, c) * exactWeight(a) + exactDeterminant(p, c, a) * exactWeight(b)) +
          (exactDeterminant(p, a, b) * exactWeight(c) + -(exactDeterminant(a, b, c) * exactWeight(p))))
      .sign();
}

// The sign of the first nonzero derivative of exactSide, in the order in which coordinates are perturbed. 0
// only if two points are equal.
int shiftedSide(const V3d& a, const V3d& b, const V3d& c, const V3d& p) {
  const std::array<const V3d*, 4> row = {&a, &b, &c, &p};
  std::array<int, 4> order;
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](int i, int j) {
    const V3d &s = *row[i], &t = *row[j];
    return s.x != t.x ? s.x > t.x : s.y != t.y ? s.y > t.y : s.z > t.z;
  });
  for (int column = 0; column < 4; ++column) {  // the weight, x, y, z
    for (int i : order) {
      const V3d &r = *row[i == 0 ? 1 : 0], &s = *row[i <= 1 ? 2 : 1], &t = *row[i <= 2 ? 3 : 2];
      int minor = 0, column4 = 3;
      if (column == 0) {
        minor = exactDeterminant(r, s, t).sign();
      } else {
        column4 = column - 1;
        minor = signOfWeighted(r, s, t, column4 == 0 ? 1 : 0, column4 == 2 ? 1 : 2);
      }
      if (minor != 0) return (i + column4) % 2 == 0 ? -minor : minor;
    }
  }
  return 0;
}

// A form for unit vectors, with u = a - p, and |u|^2/2 instead of u's component along p:
//   |u|^2 p.(v x w) + |v|^2 p.(w x u) + |w|^2 p.(u x v)
// It is twice the exact form, for any radii. Returns 0 if rounding might decide the sign. The error has two
// terms, which the factors 32 and 2 below bound:
// - Rounding: 18 roundings of each product of two squared edges (differences 2, cross 2, dot 3, square 3,
//   product and sums 3; |v||w| <= (|v|^2 + |w|^2)/2).
// - Radii: kUnitTolerance^2 times the squared edges, because the exact form uses the weight (1 + |p|^2)/2 and
//   this form uses chords.
template <class Real>
int liftedSide(const V3d& a, const V3d& b, const V3d& c, const V3d& p) {
  using Vec = Imath::Vec3<Real>;
  const Vec q(p), u = Vec(a) - q, v = Vec(b) - q, w = Vec(c) - q;
  const Real uu = u.dot(u), vv = v.dot(v), ww = w.dot(w);
  const Real side = uu * q.dot(v.cross(w)) + vv * q.dot(w.cross(u)) + ww * q.dot(u.cross(v));
  const Real bound = 16 * std::numeric_limits<Real>::epsilon() * (uu * vv + vv * ww + ww * uu) +
                     Real(2 * kUnitTolerance * kUnitTolerance) * (uu + vv + ww);
  return side > bound ? 1 : side < -bound ? -1 : 0;
}

}  // namespace

bool circleHolds(const V3d& a, const V3d& b, const V3d& c, const V3d& p, PredicateCounts& counts) {
  int sign = liftedSide<double>(a, b, c, p);
  // Extended precision decides most cases of rounded sites on a common circle. It takes 40 ns, the exact form
  // 2 us.
  if (sign == 0) sign = liftedSide<long double>(a, b, c, p);
  if (sign != 0) {
    ++counts.lifted;
    return sign > 0;
  }
  if (sign = exactSide(a, b, c, p); sign != 0) {
    ++counts.exact;
    return sign > 0;
  }
  ++counts.symbolic;
  return shiftedSide(a, b, c, p) > 0;
}

}  // namespace rsphere
