#include "spots/highlight_lobe.h"

#include <algorithm>

#include "base/frame.h"

namespace rsphere {
namespace {

struct Symmetric {
  double xx, xy, yy;

  double determinant() const { return xx * yy - xy * xy; }
  Symmetric inverse() const { return {yy / determinant(), -xy / determinant(), xx / determinant()}; }
  // Returns this * m * this.
  Symmetric around(const Symmetric& m) const {
    const double ax = xx * m.xx + xy * m.xy, ay = xx * m.xy + xy * m.yy;  // first row of this * m
    const double bx = xy * m.xx + yy * m.xy, by = xy * m.xy + yy * m.yy;
    return {ax * xx + ay * xy, ax * xy + ay * yy, bx * xy + by * yy};
  }
};

}  // namespace

Highlight::Highlight(const V3d& at, const V3d& normal, const Bend& bend, double roughness,
                     const SourcePart& part, const V3d& point) {
  const double length = (point - at).length();
  const V3d in = (point - at) / length, way = part.towards(at);
  const double toSource = way.length();
  const V3d out = way / toSource;
  const double cosine = std::max(normal.dot(in), tuning::Highlights::kEdgeOn);
  // The tangents across the plane of incidence and in it.
  V3d across = normal.cross(in);
  across = across.length2() > 1e-12 ? across.normalized() : frame(normal).first;
  const V3d along = across.cross(normal);
  // Twice the covariance of the difference between the normal and the bisector, over the roughness and over
  // all points of the source.
  Symmetric apart{roughness * roughness, 0, roughness * roughness};
  for (const V3d& half : {part.u, part.v}) {
    const V3d angle = (half - half.dot(out) * out) / (part.distant ? 1 : toSource);
    const double x = angle.dot(across) / (2 * cosine), y = angle.dot(along) / (2 * cosine);
    apart.xx += 2 * part.variance * x * x;
    apart.xy += 2 * part.variance * x * y;
    apart.yy += 2 * part.variance * y * y;
  }
  // The rate at which the difference of bisector and normal changes along the surface (per length).
  const double bends = 1 / length + (part.distant ? 0 : 1 / toSource), curved = 1 / bend.radius;
  const double x = bend.straight.dot(across), y = bend.straight.dot(along);
  const Symmetric rate{curved * (1 - x * x) + bends / (2 * cosine), -curved * x * y,
                       curved * (1 - y * y) + bends * cosine / 2};
  const Symmetric place = rate.inverse().around(apart);
  lengthwise = (x * x * place.xx + 2 * x * y * place.xy + y * y * place.yy) / 2;
  magnified = 1 / (4 * length * length * rate.determinant());
  spread = std::sqrt(apart.determinant()) * cosine / (2 * length * length * rate.determinant());
  // The distribution of reflecting places, as directions from the point.
  const double a = tuning::Highlights::kWider / length, b = a * cosine;
  lobe = HighlightLobe(-in, across, (along - along.dot(in) * in).normalized(), a * a * place.xx,
                       a * b * place.xy, b * b * place.yy);
}

static_assert(kMaterialTypes == 19, "Has it a lobe of one width?");
const Opaque* roughReflector(const Scene& scene, const Surface& surface) {
  const Material* any = scene.materialOf(surface);
  const auto* material = any ? std::get_if<Opaque>(any) : nullptr;
  if (!material || !(material->roughness * material->roughness > kNegligible)) return nullptr;
  return material->specularity > 0 ? material : nullptr;
}

double reflectanceOf(const Opaque& material) {
  return material.specularity * (material.metal ? brightness(material.color) : 1);
}

}  // namespace rsphere
