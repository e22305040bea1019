#include "rad_parser/rayinit/prism_panel.h"

#include <algorithm>
#include <cmath>

#include "rad_parser/error.h"

namespace rad {
namespace {

using Imath::V2d;
using Imath::V3d;

// open: the plane through the edges of the prisms, where light enters and leaves the grooves.
enum Side { flat, upper, lower, open };

constexpr int kMostSides = 100000, kMostDepth = 1000;

// Light in one direction. The two fields represent its polarization; initially they have unit length.
struct Beam {
  V3d direction;
  V3d fields[2];
  double share = 1;
  bool inside = false;
};

double cross(const V2d& u, const V2d& v) { return u.x * v.y - u.y * v.x; }

// The axes of polarization of light that hits a side with this normal: parallel and perpendicular to the
// plane of incidence.
struct Axes {
  V3d parallel, perpendicular;
};
Axes axesOf(const V3d& direction, const V3d& normal) {
  V3d perpendicular = normal.cross(direction);
  if (perpendicular.length2() < 1e-24) perpendicular = V3d(0, 0, 1);
  perpendicular.normalize();
  V3d parallel = direction.cross(perpendicular);
  if (parallel.dot(normal) < 0) parallel = -parallel;
  return {parallel.normalized(), perpendicular};
}

class Trace {
 public:
  explicit Trace(const PrismPanel& panel)
      : panel_(panel),
        foot_(0, 0),
        edge_(panel.height, panel.b),
        valley_(0, panel.a + panel.b),
        nextEdge_(panel.height, panel.a + 2 * panel.b),
        normals_{V3d(-1, 0, 0), V3d(panel.a, panel.height, 0).normalized(),
                 V3d(panel.b, -panel.height, 0).normalized()} {}

  PanelRays of(const V3d& direction) {
    Beam beam{direction, {}};
    const Axes axes = axesOf(direction, V3d(1, 0, 0));
    beam.fields[0] = axes.parallel;
    beam.fields[1] = axes.perpendicular;
    if (direction.x > 0) {
      meet(beam, flat, 0);
    } else {
      goOn(beam, open, 0);
    }
    return rays_;
  }

 private:
  // Follows light that leaves a side to the next sides.
  void goOn(const Beam& beam, Side from, int depth) {
    if (!(beam.share > panel_.threshold)) return;
    if (beam.inside) {
      if (from == flat) split(beam, valley_, foot_, edge_, upper, lower, depth);
      if (from == upper) split(beam, valley_, edge_, foot_, flat, lower, depth);
      if (from == lower) split(beam, foot_, edge_, valley_, flat, upper, depth);
    } else {
      if (from == flat) leave(beam);
      if (from == upper) split(beam, valley_, edge_, nextEdge_, lower, open, depth);
      if (from == lower) split(beam, valley_, nextEdge_, edge_, upper, open, depth);
      if (from == open) split(beam, edge_, nextEdge_, valley_, upper, lower, depth);
    }
  }

  // Follows light from the side pq of a triangle to its sides rp and rq. A line through r along the beam
  // divides pq into the parts from which light hits each of these sides.
  void split(const Beam& beam, const V2d& p, const V2d& q, const V2d& r, Side rp, Side rq, int depth) {
    const V2d along(beam.direction.x, beam.direction.y);
    const double width = cross(q - p, along);
    if (width == 0) return;
    const double toP = std::clamp(cross(r - p, along) / width, 0., 1.);
    pass(beam, toP, rp, depth);
    pass(beam, 1 - toP, rq, depth);
  }

  void pass(Beam beam, double part, Side to, int depth) {
    beam.share *= part;
    if (!(beam.share > panel_.threshold)) return;
    if (to == open) return leave(beam);
    meet(beam, to, depth + 1);
  }

  // Reflection and refraction at a side. Source: Born and Wolf, 1.5.2.
  void meet(const Beam& beam, Side side, int depth) {
    if (++sides_ > kMostSides || depth > kMostDepth)
      throw Error("too many reflections in a prism panel: its threshold is too low");
    const V3d& normal = normals_[side];
    const double along = beam.direction.dot(normal), cosine = std::abs(along);
    const double ratio = beam.inside ? 1 / panel_.index : panel_.index;
    // The square of ratio times the cosine of the angle of refraction.
    const double beyond2 = ratio * ratio - (1 - cosine * cosine);
    const bool isCoated = (side == upper && panel_.coated == PrismPanel::Coated::upper) ||
                          (side == lower && panel_.coated == PrismPanel::Coated::lower);

    Beam reflected = beam;
    reflected.direction = (beam.direction - 2 * along * normal).normalized();
    if (isCoated || beyond2 < 0) {
      change(beam, reflected, normal, 1, 1, 0);
      reflected.share = beam.share * (isCoated ? panel_.coating : 1);
      return goOn(reflected, side, depth);
    }
    const double beyond = std::sqrt(beyond2), dense = ratio * ratio * cosine;
    change(beam, reflected, normal, (dense - beyond) / (dense + beyond),
           (cosine - beyond) / (cosine + beyond), 1);
    goOn(reflected, side, depth);

    Beam refracted = beam;
    refracted.inside = !beam.inside;
    const V3d tangent = beam.direction - along * normal;
    refracted.direction = ((tangent + std::copysign(beyond, along) * normal) / ratio).normalized();
    change(beam, refracted, normal, 2 * ratio * cosine / (dense + beyond), 2 * cosine / (cosine + beyond),
           beyond / cosine);
    goOn(refracted, side, depth);
  }

  // Computes the fields of `to` from those of `from` with the amplitudes along both axes; and its share, from
  // the remaining energy of the fields times factor.
  void change(const Beam& from, Beam& to, const V3d& normal, double parallel, double perpendicular,
              double factor) {
    const Axes before = axesOf(from.direction, normal), after = axesOf(to.direction, normal);
    double kept = 0;
    for (int i = 0; i < 2; ++i) {
      const V3d& field = from.fields[i];
      to.fields[i] = field.dot(before.parallel) * parallel * after.parallel +
                     field.dot(before.perpendicular) * perpendicular * after.perpendicular;
      if (field.length2() > 0) kept += .5 * to.fields[i].length2() / field.length2();
    }
    to.share = from.share * kept * factor;
  }

  void leave(const Beam& beam) {
    if (!(beam.share > panel_.threshold)) return;
    const double angle = std::atan2(beam.direction.y, beam.direction.x);
    for (PanelRay& ray : rays_.all()) {
      if (std::abs(std::atan2(ray.direction.y, ray.direction.x) - angle) > panel_.tolerance) continue;
      ray.share += beam.share;
      return;
    }
    if (rays_.count == PanelRays::kMost)
      throw Error("too many directions from a prism panel: its threshold or tolerance is too low");
    rays_.rays[rays_.count++] = {beam.direction, beam.share};
  }

  const PrismPanel& panel_;
  // For two neighbouring prisms: the start of the first, its edge, the valley between them, and the edge of
  // the second.
  V2d foot_, edge_, valley_, nextEdge_;
  V3d normals_[3];  // of the glass, outwards, by Side
  PanelRays rays_;
  int sides_ = 0;
};

}  // namespace

PanelRays raysThrough(const PrismPanel& panel, const V3d& direction) { return Trace(panel).of(direction); }

}  // namespace rad
