#include "shade/bsdf_scattering.h"

#include <algorithm>
#include <cmath>

namespace rsphere {

static_assert(ScattersLight<BsdfScattering>);

std::optional<BsdfFrame> bsdfFrame(const Interaction& at, const V3d& up) {
  BsdfFrame frame;
  double cosine = 0;
  frame.normal = at.perturbation.length2() > 0 ? perturbedNormal(at, cosine) : at.normal;
  frame.z = at.front ? frame.normal : -frame.normal;
  frame.x = up.cross(frame.z);
  if (!(frame.x.length2() > 0)) return {};
  frame.x.normalize();
  frame.y = frame.z.cross(frame.x);
  return frame;
}

BsdfScattering::BsdfScattering(const BsdfMaterial& material, const BsdfData& data, const Interaction& at,
                               const BsdfFrame& frame, double thickness, int views,
                               const MaterialOptions& options)
    : UsualScattering(at),
      data_(&data),
      frame_(frame),
      thick_(thickness != 0),
      views_(views),
      threshold_(options.specularThreshold),
      spread_(options.specularSampling) {
  const bool front = at.front;
  view_ = frame.local(-at.direction);
  // Rounding must not move a grazing view to the other side.
  view_.z = front ? std::max(view_.z, kNegligible) : std::min(view_.z, -kNegligible);
  across_ = (front ? -thickness : thickness) * at.normal;
  if (material.aperture && maxChannel(at.pattern) > kNegligible) {
    through_ = data.through(view_);
    through_.peak *= at.pattern;
    const bool straight = !(at.kinds & (kSpecular | kAmbient));
    if (straight || (at.kinds & kShadow))
      sharp_.add({at.direction, Coefficient(through_.peak), kTransmitted, true});
    showsThrough_ = straight && maxChannel(through_.peak) > kNegligible;
  }
  if (at.kinds & kShadow) return;
  resolution_ = data.resolution(view_);
  reflectance_ =
      (data.diffuseReflectance(front) + (front ? material.diffuseFront : material.diffuseBack)) * at.pattern;
  transmittance_ = (data.diffuseTransmittance(front) + material.diffuseTransmitted) * at.pattern;
}

V3d BsdfScattering::jittered(const V3d& view, double projectedSolidAngle, Random& random) const {
  const double width = std::sqrt(projectedSolidAngle) * std::min(spread_, 1.);
  if (width <= kNegligible) return view;
  V3d v = view;
  v.x += width * (.5 - random.uniform());
  v.y += width * (.5 - random.uniform());
  return v.normalized();
}

// If the albedo of the directed part is at most the specular threshold (-st), it is not sampled but added to
// the indirect light.
std::optional<Lobe> BsdfScattering::lobe(Component component, Random& random) {
  const bool transmits = component == Component::transmitted;
  const DirectedScattering* directed = part(component);
  if (!directed) return {};
  const double share = directed->albedo(jittered(view_, resolution_.coarsest, random)) -
                       (transmits && showsThrough_ ? brightness(through_.peak) : 0);
  if (share <= kNegligible) return {};
  if (share <= threshold_ + kNegligible) {
    (transmits ? unsampledTransmission_ : unsampledReflection_) =
        (transmits ? at_.pattern : Color(1, 1, 1)) * share;
    return {};
  }
  return Lobe{.share = share, .offset = transmits ? across_ : kNoOffset};
}

LobeSample BsdfScattering::draw(Component component, int i, int n, Random& random) const {
  const DirectedScattering& directed = *part(component);
  const bool transmits = component == Component::transmitted;
  // With -ss below 1 there is a single sample, drawn nearer to the middle of the lobe.
  const auto place = [&](double u) { return spread_ < 1 ? .5 + spread_ * (u - .5) : u; };
  const V3d view = jittered(view_, resolution_.finest, random);
  const double u1 = place((i + random.uniform()) / n), u2 = place(random.uniform());
  const double albedo = directed.albedo(view);
  if (albedo <= kNegligible) return {};
  const V3d direction = directed.sample(view, u1, u2);
  if (transmits && showsThrough_) {
    const double dx = view.x + direction.x, dy = view.y + direction.y;
    if (dx * dx + dy * dy <= resolution_.finest) return {};
  }
  const Tristimulus value = directed.cell(view, direction).value;
  Color coefficient = (transmits ? at_.pattern : Color(1, 1, 1)) * (albedo / n);
  if (value.y > 0) coefficient *= rgbOf(value) / value.y;
  return {frame_.world(direction), Coefficient(coefficient)};
}

Coefficient BsdfScattering::coefficient(Component component, const V3d& toSource, double solidAngle,
                                        Random& random) const {
  const bool reflects = component == Component::reflected, transmits = !thick_ || !reflects;
  const double c = frame_.normal.dot(toSource);
  if (!(c > 0 ? reflects && c > kNegligible : transmits && c < -kNegligible)) return {};
  const Color even = (c > 0 ? reflectance_ : transmittance_) / kPi;
  const Color uneven = directed(toSource, solidAngle, random) * (c > 0 ? Color(1, 1, 1) : at_.pattern);
  return Coefficient((even + uneven) * (std::abs(c) * solidAngle));
}

// The BSDF (1/sr) without its diffuse part, for light from a source, averaged over views within a cell.
Color BsdfScattering::directed(const V3d& toSource, double solidAngle, Random& random) const {
  const V3d other = frame_.local(toSource);
  const DirectedScattering* part = data_->between(view_, other);
  if (!part) return Color(0, 0, 0);
  if (part->transmits() && maxChannel(through_.peak) > kNegligible) {
    // The peak of undeflected transmission is left to the ray that continues through the surface. Within the
    // sum of the widths of the source and the peak, only the scattering around the peak is returned. Widths
    // are the diameters of circles of 2.5 times the areas.
    const double dx = other.x + view_.x, dy = other.y + view_.y;
    const double together = std::sqrt(solidAngle * std::abs(other.z)) + std::sqrt(part->finestCell());
    if (dx * dx + dy * dy <= 2.5 * 4 / kPi * together * together) return through_.around;
  }
  const double size = part->cell(view_, other).projectedSolidAngle;
  const int draws = size > 0 ? views_ : 1;
  // Cells smaller than this fraction of the view's cell belong to a peak, whose light must not be spread over
  // a neighbouring cell.
  constexpr double kMuchFiner = .12;
  Color sum(0, 0, 0);
  int counted = 0;
  for (int i = 0; i < draws; ++i) {
    const auto cell = part->cell(jittered(view_, size, random), other);
    if (cell.value.y > kNegligible) {
      if (cell.projectedSolidAngle < kMuchFiner * size) continue;
      sum += rgbOf(cell.value);
    }
    ++counted;
  }
  return counted > 0 ? sum / counted : Color(0, 0, 0);
}

}  // namespace rsphere
