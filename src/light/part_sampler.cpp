// Samples one light source as seen from a point: divides its shape into parts, and samples each part.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "base/frame.h"
#include "light/sources.h"
#include "light/spherical_triangle.h"
#include "light/tuning.h"

namespace rsphere {
namespace {

constexpr int kMostParts = 64;  // per source. RADIANCE has the same limit, and users choose -ds for it
// Factor on a length after it has been halved this number of times. The last entry gives kMostParts parts.
constexpr std::array<double, 7> kHalved = {1, 1. / 2, 1. / 4, 1. / 8, 1. / 16, 1. / 32, 1. / 64};
constexpr int kMostHalvings = std::bit_width(static_cast<unsigned>(kMostParts)) - 1;
static_assert(kHalved.size() == kMostHalvings + 1);

// Plane sources seen under a smaller cosine are treated as edge-on and omitted, as in RADIANCE.
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

// A rectangle of the unit square, which is mapped to a part of the source.
struct SourcePart {
  double s0 = 0, s1 = 1, t0 = 0, t1 = 1;
};

V3d onTriangles(const V3d& center, const PlaneLight::Triangles& triangles, double s, double t) {
  if (2 * s - 1 == 0 && 2 * t - 1 == 0) return center;
  const size_t i = triangles.triangleAt(s);
  const double before = i ? triangles.areas[i - 1] : 0;
  return triangles.at(i, std::clamp((s - before) / (triangles.areas[i] - before), 0., 1.), t);
}

V3d onParallelogram(const V3d& center, const PlaneLight& plane, double s, double t) {
  return center + (2 * s - 1) * plane.u + (2 * t - 1) * plane.v;
}

V3d onDisk(const V3d& center, const PlaneLight& plane, double s, double t) {
  double a = 2 * s - 1, b = 2 * t - 1;
  toDisk(a, b);
  return center + a * plane.u + b * plane.v;
}

// The area-preserving map to the disk in polar coordinates, for parts of a near disk: s is the fraction of
// the area within a circle, and t the fraction of the full angle.
V3d onDiskByAngle(const V3d& center, const PlaneLight& plane, double s, double t) {
  const double radius = std::sqrt(s), angle = 2 * kPi * t;
  return center + radius * std::cos(angle) * plane.u + radius * std::sin(angle) * plane.v;
}

// Calls use(a, b, c) for triangles that cover a part of a plane source and do not overlap. They cover no more
// than the part, except at the circles of a disk. The parts of a disk are those of onDiskByAngle().
template <class Use>
void eachTriangle(const V3d& center, const PlaneLight& plane, const SourcePart& part, const Use& use) {
  const auto useBoth = [&](const V3d& a, const V3d& b, const V3d& c, const V3d& d) {
    use(a, b, c);
    use(a, c, d);
  };
  match(
      plane.map,
      [&](const OneOf<PlaneLight::Parallelogram, PlaneLight::Square> auto&) {
        const auto at = [&](double s, double t) { return onParallelogram(center, plane, s, t); };
        useBoth(at(part.s0, part.t0), at(part.s1, part.t0), at(part.s1, part.t1), at(part.s0, part.t1));
      },
      [&](const PlaneLight::Disk&) {
        const int sides = std::max(
            1, static_cast<int>(std::ceil(tuning::PartSampler::kCornersOfDisk * (part.t1 - part.t0))));
        const double outwards = 1 / std::cos(kPi * (part.t1 - part.t0) / sides);
        const auto at = [&](double s, int side, double factor) {
          const V3d from = onDiskByAngle(center, plane, s, part.t0 + side * (part.t1 - part.t0) / sides);
          return center + factor * (from - center);
        };
        for (int i = 0; i < sides; ++i)
          useBoth(at(part.s0, i, 1), at(part.s1, i, outwards), at(part.s1, i + 1, outwards),
                  at(part.s0, i + 1, 1));
      },
      [&](const PlaneLight::Triangles& triangles) {
        for (size_t i = 0; i < triangles.areas.size(); ++i) {
          const double before = i ? triangles.areas[i - 1] : 0, after = triangles.areas[i];
          const double from = std::max(part.s0, before), to = std::min(part.s1, after);
          if (!(from < to)) continue;
          const auto at = [&](double s, double t) {
            return triangles.at(i, (s - before) / (after - before), t);
          };
          useBoth(at(from, part.t0), at(to, part.t0), at(to, part.t1), at(from, part.t1));
        }
      });
}

// The sum of the solid angles (sr) of the triangles of eachTriangle().
double solidAngleOf(const LightSource& source, const PlaneLight& plane, const SourcePart& part,
                    const V3d& point) {
  double sum = 0;
  eachTriangle(source.center, plane, part,
               [&](const V3d& a, const V3d& b, const V3d& c) { sum += triangleSolidAngle(a, b, c, point); });
  return std::abs(sum);
}

// True if a part is so near that cosine / distance^2 varies strongly over it. Sampling it by area would then
// have unbounded variance. towards: the vector from the point to the part's middle.
bool isNear(const LightSource& source, const PlaneLight& plane, const SourcePart& part, const V3d& point,
            const V3d& towards) {
  if (std::holds_alternative<PlaneLight::Parallelogram>(plane.map) ||
      std::holds_alternative<PlaneLight::Square>(plane.map)) {
    const double width =
        2 * std::max(plane.extentU * (part.s1 - part.s0), plane.extentV * (part.t1 - part.t0));
    return width * width > tuning::PartSampler::kNear * tuning::PartSampler::kNear * towards.length2();
  }
  // Far from a source none of its parts is near.
  constexpr double kFar = 1 + 4 / tuning::PartSampler::kNear;
  if ((source.center - point).length2() > kFar * kFar * source.radius * source.radius) return false;
  Box3d box;
  eachTriangle(source.center, plane, part, [&](const V3d& a, const V3d& b, const V3d& c) {
    for (const V3d& corner : {a, b, c}) box.extendBy(corner);
  });
  return box.size().length2() >
         tuning::PartSampler::kNear * tuning::PartSampler::kNear * (box.center() - point).length2();
}

// Halves a part repeatedly until its half-extents u and v are at most `allowed` times its distance, or until
// there are `most` parts. Calls use() with each part and the vector from the point to the part's middle.
template <class Position, class Use>
void split(const SourcePart& part, int most, double u, double v, double allowed, const V3d& from,
           const Position& position, const Use& use) {
  const V3d towards = position((part.s0 + part.s1) / 2, (part.t0 + part.t1) / 2) - from;
  if (most >= 2) {
    const double larger = std::max(u, v);
    if (towards.length2() * allowed * allowed < larger * larger) {
      SourcePart a = part, b = part;
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

class PartSampler {
 public:
  // Keeps references. Samples are appended to `samples`. index: the number of the source.
  PartSampler(const LightSource& source, LightId index, const Scene& scene, const V3d& point,
              const SourceSampling& how, Random& random, std::vector<SourceSample>& samples)
      : source_(source),
        index_(index),
        scene_(scene),
        point_(point),
        jitter_(how.jitter),
        allowed_(how.largest / 2),
        splitsBalls_(how.splitsBalls),
        random_(random),
        samples_(samples) {}

  // Adds the samples of all parts. towards: the vector to the source's center, or the unit direction to a
  // distant source. REQUIRES that the source has passed the tests in LightSources::sample().
  void sample(const V3d& towards);

 private:
  // Adds a sample in a direction (unit) that represents a solid angle (sr), unless the ray misses the source.
  // length: the distance to the sampled point on or in the source, which is compared with the reach.
  void add(const V3d& direction, double solidAngle, double length);
  bool hit(const V3d& direction, double length, SourceSample& sample) const;

  void addRound(const V3d& middle, double sine, double distance);
  void addPartsOfBall(const V3d& middle, double sine, double distance);
  void addBall(const V3d& towards, double distance);
  void addDistant(const DistantLight& cone, double distance);
  void addTube(const TubeLight& tube, const V3d& towards);
  void addMiddle(const PlaneLight& plane, const V3d& aim, double length, double area);
  void addMiddles(const PlaneLight& plane, const V3d& towards);
  void addNear(const PlaneLight& plane, const SourcePart& part);
  template <class Position>
  void addParts(const PlaneLight& plane, bool mayBeNear, const Position& at);
  void addPlane(const PlaneLight& plane, const V3d& towards);

  const LightSource& source_;
  LightId index_;
  const Scene& scene_;
  const V3d& point_;
  double jitter_;   // -dj
  double allowed_;  // largest half-extent of a part relative to its distance (half of -ds)
  bool splitsBalls_;
  Random& random_;
  std::vector<SourceSample>& samples_;
};

static_assert(kLightForms == 8, "Where do rays meet it that are aimed at it?");
// Finds where a ray that was aimed at the source hits it; false if it misses.
bool PartSampler::hit(const V3d& direction, double length, SourceSample& sample) const {
  if (source_.hitsWhereAimed) {
    if (const auto* plane = source_.as<PlaneLight>()) {
      sample.distance = length;
      sample.cosine = -direction.dot(plane->normal);
      sample.normal = plane->normal;
      return true;
    }
    if (jitter_ <= 0) {
      sample.distance = length - source_.radius;
      return true;
    }
  }
  if (source_.isDistant() && !source_.isVirtual()) return true;
  ShapeHit hit;
  // The ray hits the relay of a virtual source, which lies in front of the image.
  const double farthest = source_.isVirtual() && !source_.isDistant() ? length + source_.radius : 1e10;
  if (!intersect(scene_.surfaces[source_.surface].shape, scene_.vertices, point_, direction, farthest, hit,
                 scene_.samePlace))
    return false;
  sample.distance = hit.distance;
  sample.cosine = hit.cosine;
  sample.normal = hit.normal;
  return true;
}

void PartSampler::add(const V3d& direction, double solidAngle, double length) {
  SourceSample sample{direction, solidAngle, 1e10, 1, -direction, index_};
  if (!hit(direction, length, sample)) return;
  if (source_.reach > 0 && length > source_.reach) return;
  if (source_.spot) {
    if (outsideSpot(*source_.spot, direction)) return;
    // The beam of a spotlight diverges from a focus behind the surface, which does not matter at infinity.
    const double nearer = source_.isDistant() ? 1 : length / (length + source_.spot->focalLength);
    sample.solidAngle *= nearer * nearer;
  }
  samples_.push_back(sample);
}

// A round source is sampled uniformly in solid angle projected along the direction to its middle. A single
// ray to the middle is then exact for a surface that faces the source; jittered rays are exact for every
// surface.
void PartSampler::addRound(const V3d& middle, double sine, double distance) {
  if (jitter_ <= 0) return add(middle, kPi * sine * sine, distance);
  const double s = sine * jitter_ * std::sqrt(random_.uniform());
  const double angle = 2 * kPi * random_.uniform();
  const double c = std::sqrt(std::max(0., 1 - s * s));
  const auto [x, y] = frame(middle);
  // The reach of a glow is compared with the distance to a random point in the ball, which avoids a sharp
  // edge.
  double length = distance;
  if (source_.reach > 0) length += jitter_ * source_.radius * depthInBall(random_);
  if (c > kEdgeOn)
    add(s * (std::cos(angle) * x + std::sin(angle) * y) + c * middle, kPi * sine * sine / c, length);
}

// addRound() for a ball, stratified: the disk that the ball appears as is divided into parts, with one sample
// in each.
void PartSampler::addPartsOfBall(const V3d& middle, double sine, double distance) {
  const auto axes = frame(middle);
  const auto onSeenDisk = [&](double s, double t) {
    double a = 2 * s - 1, b = 2 * t - 1;
    toDisk(a, b);
    return a * axes.first + b * axes.second;
  };
  const auto at = [&](double s, double t) { return source_.center + source_.radius * onSeenDisk(s, t); };
  const auto use = [&](const SourcePart& part, const V3d&) {
    const V3d aside = sine * onSeenDisk(jittered(part.s0, part.s1, jitter_, random_),
                                        jittered(part.t0, part.t1, jitter_, random_));
    const double c = std::sqrt(std::max(0., 1 - aside.length2()));
    const double share = (part.s1 - part.s0) * (part.t1 - part.t0);
    // The reach is treated as in addRound().
    double length = distance;
    if (source_.reach > 0) length += jitter_ * source_.radius * depthInBall(random_);
    if (c > kEdgeOn) add(aside + c * middle, share * kPi * sine * sine / c, length);
  };
  split(SourcePart{}, kMostParts, source_.radius, source_.radius, allowed_, point_, at, use);
}

void PartSampler::addBall(const V3d& towards, double distance) {
  if (distance <= source_.radius) return;
  const bool isSplit = splitsBalls_ && jitter_ > 0 && allowed_ > 0 && source_.radius > allowed_ * distance;
  if (isSplit) return addPartsOfBall(towards / distance, source_.radius / distance, distance);
  addRound(towards / distance, source_.radius / distance, distance);
}

void PartSampler::addDistant(const DistantLight& cone, double distance) {
  if (cone.cosHalfAngle >= kEdgeOn) return addRound(source_.center, cone.sinHalfAngle, distance);
  // The source fills almost half the sky or more: directions are uniform by solid angle over the cone.
  const double c = 1 - (1 - cone.cosHalfAngle) * (jitter_ > 0 ? random_.uniform() * jitter_ : 0);
  const double angle = 2 * kPi * (jitter_ > 0 ? random_.uniform() : 0);
  const double s = std::sqrt(std::max(0., 1 - c * c));
  const auto [x, y] = frame(source_.center);
  const double omega = 2 * kPi * (1 - cone.cosHalfAngle);
  add(s * (std::cos(angle) * x + std::sin(angle) * y) + c * source_.center, jitter_ > 0 ? omega : kPi,
      distance);
}

// Adds a sample of a plane part. aim: the vector from the point to the sampled place. Inline because most
// sources consist of a few such parts, and calls took .6% of the instructions in scenes with patterned lamps.
[[gnu::always_inline]] inline void PartSampler::addMiddle(const PlaneLight& plane, const V3d& aim,
                                                          double length, double area) {
  if (!(length > 0)) return;
  const double inverse = 1 / length;
  const V3d direction = aim * inverse;
  const double cosine = -direction.dot(plane.normal);
  if (cosine <= kEdgeOn) return;
  const double omega = area * cosine * (inverse * inverse);
  if (!source_.hitsWhereAimed || source_.reach > 0 || source_.spot) return add(direction, omega, length);
  samples_.push_back({direction, omega, length, cosine, plane.normal, index_});
}

// A version of split() without recursion, for a plane source that is spanned by u and v. A part is described
// by its middle and by how often u and v were halved.
void PartSampler::addMiddles(const PlaneLight& plane, const V3d& towards) {
  struct Place {
    V3d middle;  // relative to the point
    int halvedU, halvedV;
  };
  std::array<Place, kMostHalvings> later;
  Place part{towards, 0, 0};
  for (int count = 0;;) {
    const double extentU = kHalved[part.halvedU] * plane.extentU,
                 extentV = kHalved[part.halvedV] * plane.extentV;
    const double larger = std::max(extentU, extentV), length2 = part.middle.length2();
    if (allowed_ > 0 && part.halvedU + part.halvedV < kMostHalvings &&
        length2 * allowed_ * allowed_ < larger * larger) {
      const bool acrossU = extentU > extentV;
      const V3d half = acrossU ? kHalved[part.halvedU + 1] * plane.u : kHalved[part.halvedV + 1] * plane.v;
      part.halvedU += acrossU;
      part.halvedV += !acrossU;
      later[count++] = {part.middle + half, part.halvedU, part.halvedV};
      part.middle -= half;
      continue;
    }
    addMiddle(plane, part.middle, std::sqrt(length2), kHalved[part.halvedU + part.halvedV] * plane.area);
    if (count == 0) return;
    part = later[--count];
  }
}

// The sine of the angle between the plane across a tube and the direction to a place this far along its axis
// and across it.
double sineAlong(double along, double across) { return along / std::hypot(along, across); }

void PartSampler::addTube(const TubeLight& tube, const V3d& towards) {
  const V3d axis = tube.half.normalized();
  const double halfLength = tube.half.length();
  const double radius = tube.area / (4 * halfLength);
  const double along = towards.dot(axis);
  const double fromAxis = (towards - along * axis).length();
  if (fromAxis <= radius) return;  // inside, or looking at an open end
  const auto at = [&](double s, double) { return source_.center + (2 * s - 1) * tube.half; };
  const V3d facing = (along * axis - towards) / fromAxis, aside = axis.cross(facing);
  const double widest = std::asin(radius / fromAxis);  // half of the angle that the tube's width subtends
  // Jittered samples lie on the visible side, with -dj 1 uniform by solid angle for each angle across. In
  // rtrace they lie in the plane through the axis, which loses light: 2% at four radii from the axis.
  const auto addOnSide = [&](const SourcePart& part) {
    const double angle = jitter_ * (2 * random_.uniform() - 1) * widest;
    const V3d across = std::sin(angle) * aside - std::cos(angle) * facing;
    const double offset = fromAxis * std::sin(angle);
    const double distance =
        fromAxis * std::cos(angle) - std::sqrt(std::max(0., radius * radius - offset * offset));
    const double least = sineAlong(along + (2 * part.s0 - 1) * halfLength, distance),
                 most = sineAlong(along + (2 * part.s1 - 1) * halfLength, distance);
    const double sine = jittered(least, most, jitter_, random_), cosine = std::sqrt(1 - sine * sine);
    if (cosine > 0) add(cosine * across + sine * axis, 2 * widest * (most - least), distance / cosine);
  };
  const auto use = [&](const SourcePart& part, const V3d& unjittered) {
    if (jitter_ > 0) return addOnSide(part);
    const double length = unjittered.length(), cosine = unjittered.dot(axis) / length;
    add(unjittered / length,
        tube.area * (part.s1 - part.s0) * std::sqrt(std::max(0., 1 - cosine * cosine)) / (length * length),
        length);
  };
  // Not split at smaller distances, where the tube's width matters as much as its length.
  const bool divided = allowed_ > 0 && fromAxis > 2 * radius;
  split(SourcePart{}, divided ? kMostParts : 1, halfLength, 0, allowed_, point_, at, use);
}

// Samples a part of a plane source uniformly by solid angle: all of it, however small the jitter is. The
// solid angle of a near part is unevenly distributed over its area, so that its middle would be too bright.
void PartSampler::addNear(const PlaneLight& plane, const SourcePart& part) {
  const double height = plane.normal.dot(point_ - source_.center);
  // If the point lies in the plane of the source, rounding would decide whether it sees the source, which
  // would then fill half the sky.
  if (height <= scene_.samePlace) return;
  const double omega = solidAngleOf(source_, plane, part, point_);
  double u = random_.uniform() * omega;
  const double v = random_.uniform();
  std::optional<V3d> chosen;
  eachTriangle(source_.center, plane, part, [&](const V3d& a, const V3d& b, const V3d& c) {
    if (chosen) return;
    const double own = std::abs(triangleSolidAngle(a, b, c, point_));
    if (u < own) {
      const V3d toA = (a - point_).normalized(), toB = (b - point_).normalized(),
                toC = (c - point_).normalized();
      chosen = sampleTriangle(toA, toB, toC, std::abs(triangleSolidAngle(toA, toB, toC, V3d(0, 0, 0))),
                              u / own, v);
    }
    u -= own;
  });
  if (!chosen) return;
  const double cosine = -chosen->dot(plane.normal);
  if (!(cosine > kEdgeOn)) return;
  const double length = height / cosine;
  if (std::holds_alternative<PlaneLight::Disk>(plane.map)) {
    // Its radius, squared, in units of u and v, which are the radii of an ellipse in images by prisms.
    const V3d from = point_ + length * *chosen - source_.center, both = plane.u.cross(plane.v);
    const double a = from.cross(plane.v).dot(both), b = plane.u.cross(from).dot(both);
    const double square = (a * a + b * b) / (both.length2() * both.length2());
    if (square < part.s0 || square > part.s1) return;
  }
  add(*chosen, omega, length);
}

// at: maps the unit square to points on the source.
template <class Position>
void PartSampler::addParts(const PlaneLight& plane, bool mayBeNear, const Position& at) {
  const auto use = [&](const SourcePart& part, const V3d& middle) {
    if (jitter_ > 0 && mayBeNear && isNear(source_, plane, part, point_, middle)) return addNear(plane, part);
    const V3d aim = jitter_ > 0 ? at(jittered(part.s0, part.s1, jitter_, random_),
                                     jittered(part.t0, part.t1, jitter_, random_)) -
                                      point_
                                : middle;
    addMiddle(plane, aim, aim.length(), plane.area * (part.s1 - part.s0) * (part.t1 - part.t0));
  };
  split(SourcePart{}, allowed_ > 0 ? kMostParts : 1, plane.extentU, plane.extentV, allowed_, point_, at, use);
}

void PartSampler::addPlane(const PlaneLight& plane, const V3d& towards) {
  const V3d& center = source_.center;
  match(
      plane.map,
      [&](const OneOf<PlaneLight::Parallelogram, PlaneLight::Square> auto&) {
        if (jitter_ <= 0) return addMiddles(plane, towards);
        addParts(plane, true, [&](double s, double t) { return onParallelogram(center, plane, s, t); });
      },
      [&](const PlaneLight::Disk&) {
        if (jitter_ > 0 && isNear(source_, plane, {}, point_, towards))
          return addParts(plane, true,
                          [&](double s, double t) { return onDiskByAngle(center, plane, s, t); });
        addParts(plane, false, [&](double s, double t) { return onDisk(center, plane, s, t); });
      },
      [&](const PlaneLight::Triangles& triangles) {
        addParts(plane, true, [&](double s, double t) { return onTriangles(center, triangles, s, t); });
      });
}

void PartSampler::sample(const V3d& towards) {
  const double distance = source_.isDistant() ? 1e10 : towards.length();
  if (source_.reach > 0 && distance > source_.reach + source_.radius) return;
  if (source_.isVirtual() && -towards.dot(source_.beam.axis) < source_.beam.cosine * distance) return;
  match(
      source_.shape, [&](const PlaneLight& plane) { addPlane(plane, towards); },
      [&](const BallLight&) { addBall(towards, distance); },
      [&](const TubeLight& tube) { addTube(tube, towards); },
      [&](const DistantLight& cone) { addDistant(cone, distance); });
}

}  // namespace

void LightSources::sampleParts(LightId index, const V3d& point, const V3d& towards, const SourceSampling& how,
                               Random& random, std::vector<SourceSample>& samples) const {
  const LightSource& source = sources_[index];
  PartSampler(source, index, scene_, point, how, random, samples).sample(towards);
}

static_assert(kLightForms == 8, "What is the density of its samples?");
double LightSources::density(const SourceSample& hit, const V3d& point) const {
  const LightSource& source = sources_[hit.source];
  const double distance = hit.distance, cosine = std::abs(hit.cosine);
  if (const auto* plane = source.as<PlaneLight>()) {
    const bool near = isNear(source, *plane, {}, point, source.center - point) &&
                      plane->normal.dot(point - source.center) > scene_.samePlace;
    const double solidAngle = near ? solidAngleOf(source, *plane, {}, point) : 0;
    return solidAngle > 0 ? cosine / (distance * distance * solidAngle) : 1 / plane->area;
  }
  if (const auto* tube = source.as<TubeLight>()) {
    const V3d axis = tube->half.normalized(), towards = source.center - point;
    const double halfLength = tube->half.length(), radius = tube->area / (4 * halfLength),
                 along = towards.dot(axis), fromAxis = (towards - along * axis).length();
    if (fromAxis <= radius) return 0;
    const double across = distance * hit.direction.cross(axis).length();
    const double solidAngle = 2 * std::asin(radius / fromAxis) *
                              (sineAlong(along + halfLength, across) - sineAlong(along - halfLength, across));
    return solidAngle > 0 ? cosine / (distance * distance * solidAngle) : 0;
  }
  // Rays are uniform in the cone that the ball subtends. The law of cosines gives the distance to its center.
  const double r = source.radius, square = distance * distance + r * r + 2 * distance * r * cosine;
  const double sine2 = r * r / square;
  const double solidAngle = 2 * kPi * sine2 / (1 + std::sqrt(std::max(0., 1 - sine2)));
  return cosine / (distance * distance * solidAngle);
}

}  // namespace rsphere
