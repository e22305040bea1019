#include "reference.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace rsphere {
namespace {

const Quad kPi = Quad(3.141592653589793116) + Quad(1.2246467991473532e-16) + Quad(-2.9947698097183397e-33);

Quad squareRoot(Quad x) {
  if (x == 0) return 0;
  Quad r = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3; ++i) r = (r + x / r) / 2;
  return r;
}

// The angle of (x, y), y >= 0, in [0, pi]: a double's guess, and the small rest after turning back by it.
Quad angleOf(Quad y, Quad x) {
  const Quad guess = std::atan2(static_cast<double>(y), static_cast<double>(x));
  const Quad small = guess / 16, s2 = small * small;
  Quad s = 0, c = 0;
  for (int k = 18; k > 0; --k) {  // Horner form of the series: 0.2^36/36! is below 1e-60
    c = (1 - c) * s2 / ((2 * k) * (2 * k - 1));
    s = (1 - s) * s2 / ((2 * k + 1) * (2 * k));
  }
  Quad sine = small * (1 - s), cosine = 1 - c;
  for (int i = 0; i < 4; ++i) {
    const Quad doubled = 2 * sine * cosine;
    cosine = 1 - 2 * sine * sine;
    sine = doubled;
  }
  const Quad rest = (y * cosine - x * sine) / (x * cosine + y * sine);
  return guess + rest - rest * rest * rest / 3;
}

}  // namespace

Reference::Point Reference::normalized(const V3d& d) {
  const Quad x = d.x, y = d.y, z = d.z, length = squareRoot(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

int Reference::bucketOf(double x) const {
  return std::clamp(static_cast<int>((x + 1) / 2 * grid_), 0, grid_ - 1);
}

Reference::Reference(std::span<const V3d> directions) : directions_(directions.begin(), directions.end()) {
  std::map<std::tuple<double, double, double>, std::uint32_t> seen;
  representative_.resize(directions.size());
  sharers_.assign(directions.size(), 0);
  grid_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(directions.size()) / 12)));
  buckets_.resize(static_cast<std::size_t>(grid_) * grid_ * grid_);
  for (std::uint32_t i = 0; i < directions.size(); ++i) {
    const V3d& d = directions[i];
    points_.push_back(normalized(d));
    representative_[i] = seen.try_emplace({d.x, d.y, d.z}, i).first->second;
    ++sharers_[representative_[i]];
    if (representative_[i] == i) {
      buckets_[(static_cast<std::size_t>(bucketOf(d.x)) * grid_ + bucketOf(d.y)) * grid_ + bucketOf(d.z)]
          .push_back(i);
    }
  }
}

// Different directions within twice the cell's radius of direction i: no other can bound its cell. The radius
// is that of a cell among some near ones, which is no smaller.
std::vector<std::uint32_t> Reference::candidates(std::size_t i) const {
  const std::uint32_t self = representative_[i];
  const V3d& c = directions_[self];
  std::vector<std::uint32_t> found;
  for (double reach = 2.0 / grid_;; reach *= 2) {
    found.clear();
    const double r = std::min(reach, 2.0);
    const int low[3] = {bucketOf(c.x - r), bucketOf(c.y - r), bucketOf(c.z - r)};
    const int high[3] = {bucketOf(c.x + r), bucketOf(c.y + r), bucketOf(c.z + r)};
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          for (std::uint32_t k : buckets_[(static_cast<std::size_t>(x) * grid_ + y) * grid_ + z]) {
            if (k != self && (directions_[k] - c).length() <= r) found.push_back(k);
          }
        }
      }
    }
    if (r >= 2) break;
    if (found.size() < 3) continue;
    std::vector<Point> others;
    for (std::uint32_t k : found) others.push_back(points_[k]);
    double radius = 0;
    cell(points_[self], others, &radius);
    if (2 * std::sin(std::min(radius, 1.57)) < 0.999 * r) break;
  }
  // Among those found, the near ones decide; this saves most of the time for clusters.
  if (found.size() > 200) {
    std::sort(found.begin(), found.end(), [&](std::uint32_t k, std::uint32_t l) {
      return (directions_[k] - c).length2() < (directions_[l] - c).length2();
    });
    std::vector<Point> others;
    for (std::size_t k = 0; k < 64; ++k) others.push_back(points_[found[k]]);
    double radius = 0;
    cell(points_[self], others, &radius);
    const double reach = 1.001 * 2 * std::sin(std::min(radius, 1.57));
    if (radius < 1.5)
      std::erase_if(found, [&](std::uint32_t k) { return (directions_[k] - c).length() > reach; });
  }
  return found;
}

Quad Reference::cell(const Point& c, std::span<const Point> others, double* radius) const {
  if (others.empty()) return 4 * kPi;
  // Tangent axes e, f at c: exactly orthogonal is not needed to 1e-34 but to first order in it.
  const double cx = static_cast<double>(c.x), cy = static_cast<double>(c.y), cz = static_cast<double>(c.z);
  const bool useX = std::abs(cx) <= std::abs(cy) && std::abs(cx) <= std::abs(cz),
             useY = std::abs(cy) <= std::abs(cz);
  Point e = useX ? Point{0, -c.z, c.y} : useY ? Point{c.z, 0, -c.x} : Point{-c.y, c.x, 0};
  const Quad length = squareRoot(e.x * e.x + e.y * e.y + e.z * e.z);
  e = {e.x / length, e.y / length, e.z / length};
  const Point f = {c.y * e.z - c.z * e.y, c.z * e.x - c.x * e.z, c.x * e.y - c.y * e.x};
  struct Flat {
    Quad x, y, depth;  // x / depth, y / depth
    Quad px, py;
  };
  std::vector<Flat> flat;
  flat.reserve(others.size());
  for (const Point& b : others) {
    const Quad x = b.x - c.x, y = b.y - c.y, z = b.z - c.z, depth = (x * x + y * y + z * z) / 2;
    if (depth == 0) continue;
    const Quad u = x * e.x + y * e.y + z * e.z, v = x * f.x + y * f.y + z * f.z;
    flat.push_back({u, v, depth, u / depth, v / depth});
  }
  std::sort(flat.begin(), flat.end(),
            [](const Flat& a, const Flat& b) { return a.px != b.px ? a.px < b.px : a.py < b.py; });
  // Andrew's monotone chains.
  std::vector<Flat> hull;
  const auto turn = [](const Flat& a, const Flat& b, const Flat& d) {
    return (b.px - a.px) * (d.py - a.py) - (b.py - a.py) * (d.px - a.px);
  };
  for (int chain = 0; chain < 2; ++chain) {
    const std::size_t begin = hull.size();
    for (const Flat& p : flat) {
      while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(flat.begin(), flat.end());
  }
  if (hull.empty()) hull.push_back(flat.front());
  Quad perimeter = 0;
  double widest = 0;
  std::vector<Point> corners;  // of the cell, in the frame (e, f, c)
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Flat &a = hull[k], &b = hull[(k + 1) % hull.size()];
    // Edges b - c are (x, y, -depth); the cell's corner is normal to both.
    Point n = {a.depth * b.y - a.y * b.depth, a.x * b.depth - a.depth * b.x, a.x * b.y - a.y * b.x};
    const Quad cross = squareRoot(n.x * n.x + n.y * n.y + n.z * n.z);
    perimeter += angleOf(cross, a.x * b.x + a.y * b.y + a.depth * b.depth);
    widest = hull.size() < 3
                 ? 4
                 : std::max(widest, std::atan2(double(squareRoot(n.x * n.x + n.y * n.y)), double(n.z)));
    corners.push_back({n.x / cross, n.y / cross, n.z / cross});
  }
  if (radius) *radius = widest;
  if (widest > 1) return 2 * kPi - perimeter;
  // A small one as a fan of triangles, for which the difference above has too few digits (Eriksson 1990; in a
  // frame with c as its axis nothing cancels).
  Quad area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
    const Quad volume = a.x * b.y - a.y * b.x;
    const Quad half =
        angleOf(volume < 0 ? -volume : volume, 1 + a.z + b.z + a.x * b.x + a.y * b.y + a.z * b.z);
    area += volume < 0 ? -2 * half : 2 * half;
  }
  return area;
}

Quad Reference::solidAngle(std::size_t i) const {
  std::vector<Point> others;
  for (std::uint32_t k : candidates(i)) others.push_back(points_[k]);
  return cell(points_[representative_[i]], others, nullptr) / static_cast<int>(sharers_[representative_[i]]);
}

Quad Reference::changeByHalfUlp(std::size_t i) const {
  const std::vector<std::uint32_t> near = candidates(i);
  const Quad unmoved = solidAngle(i);
  std::mt19937_64 random(i);
  const auto moved = [&](const V3d& d) {
    Quad p[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double ulp = std::nextafter(std::abs(d[axis]), 2) - std::abs(d[axis]);
      p[axis] = Quad(d[axis]) + (random() & 1 ? ulp : -ulp) / 2;
    }
    const Quad length = squareRoot(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return Point{p[0] / length, p[1] / length, p[2] / length};
  };
  Quad most = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<Point> others;
    for (std::uint32_t k : near) others.push_back(moved(directions_[k]));
    Quad change = cell(moved(directions_[representative_[i]]), others, nullptr) /
                      static_cast<int>(sharers_[representative_[i]]) -
                  unmoved;
    if (change < 0) change = -change;
    most = std::max(most, change);
  }
  return most;
}

}  // namespace rsphere
