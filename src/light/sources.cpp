#include "light/sources.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/constants.h"
#include "base/overloaded.h"
#include "light/relays.h"
#include "light/spherical_triangle.h"
#include "light/tuning.h"
#include "shade/scattering.h"

namespace rsphere {
namespace {

using Tuning = tuning::SourceParts;

constexpr int kMostParts = 64;  // of a source; RADIANCE's own limit, for which users choose their -ds
// The factor on a length by the number of times that it was halved, up to kMostParts parts.
constexpr std::array<double, 7> kHalved = {1, 1. / 2, 1. / 4, 1. / 8, 1. / 16, 1. / 32, 1. / 64};
constexpr int kMostHalvings = std::bit_width(static_cast<unsigned>(kMostParts)) - 1;
static_assert(kHalved.size() == kMostHalvings + 1);

// Below this cosine a plane source is seen edge-on and left out, as RADIANCE does.
constexpr double kEdgeOn = 1e-4;

// Concentric map of the square [-1, 1]^2 to the unit disk, area-preserving (Shirley and Chiu 1997, JGT 2/3).
void toDisk(double& a, double& b) {
  if (a == 0 && b == 0) return;
  double r, phi;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    phi = kPi / 4 * (b / a);
  } else {
    r = b;
    phi = kPi / 2 - kPi / 4 * (a / b);
  }
  a = r * std::cos(phi);
  b = r * std::sin(phi);
}

bool isParallelogram(std::span<const V3d> v) {
  if (v.size() != 4) return false;
  const V3d gap = v[0] - v[1] + v[2] - v[3];
  return gap.length() <= 1e-4 * ((v[1] - v[0]).length() + (v[3] - v[0]).length());
}

bool isConvex(std::span<const V3d> v, const V3d& normal) {
  for (size_t i = 0; i < v.size(); ++i) {
    const V3d& a = v[i];
    const V3d& b = v[(i + 1) % v.size()];
    const V3d& c = v[(i + 2) % v.size()];
    if ((b - a).cross(c - b).dot(normal) < 0) return false;
  }
  return true;
}

void setSquare(LightSource& source) {
  frame(source.normal, source.u, source.v);
  const double half = std::sqrt(source.area) / 2;
  source.u *= half;
  source.v *= half;
}

// If vertices deviate from the polygon's mean plane by more than rounding, the points that the unit square is
// mapped to lie outside that plane.
bool isFlat(const Polygon& polygon) { return polygon.thickness <= 1e-9 * std::sqrt(polygon.area); }

void setShape(LightSource& source, const Polygon& polygon, const Scene& scene) {
  const auto v = std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices);
  source.normal = polygon.normal;
  source.area = polygon.area;
  for (const V3d& p : v) source.center += p / static_cast<double>(v.size());
  for (const V3d& p : v) source.radius = std::max(source.radius, (p - source.center).length());
  source.hitsWhereAimed = isFlat(polygon);
  if (isParallelogram(v)) {
    source.map = LightSource::Map::parallelogram;
    source.u = (v[1] - v[0]) / 2;
    source.v = (v[3] - v[0]) / 2;
    return;
  }
  // A concave polygon is sampled by a square of the same area around its center; some samples miss it.
  setSquare(source);
  source.map = LightSource::Map::square;
  if (!isConvex(v, polygon.normal)) {
    source.hitsWhereAimed = false;
    return;
  }
  source.map = LightSource::Map::fan;
  source.fanVertices.assign(v.begin(), v.end());
  double sum = 0;
  for (size_t i = 2; i < v.size(); ++i) {
    sum += (v[i - 1] - v[0]).cross(v[i] - v[0]).length() / 2;
    source.fanArea.push_back(sum);
  }
  for (double& a : source.fanArea) a /= sum;
}

void setShape(LightSource& source, const Ring& ring, const Scene&) {
  source.map = LightSource::Map::disk;
  source.center = ring.center;
  source.normal = ring.normal;
  source.radius = ring.outer;
  source.area = kPi * ring.outer * ring.outer;
  frame(ring.normal, source.u, source.v);
  source.u *= ring.outer;
  source.v *= ring.outer;
}

void setShape(LightSource& source, const Sphere& sphere, const Scene&) {
  source.map = LightSource::Map::ball;
  source.center = sphere.center;
  source.radius = sphere.radius;
  source.hitsWhereAimed = !sphere.inward;
}

void setShape(LightSource& source, const Cone& cone, const Scene&) {
  source.map = LightSource::Map::tube;
  source.u = cone.length / 2 * cone.axis;
  source.center = cone.base + source.u;
  source.radius = std::hypot(cone.length / 2, cone.radius0);
  source.area = 2 * cone.radius0 * cone.length;
}

void setShape(LightSource& source, const Distant& distant, const Scene&) {
  source.map = LightSource::Map::cone;
  source.distant = true;
  source.center = distant.direction;
  source.cosHalfAngle = distant.cosHalfAngle;
  source.sinHalfAngle = std::sin(distant.halfAngle);
}

// Whether every ray that is aimed at a part of the shape hits it. A goal may have any shape; one that cannot
// be aimed at is only hit by chance.
bool canBeAimedAt(const Shape& shape, const Scene& scene) {
  return std::visit(Overloaded{
                        [&](const Polygon& polygon) {
                          return isConvex(
                              std::span(scene.vertices).subspan(polygon.firstVertex, polygon.vertices),
                              polygon.normal);
                        },
                        [](const Ring& ring) { return ring.inner == 0; },
                        [](const Sphere& sphere) { return !sphere.inward; },
                        [](const Cone& cone) { return !cone.inward && cone.radius0 == cone.radius1; },
                        [](const Distant&) { return false; },
                        [](const NestedShape auto&) { return false; },
                    },
                    shape);
}

// A part of the unit square on a source.
struct Part {
  double s0 = 0, s1 = 1, t0 = 0, t1 = 1;
};

V3d onFan(const LightSource& source, double s, double t) {
  const auto triangle = std::upper_bound(source.fanArea.begin(), source.fanArea.end() - 1, s);
  const size_t i = static_cast<size_t>(triangle - source.fanArea.begin());
  const double before = i ? source.fanArea[i - 1] : 0;
  const double root = std::sqrt(std::clamp((s - before) / (source.fanArea[i] - before), 0., 1.));
  return (1 - root) * source.fanVertices[0] + root * (1 - t) * source.fanVertices[i + 1] +
         root * t * source.fanVertices[i + 2];
}

V3d onPlane(const LightSource& source, double s, double t) {
  double a = 2 * s - 1, b = 2 * t - 1;
  if (source.map == LightSource::Map::fan) return a == 0 && b == 0 ? source.center : onFan(source, s, t);
  if (source.map == LightSource::Map::disk) toDisk(a, b);
  return source.center + a * source.u + b * source.v;
}

std::array<V3d, 4> cornersOf(const LightSource& source, const Part& p) {
  const auto at = [&](double s, double t) { return onPlane(source, s, t); };
  return {at(p.s0, p.t0), at(p.s1, p.t0), at(p.s1, p.t1), at(p.s0, p.t1)};
}

// The region around a part's middle that its ray is jittered over.
Part shrunk(const Part& p, double jitter) {
  const double s = (1 - jitter) / 2 * (p.s1 - p.s0), t = (1 - jitter) / 2 * (p.t1 - p.t0);
  return {p.s0 + s, p.s1 - s, p.t0 + t, p.t1 - t};
}

// Whether a part is so near that cosine / distance^2 varies strongly over it. Sampling it by area would then
// have unbounded variance.
bool isNear(const LightSource& source, const Part& part, const V3d& point) {
  const double width =
      2 * std::max(source.extentU * (part.s1 - part.s0), source.extentV * (part.t1 - part.t0));
  const V3d middle = onPlane(source, (part.s0 + part.s1) / 2, (part.t0 + part.t1) / 2);
  return width * width > Tuning::kNear * Tuning::kNear * (middle - point).length2();
}

// Splits a part until its half-extents u and v are at most `allowed` times its distance, or there are `most`
// parts. Calls use() with each of them and with the vector from the point to its middle.
template <class Position, class Use>
void split(const Part& part, int most, double u, double v, double allowed, const V3d& from,
           const Position& position, const Use& use) {
  const V3d towards = position((part.s0 + part.s1) / 2, (part.t0 + part.t1) / 2) - from;
  if (most >= 2) {
    const double larger = std::max(u, v);
    if (towards.length2() * allowed * allowed < larger * larger) {
      Part a = part, b = part;
      if (u > v) {
        a.s1 = b.s0 = (part.s0 + part.s1) / 2;
        u /= 2;
      } else {
        a.t1 = b.t0 = (part.t0 + part.t1) / 2;
        v /= 2;
      }
      split(a, most / 2, u, v, allowed, from, position, use);
      split(b, most / 2, u, v, allowed, from, position, use);
      return;
    }
  }
  use(part, towards);
}

double jittered(double from, double to, double jitter, Random& random) {
  const double middle = (from + to) / 2;
  return middle + jitter * (random.uniform() - .5) * (to - from);
}

// One coordinate of a uniformly distributed point in the unit ball. Its density, 3/4 (1 - z^2), is that of
// the median of three uniform numbers.
double depthInBall(Random& random) {
  const double a = random.uniform(), b = random.uniform(), c = random.uniform();
  return 2 * std::max(std::min(a, b), std::min(std::max(a, b), c)) - 1;
}

}  // namespace

LightSources::LightSources(const Scene& scene) : scene_(scene) {
  findSources();
  measureParts();
}

LightSources::LightSources(const Scene& scene, int relays, const SurfaceFunctions& functions,
                           const rad::Warn& warn)
    : scene_(scene) {
  findSources();
  addVirtualSources(scene, relays, functions, warn, sources_);
  measureParts();
}

void LightSources::measureParts() {
  for (LightSource& source : sources_) {
    source.outermost = !source.distant ? source.radius : source.cosHalfAngle > 0 ? source.sinHalfAngle : 1;
    source.extentU = source.u.length();
    source.extentV = source.v.length();
    // A disk is split like the square of the same area, as in rtrace.
    if (source.map == LightSource::Map::disk) source.extentU = source.extentV = std::sqrt(source.area) / 2;
  }
}

void LightSources::findSources() {
  const auto add = [&](SurfaceId surface) -> LightSource& {
    LightSource& source = sources_.emplace_back();
    source.surface = surface;
    std::visit(Overloaded{
                   [&](const PlainShape auto& shape) { setShape(source, shape, scene_); },
                   [&](const Distant& distant) { setShape(source, distant, scene_); },
                   [](const NestedShape auto&) {},
               },
               scene_.surfaces[surface].shape);
    return source;
  };
  // As in rtrace, luminous surfaces in octrees and meshes are visible but are not light sources.
  for (const SurfaceId i : scene_.outermostIds()) {
    const Surface& surface = scene_.surfaces[i];
    if (surface.material == kNone) continue;
    if (scene_.importance) {
      if (surface.goal && canBeAimedAt(surface.shape, scene_)) add(i);
      continue;
    }
    const Material* material = scene_.materialOf(surface);
    if (!material || !isSampled(*material)) continue;
    const double reach = reachOf(*material);
    if (reach != 0 && std::holds_alternative<Distant>(surface.shape)) continue;
    LightSource& source = add(i);
    source.reach = reach;
    if (const auto* spot = std::get_if<Spotlight>(material)) source.spot = *spot;
  }
}

// towards: the vector to the source's center, or the unit direction to a distant source. REQUIRES that the
// source has passed the tests in sample().
void LightSources::sampleParts(LightId index, const V3d& point, const V3d& towards, const SourceSampling& how,
                               Random& random, std::vector<SourceSample>& samples) const {
  const LightSource& source = sources_[index];
  const double jitter = how.jitter;

  // Adds a sample if the ray hits the source. omega: the solid angle (sr) that it represents. length: the
  // distance to the point on or in the source that it is aimed at, which is compared with the reach.
  const auto add = [&](const V3d& direction, double omega, double length) {
    SourceSample sample{direction, omega, 1e10, 1, -direction, index};
    if (source.hitsWhereAimed && source.map == LightSource::Map::ball && jitter <= 0) {
      sample.distance = length - source.radius;
    } else if (source.hitsWhereAimed && source.map != LightSource::Map::ball) {
      sample.distance = length;
      sample.cosine = -direction.dot(source.normal);
      sample.normal = source.normal;
    } else if (!source.distant || source.isVirtual()) {
      ShapeHit hit;
      // The relay of a virtual source lies in front of the image.
      const double farthest = source.isVirtual() && !source.distant ? length + source.radius : 1e10;
      if (!intersect(scene_.surfaces[source.surface].shape, scene_.vertices, point, direction, farthest, hit))
        return;
      sample.distance = hit.distance;
      sample.cosine = hit.cosine;
      sample.normal = hit.normal;
    }
    if (source.reach > 0 && length > source.reach) return;
    if (source.spot && !source.distant) {
      if (outsideSpot(*source.spot, direction)) return;
      // The light diverges from a focus behind the surface.
      const double nearer = length / (length + source.spot->focalLength);
      sample.solidAngle *= nearer * nearer;
    }
    samples.push_back(sample);
  };

  const double distance = source.distant ? 1e10 : towards.length();
  if (source.reach > 0 && distance > source.reach + source.radius) return;
  if (source.isVirtual() && -towards.dot(source.beam) < source.cosBeam * distance) return;
  // A round source: directions are uniform by solid angle projected along the middle direction. One ray to
  // the middle is then exact for a surface that faces the source, and jittered rays are for every surface.
  const auto addRound = [&](const V3d& middle, double sine) {
    if (jitter <= 0) return add(middle, kPi * sine * sine, distance);
    const double s = sine * jitter * std::sqrt(random.uniform());
    const double angle = 2 * kPi * random.uniform();
    const double c = std::sqrt(std::max(0., 1 - s * s));
    V3d x, y;
    frame(middle, x, y);
    // The reach of a glow is measured to a random point in the ball, so that its light has no sharp edge.
    double length = distance;
    if (source.reach > 0) length += jitter * source.radius * depthInBall(random);
    if (c > kEdgeOn)
      add(s * (std::cos(angle) * x + std::sin(angle) * y) + c * middle, kPi * sine * sine / c, length);
  };

  // The limit for half-extents, which is half that for sizes.
  const double allowed = how.largest / 2;

  // Adds a sample of a plane part. aim: the vector from the point to the place to hit.
  const auto addMiddle = [&](const V3d& aim, double length, double area) {
    if (!(length > 0)) return;
    const double inverse = 1 / length;
    const V3d direction = aim * inverse;
    const double cosine = -direction.dot(source.normal);
    if (cosine <= kEdgeOn) return;
    const double omega = area * cosine * (inverse * inverse);
    if (!source.hitsWhereAimed || source.reach > 0 || source.spot) return add(direction, omega, length);
    samples.push_back({direction, omega, length, cosine, source.normal, index});
  };
  // The same as split() for a plane source that is spanned by u and v, without recursion: a part is given by
  // its middle and by the number of times that u and v were halved.
  const auto addMiddles = [&] {
    struct Place {
      V3d middle;  // the vector from the point to it
      int halvedU, halvedV;
    };
    std::array<Place, kMostHalvings> later;
    Place part{towards, 0, 0};
    for (int count = 0;;) {
      const double extentU = kHalved[part.halvedU] * source.extentU,
                   extentV = kHalved[part.halvedV] * source.extentV;
      const double larger = std::max(extentU, extentV), length2 = part.middle.length2();
      if (allowed > 0 && part.halvedU + part.halvedV < kMostHalvings &&
          length2 * allowed * allowed < larger * larger) {
        const bool acrossU = extentU > extentV;
        const V3d half =
            acrossU ? kHalved[part.halvedU + 1] * source.u : kHalved[part.halvedV + 1] * source.v;
        part.halvedU += acrossU;
        part.halvedV += !acrossU;
        later[count++] = {part.middle + half, part.halvedU, part.halvedV};
        part.middle -= half;
        continue;
      }
      addMiddle(part.middle, std::sqrt(length2), kHalved[part.halvedU + part.halvedV] * source.area);
      if (count == 0) return;
      part = later[--count];
    }
  };
  if (jitter <= 0 && source.map <= LightSource::Map::square) return addMiddles();

  switch (source.map) {
    case LightSource::Map::cone:
      if (source.cosHalfAngle < kEdgeOn) {
        // The source fills almost half the sky or more: directions are uniform by solid angle over the cone.
        const double c = 1 - (1 - source.cosHalfAngle) * (jitter > 0 ? random.uniform() * jitter : 0);
        const double angle = 2 * kPi * (jitter > 0 ? random.uniform() : 0);
        const double s = std::sqrt(std::max(0., 1 - c * c));
        V3d x, y;
        frame(source.center, x, y);
        const double omega = 2 * kPi * (1 - source.cosHalfAngle);
        return add(s * (std::cos(angle) * x + std::sin(angle) * y) + c * source.center,
                   jitter > 0 ? omega : kPi, distance);
      }
      return addRound(source.center, source.sinHalfAngle);

    case LightSource::Map::ball:
      if (distance <= source.radius) return;
      return addRound(towards / distance, source.radius / distance);

    case LightSource::Map::tube: {
      const V3d axis = source.u.normalized();
      const double halfLength = source.extentU;
      const double radius = source.area / (4 * halfLength);
      const double along = towards.dot(axis);
      const double fromAxis = (towards - along * axis).length();
      if (fromAxis <= radius) return;  // inside, or looking at an open end
      const auto at = [&](double s, double) { return source.center + (2 * s - 1) * source.u; };
      const auto use = [&](const Part& part, const V3d& unjittered) {
        const V3d middle =
            jitter > 0 ? at(jittered(part.s0, part.s1, jitter, random), 0) - point : unjittered;
        const V3d across = axis.cross(middle).normalized();
        const double side = jitter > 0 ? jitter * (2 * random.uniform() - 1) * radius : 0;
        const V3d aim = middle + side * across;
        const double length = aim.length();
        const double cosine = aim.dot(axis) / length;
        add(aim / length,
            source.area * (part.s1 - part.s0) * std::sqrt(std::max(0., 1 - cosine * cosine)) /
                (length * length),
            length);
      };
      const bool divided = allowed > 0 && fromAxis > Tuning::kTubeNear * radius;
      split(Part{}, divided ? kMostParts : 1, halfLength, 0, allowed, point, at, use);
      return;
    }

    default: {
      // at: maps the unit square to points on the source.
      const auto addPlane = [&](const auto& at) {
        const double height = source.normal.dot(point - source.center);
        // Samples the part uniformly by solid angle.
        const auto addNear = [&](Part part) {
          // For a point in the plane of the source, rounding would decide which side is seen, and the source
          // would then fill half the sky.
          if (height <= kSamePlace) return;
          const std::array<V3d, 4> whole = cornersOf(source, part);
          const double below = triangleSolidAngle(whole[0], whole[1], whole[2], point);
          const double above = triangleSolidAngle(whole[0], whole[2], whole[3], point);
          const double omega = std::abs(below + above);
          std::array<V3d, 4> aims = cornersOf(source, shrunk(part, jitter));
          for (V3d& corner : aims) corner = (corner - point).normalized();
          const double u = random.uniform() * omega, v = random.uniform();
          const bool first = u < std::abs(below);
          const double half = std::abs(first ? below : above);
          if (!(half > 0)) return;
          const V3d direction = sampleTriangle(
              aims[0], aims[first ? 1 : 2], aims[first ? 2 : 3],
              std::abs(triangleSolidAngle(aims[0], aims[first ? 1 : 2], aims[first ? 2 : 3], V3d(0, 0, 0))),
              (first ? u : u - std::abs(below)) / half, v);
          const double cosine = -direction.dot(source.normal);
          if (cosine > kEdgeOn) add(direction, omega, height / cosine);
        };
        const auto use = [&](const Part& part, const V3d& middle) {
          if (jitter > 0 && source.map == LightSource::Map::parallelogram && isNear(source, part, point))
            return addNear(part);
          const V3d aim = jitter > 0 ? at(jittered(part.s0, part.s1, jitter, random),
                                          jittered(part.t0, part.t1, jitter, random)) -
                                           point
                                     : middle;
          addMiddle(aim, aim.length(), source.area * (part.s1 - part.s0) * (part.t1 - part.t0));
        };
        split(Part{}, allowed > 0 ? kMostParts : 1, source.extentU, source.extentV, allowed, point, at, use);
      };
      // Most sources are of these kinds. The map is inlined for them, because a call for every point would
      // cost as much as the rest.
      if (source.map == LightSource::Map::parallelogram || source.map == LightSource::Map::square)
        return addPlane([&](double s, double t) {
          return source.center + (2 * s - 1) * source.u + (2 * t - 1) * source.v;
        });
      return addPlane([&](double s, double t) { return onPlane(source, s, t); });
    }
  }
}

}  // namespace rsphere
