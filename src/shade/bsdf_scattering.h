#pragma once
// Scattering by a surface whose BSDF is given by an XML file.
//
// Source: RADIANCE reference manual, "BSDF", "aBSDF". As the manual says, but unlike in the original,
// transmitted indirect rays also start behind the thickness. The data are constant over cells of directions,
// which may be wide. To hide cell edges, the view is shifted at random by up to half the size of a cell, or
// less if -ss is below 1.
#include "shade/bsdf.h"
#include "shade/surface_scattering.h"

namespace rsphere {

// The frame of BSDF data at a hit, in world coordinates: z is the normal on the front, and y is up.
struct BsdfFrame {
  V3d normal{0, 0, 1};  // perturbed, on the side that the ray came from
  V3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  V3d local(const V3d& d) const { return V3d(d.dot(x), d.dot(y), d.dot(z)).normalized(); }
  V3d world(const V3d& d) const { return (d.x * x + d.y * y + d.z * z).normalized(); }
};

// up: of any length, in the world. Empty if it is 0 or parallel to the normal.
std::optional<BsdfFrame> bsdfFrame(const Interaction& at, const V3d& up);

// Fulfils the concept ScattersLight (surface_scattering.h).
class BsdfScattering : public UsualScattering {
 public:
  // Keeps a reference to the data. thickness (world units): of the hidden geometry behind the front;
  // transmitted light starts behind it. views: number of views within a cell over which the scattering of
  // direct light is averaged.
  BsdfScattering(const BsdfMaterial& material, const BsdfData& data, const Interaction& at,
                 const BsdfFrame& frame, double thickness, int views, const MaterialOptions& options);

  const SharpPaths& sharp() const { return sharp_; }
  std::optional<Lobe> lobe(Component component, Random& random);
  LobeSample draw(Component component, int i, int n, Random& random) const;
  Coefficient indirect(Component component) const {
    return Coefficient(component == Component::reflected ? reflectance_ + unsampledReflection_
                                                         : transmittance_ + unsampledTransmission_);
  }
  const V3d& normal(Component) const { return frame_.normal; }
  // Transmitted light, also of sources behind the surface, arrives behind the thickness. Without a thickness,
  // both sides get their direct light at the same point, in a single estimate.
  const V3d& offset(Component component) const {
    return component == Component::reflected ? kNoOffset : across_;
  }
  bool takesDirect(Component component) const { return component == Component::reflected || thick_; }
  Coefficient coefficient(Component component, const V3d& toSource, double solidAngle, Random& random) const;

 private:
  const DirectedScattering* part(Component component) const {
    return component == Component::transmitted ? data_->transmission(at_.front)
                                               : data_->reflection(at_.front);
  }
  V3d jittered(const V3d& view, double projectedSolidAngle, Random& random) const;
  Color directed(const V3d& toSource, double solidAngle, Random& random) const;

  const BsdfData* data_;
  BsdfFrame frame_;
  bool thick_;
  int views_;
  double threshold_, spread_;    // -st, -ss
  V3d view_{0, 0, 1};            // direction to the ray's origin, in the frame
  V3d across_{0, 0, 0};          // from the hit to the start of transmitted rays (world units)
  BsdfData::Through through_{};  // peak of undeflected transmission, times the pattern
  bool showsThrough_ = false;    // whether a ray follows the undeflected transmission
  SharpPaths sharp_;
  DirectedScattering::Resolution resolution_{};
  Color reflectance_{0, 0, 0}, transmittance_{0, 0, 0};                  // of the diffuse parts
  Color unsampledReflection_{0, 0, 0}, unsampledTransmission_{0, 0, 0};  // of lobes too weak to be sampled
};

}  // namespace rsphere
