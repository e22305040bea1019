// Shading of surfaces whose BSDF is given by an XML file.
//
// Source: RADIANCE reference manual, "BSDF", "aBSDF". Unlike in the original, transmitted indirect rays also
// start behind the thickness, as the manual says. The data are constant over cells of directions, which may
// be wide. The view is therefore shifted at random by up to half the size of a cell, or less if -ss is below
// 1, so that no cell edges are visible.
#include <algorithm>
#include <cmath>

#include "transport/ray_functions.h"
#include "transport/ray_limits.h"
#include "transport/surface_shading.h"

namespace rsphere {

// A ray's hit in the frame of the BSDF data.
struct BsdfHit {
  const BsdfData& data;
  Interaction at;
  V3d normal{0, 0, 1};         // perturbed, on the side that the ray came from
  V3d x{0, 0, 0}, y{0, 0, 0};  // axes of the data's frame in the world
  V3d z{0, 0, 0};              // its normal, on the front
  V3d view{0, 0, 1};           // direction that the ray came from, in that frame
  V3d across{0, 0, 0};         // from the hit to the point where transmitted rays start (world units)
  DirectedScattering::Resolution resolution{};
  BsdfData::Through through{};  // the peak of straight transmission, times the pattern
  bool showsThrough = false;    // whether a ray follows the straight transmission
  Rgb unsampledReflection{0, 0, 0}, unsampledTransmission{0, 0, 0};

  V3d local(const V3d& d) const { return V3d(d.dot(x), d.dot(y), d.dot(z)).normalized(); }
  V3d world(const V3d& d) const { return (d.x * x + d.y * y + d.z * z).normalized(); }
};

bool SurfaceShading::shadeMaterial(Ray& ray, const BsdfMaterial& material, ModifierId behind) {
  if (passesBack(ray)) return true;
  const SurfaceFunctions& functions = t_.functions();
  const ModifierId f = material.functions;
  double thickness = material.proxy ? functions.thickness(f, functionPoint(ray), scratch_) : 0;
  if (std::abs(thickness) <= kNegligible) thickness = 0;
  // The geometry behind a proxy is traced itself by direct views and shadow rays, and by all rays that come
  // from its side.
  if (thickness != 0 && ((ray.kinds & kShadow) || !(ray.kinds & (kSpecular | kAmbient)) ||
                         (thickness > 0) != interaction(ray).front)) {
    follower_.pass(ray);
    return true;
  }
  if ((ray.kinds & kShadow) && !material.aperture) return true;

  const V3d up = functions.up(f, functionPoint(ray), scratch_);
  applyModifiers(ray, behind);
  BsdfHit hit{functions.bsdf(f), interaction(ray)};
  const bool front = hit.at.front;
  double cosine = 0;
  hit.normal = hit.at.perturbation.length2() > 0 ? perturbedNormal(hit.at, cosine) : hit.at.normal;
  hit.z = front ? hit.normal : -hit.normal;
  hit.x = up.cross(hit.z);
  if (!(hit.x.length2() > 0)) {
    functions.warn(f, "illegal orientation vector");
    return true;
  }
  hit.x.normalize();
  hit.y = hit.z.cross(hit.x);
  hit.view = hit.local(-ray.direction);
  // Rounding must not turn a view along the surface to the other side.
  hit.view.z = front ? std::max(hit.view.z, kNegligible) : std::min(hit.view.z, -kNegligible);
  hit.across = (front ? -thickness : thickness) * hit.at.normal;
  if (material.aperture && maxChannel(ray.pattern) > kNegligible) {
    hit.through = hit.data.through(hit.view);
    hit.through.peak *= ray.pattern;
    const bool straight = !(ray.kinds & (kSpecular | kAmbient));
    if (straight || (ray.kinds & kShadow)) {
      SharpPaths path;
      path.add({ray.direction, hit.through.peak, kTransmitted, true});
      specular_.follow(ray, path);
    }
    hit.showsThrough = straight && maxChannel(hit.through.peak) > kNegligible;
  }
  if (ray.kinds & kShadow) return true;

  hit.resolution = hit.data.resolution(hit.view);
  sampleBsdf(ray, hit, kReflectedSpecular);
  sampleBsdf(ray, hit, kTransmittedSpecular);

  const Rgb reflectance =
      (hit.data.diffuseReflectance(front) + (front ? material.diffuseFront : material.diffuseBack)) *
      ray.pattern;
  const Rgb transmittance =
      (hit.data.diffuseTransmittance(front) + material.diffuseTransmitted) * ray.pattern;
  const auto coefficient = [&](const V3d& toSource, double solidAngle, bool reflects, bool transmits) {
    const double c = hit.normal.dot(toSource);
    if (!(c > 0 ? reflects && c > kNegligible : transmits && c < -kNegligible)) return Rgb(0, 0, 0);
    const Rgb even = (c > 0 ? reflectance : transmittance) / kPi;
    const Rgb directed = directedBsdf(ray, hit, toSource, solidAngle) * (c > 0 ? Rgb(1, 1, 1) : ray.pattern);
    return (even + directed) * (std::abs(c) * solidAngle);
  };
  const auto direct = [&](bool reflects, bool transmits) {
    direct_.add(ray, [&](const V3d& toSource, double solidAngle) {
      return coefficient(toSource, solidAngle, reflects, transmits);
    });
  };
  const V3d hitPoint = ray.point;
  indirect_.add(ray, hit.normal, hit.at, kReflectedAmbient, reflectance + hit.unsampledReflection);
  direct(true, thickness == 0);
  ray.point = hitPoint + hit.across;
  indirect_.add(ray, hit.normal, hit.at, kTransmittedAmbient, transmittance + hit.unsampledTransmission);
  if (thickness != 0) direct(false, true);
  ray.point = hitPoint;
  return true;
}

V3d SurfaceShading::jittered(const V3d& view, double projectedSolidAngle) {
  const double width = std::sqrt(projectedSolidAngle) * std::min(t_.options().specularSampling, 1.);
  if (width <= kNegligible) return view;
  V3d v = view;
  v.x += width * (.5 - state_.random.uniform());
  v.y += width * (.5 - state_.random.uniform());
  return v.normalized();
}

// Follows sampled directions of the directed reflection or transmission. If its albedo is not above the
// specular threshold (-st), sets the unsampled coefficient of indirect light instead.
void SurfaceShading::sampleBsdf(Ray& ray, BsdfHit& hit, RayKind kind) {
  const RayOptions& o = t_.options();
  const bool transmits = kind == kTransmittedSpecular;
  const bool front = hit.at.front;
  const DirectedScattering* part = transmits ? hit.data.transmission(front) : hit.data.reflection(front);
  if (!part) return;
  const bool showsThrough = transmits && hit.showsThrough;
  const Rgb pattern = transmits ? ray.pattern : Rgb(1, 1, 1);
  const double share = part->albedo(jittered(hit.view, hit.resolution.coarsest)) -
                       (showsThrough ? brightness(hit.through.peak) : 0);
  if (share <= kNegligible) return;
  if (share <= o.specularThreshold + kNegligible) {
    (transmits ? hit.unsampledTransmission : hit.unsampledReflection) = pattern * share;
    return;
  }
  const double spread = o.specularSampling;
  int samples = spread > 1.5 ? samplesOf(t_, ray, spread) : 1;
  if (o.weightLimit > 0)  // not so many samples that each falls below the weight limit
    samples = std::max(1, static_cast<int>(std::min<double>(samples, share * ray.weight / o.weightLimit)));
  // If -ss is below 1, there is a single sample, and it is drawn nearer to the middle of the lobe.
  const auto place = [&](double u) { return spread < 1 ? .5 + spread * (u - .5) : u; };
  for (int i = 0; i < samples; ++i) {
    const V3d view = jittered(hit.view, hit.resolution.finest);
    const double u1 = place((i + state_.random.uniform()) / samples), u2 = place(state_.random.uniform());
    const double albedo = part->albedo(view);
    if (albedo <= kNegligible) continue;
    const V3d direction = part->sample(view, u1, u2);
    if (showsThrough) {
      const double dx = view.x + direction.x, dy = view.y + direction.y;
      if (dx * dx + dy * dy <= hit.resolution.finest) continue;
    }
    const Tristimulus value = part->cell(view, direction).value;
    Rgb coefficient = pattern * (albedo / samples);
    if (value.y > 0) coefficient *= rgbOf(value) / value.y;
    Ray child;
    if (!continueRay(t_, state_.random, child, kind, ray, coefficient)) continue;
    child.direction = hit.world(direction);
    if (transmits) child.origin += hit.across;
    follower_.follow(child);
    ray.value += child.value * coefficient;
  }
}

// The BSDF (1/sr) without its diffuse part for light from a source, averaged over views within a cell.
Rgb SurfaceShading::directedBsdf(const Ray& ray, const BsdfHit& hit, const V3d& toSource, double solidAngle) {
  const V3d other = hit.local(toSource);
  const DirectedScattering* part = hit.data.between(hit.view, other);
  if (!part) return Rgb(0, 0, 0);
  if (part->transmits() && maxChannel(hit.through.peak) > kNegligible) {
    // The peak of straight transmission is left to the ray that is followed through the surface. Only the
    // scattering around the peak remains within the width of the source plus that of the peak. The widths are
    // the diameters of circles of 2.5 times their areas.
    const double dx = other.x + hit.view.x, dy = other.y + hit.view.y;
    const double together = std::sqrt(solidAngle * std::abs(other.z)) + std::sqrt(part->finestCell());
    if (dx * dx + dy * dy <= 2.5 * 4 / kPi * together * together) return hit.through.around;
  }
  const double size = part->cell(hit.view, other).projectedSolidAngle;
  const int draws = size > 0 ? samplesOf(t_, ray, 4 * t_.options().specularSampling) : 1;
  // Cells smaller than this share of the cell of the view belong to a peak, whose light must not be spread
  // over a neighbouring cell.
  constexpr double kMuchFiner = .12;
  Rgb sum(0, 0, 0);
  int counted = 0;
  for (int i = 0; i < draws; ++i) {
    const auto cell = part->cell(jittered(hit.view, size), other);
    if (cell.value.y > kNegligible) {
      if (cell.projectedSolidAngle < kMuchFiner * size) continue;
      sum += rgbOf(cell.value);
    }
    ++counted;
  }
  return counted > 0 ? sum / counted : Rgb(0, 0, 0);
}

}  // namespace rsphere
