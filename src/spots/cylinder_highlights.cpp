#include "spots/cylinder_highlights.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "spots/ball_reflection.h"
#include "spots/tuning.h"

namespace rsphere {
namespace {

V3d across(const Cone& cylinder, const V3d& way) { return way - way.dot(cylinder.axis) * cylinder.axis; }

V3d nearestOnAxis(const Cone& cylinder, const V3d& place) {
  return cylinder.base +
         std::clamp((place - cylinder.base).dot(cylinder.axis), 0., cylinder.length) * cylinder.axis;
}

// The fraction of a normal distribution that lies in an interval.
double shareWithin(double low, double high, double mean, double variance) {
  const double scale = 1 / std::sqrt(2 * variance);
  return (std::erf((high - mean) * scale) - std::erf((low - mean) * scale)) / 2;
}

}  // namespace

CylinderHighlights::CylinderHighlights(const Scene& scene, const Tracer& tracer, const LightSources& lights,
                                       double least) {
  const auto size = [](const Cone& cone) {
    return cone.radius0 == cone.radius1 ? cone.radius0 * cone.length : 0;
  };
  const auto reflectors = largestReflectors<Cone>(scene, tuning::Caps::kAsked, size);
  if (reflectors.empty()) return;
  const BrightestSources sources(scene, lights);
  for (const auto& r : reflectors)
    if (Cylinder cylinder = lit(*r.shape, *r.material, tracer, sources); !cylinder.parts.empty())
      cylinders_.push_back(std::move(cylinder));
  keepLargest(cylinders_, cylinders_.size(), [](const Cylinder& cylinder) { return cylinder.hot; });
  std::vector<ReachGrid::Reach> reaches;
  for (const Cylinder& c : cylinders_) {
    // At distances beyond `whole`, a highlight is longer than the cylinder, which shows only a part of it.
    const double whole = c.shape.length / (2 * std::sqrt(kPi) * c.roughness), reach = c.hot / least;
    reaches.push_back({c.shape.base, c.shape.base + c.shape.length * c.shape.axis,
                       reach > whole ? std::sqrt(reach * whole) : reach});
  }
  if (!reaches.empty()) near_ = ReachGrid(reaches, tracer.bounds());
}

// Finds the sources that light a cylinder of radius r. If the plane of reflection is perpendicular to the
// axis, the image of a distant source, seen from a distance d, has r / 2d times the solid angle of the source
// as seen from the cylinder. In other planes, cosines change this by a factor near 1.
CylinderHighlights::Cylinder CylinderHighlights::lit(const Cone& shape, const Opaque& material,
                                                     const Tracer& tracer, const BrightestSources& sources) {
  Cylinder cylinder{shape, material.roughness, 0, {}};
  const double reflectance = reflectanceOf(material), radius = shape.radius0;
  struct Candidate {
    Part part;
    double bright;
  };
  std::vector<Candidate> candidates;
  const auto placeFor = [&](const LightSource& source) {
    return source.isDistant() ? shape.base + shape.length / 2 * shape.axis
                              : nearestOnAxis(shape, source.center);
  };
  Box3d places(shape.base);
  places.extendBy(shape.base + shape.length * shape.axis);
  const size_t kMost = tuning::Caps::kAimed / 2;
  for (const LightingPart& part : sources.at(places, radius, kMost, placeFor)) {
    const double solidAngle = part.solidAngle(placeFor(*part.source));
    const double radiance = reflectance * part.radiance;
    const double spread = cylinder.roughness * cylinder.roughness + solidAngle / (8 * kPi);
    const double bright = radiance * solidAngle * radius / 2;
    const double hot = bright * bright / (4 * kPi * kPi * radius * spread);
    if (hot > 0) candidates.push_back({{part, radiance, hot}, bright});
  }
  keepLargest(candidates, kMost, [](const Candidate& c) { return c.bright; });
  for (const Candidate& c : candidates) {
    const bool seen = std::any_of(
        std::begin(tuning::Highlights::kPlaces), std::end(tuning::Highlights::kPlaces), [&](double share) {
          const V3d place = shape.base + share * shape.length * shape.axis;
          const V3d out = across(shape, c.part.lighting.part.towards(place));
          const double length = out.length();
          return length > (c.part.lighting.part.distant ? 0 : radius) &&
                 seesPart(tracer, c.part.lighting, place + (radius + 2 * tracer.samePlace()) / length * out);
        });
    if (!seen) continue;
    cylinder.hot += c.part.hot;
    cylinder.parts.push_back(c.part);
  }
  return cylinder;
}

// The reflection minimizes the length of the path from the source to the point. In projection along the axis,
// the reflecting place is therefore that of a circle, whatever the heights of source and point. Its height
// follows from unrolling the cylinder, which makes the path straight.
void CylinderHighlights::aim(const V3d& point, const V3d& front, double least, Aim& aim) const {
  aim.clear();
  const double leastOfOne = least / tuning::Highlights::kLeastOfFew;
  double variance = 0;
  for (const uint32_t number : near_.at(point)) {
    const Cylinder& cylinder = cylinders_[number];
    const Cone& shape = cylinder.shape;
    const double radius = shape.radius0;
    const V3d way = shape.base - point;
    if (!(way.dot(front) + std::max(0., shape.length * shape.axis.dot(front)) > -radius)) continue;
    const V3d at = across(shape, -way);
    const double height = -way.dot(shape.axis);
    if (!(at.length2() > tuning::Highlights::kApart * tuning::Highlights::kApart * radius * radius)) continue;
    const double enough = leastOfOne * (point - nearestOnAxis(shape, point)).length();
    for (const Part& p : cylinder.parts) {
      if (aim.count == tuning::Caps::kAimed / 2) break;
      if (!(p.hot > enough)) continue;
      const SourcePart& part = p.lighting.part;
      const V3d to = part.distant ? part.center : part.center - shape.base, side = across(shape, to);
      const double beside = side.length();
      if (!(beside > (part.distant ? tuning::Highlights::kEdgeOn : tuning::Highlights::kApart * radius)))
        continue;
      const V3d normal = mirroringNormal({.center = V3d(0, 0, 0), .radius = radius}, at,
                                         part.distant ? side / beside : side, part.distant);
      const double near = (at - radius * normal).length(), far = (side - radius * normal).length();
      const double place = height + near * (part.distant ? to.dot(shape.axis) / beside
                                                         : (to.dot(shape.axis) - height) / (near + far));
      // If the middle of the highlight lies within one length beyond an end, its edge may still lie on the
      // cylinder.
      if (place < -shape.length || place > 2 * shape.length) continue;
      const V3d mirror = shape.base + place * shape.axis + radius * normal;
      const V3d out = (mirror - point).normalized();
      const double cosine = out.dot(front);
      if (!(cosine > 0 && out.dot(normal) < 0)) continue;
      const Highlight highlight(mirror, normal, {.radius = radius, .straight = shape.axis},
                                cylinder.roughness, part, point);
      const double share = shareWithin(0, shape.length, place, highlight.lengthwise);
      const double whole = p.radiance * p.lighting.solidAngle(mirror) * highlight.magnified,
                   bright = whole * share;
      const double adds = whole * bright * cosine / (4 * kPi * kPi * highlight.spread);
      if (!(adds > leastOfOne)) continue;
      aim.lobe[aim.count] = highlight.lobe;
      aim.add(number, bright * cosine);
      variance += adds;
    }
  }
  if (variance > least)
    aim.finish(point);
  else
    aim.clear();
}

// Whether a ray meets the outside of a cylinder.
bool CylinderHighlights::meets(const Cone& cylinder, const V3d& point, const V3d& direction) {
  const V3d way = point - cylinder.base, at = across(cylinder, way), ahead = across(cylinder, direction);
  const double square = ahead.length2(), along = at.dot(ahead), radius = cylinder.radius0;
  const double rest = along * along - square * (at.length2() - radius * radius);
  if (!(along < 0 && rest > 0)) return false;
  const double distance = (-along - std::sqrt(rest)) / square;
  const double height = (way + distance * direction).dot(cylinder.axis);
  return distance > 0 && height >= 0 && height <= cylinder.length;
}

V3d CylinderHighlights::sample(const Aim& aim, double u1, double u2, double u3) const {
  const size_t i = aim.chosen(u1);
  const V3d direction = aim.lobe[i].sample(u2, u3);
  const bool counts =
      aim.lobe[i].density(direction, tuning::Highlights::kReach * tuning::Highlights::kReach) > 0 &&
      meets(cylinders_[aim.number[i]].shape, aim.point, direction);
  return counts ? direction : V3d(0, 0, 0);
}

double CylinderHighlights::density(const Aim& aim, const V3d& direction) const {
  double sum = 0;
  uint32_t last = ~0u;
  bool met = false;
  for (size_t i = 0; i < aim.count; ++i) {
    const double density =
        aim.lobe[i].density(direction, tuning::Highlights::kReach * tuning::Highlights::kReach);
    if (!(density > 0)) continue;
    if (aim.number[i] != last) {
      last = aim.number[i];
      met = meets(cylinders_[last].shape, aim.point, direction);
    }
    if (met) sum += (aim.upTo[i] - aim.before(i)) * density;
  }
  return aim.count > 0 ? sum / aim.before(aim.count) : 0;
}

}  // namespace rsphere
