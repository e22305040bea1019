#pragma once
// Scattering by a surface whose BSDF is given by an XML file.
//
// Source: RADIANCE reference manual, "BSDF", "aBSDF". Unlike in the original, transmitted indirect rays also
// start behind the thickness, as the manual says. The data are constant over cells of directions, which may
// be wide. The view is therefore shifted at random by up to half the size of a cell, or less if -ss is below
// 1, so that no cell edges are visible.
#include "shade/bsdf.h"
#include "shade/surface_scattering.h"

namespace rsphere {

// The frame of BSDF data at a hit, in the world: z is its normal, on the front, and y is up.
struct BsdfFrame {
  V3d normal{0, 0, 1};  // perturbed, on the side that the ray came from
  V3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  V3d local(const V3d& d) const { return V3d(d.dot(x), d.dot(y), d.dot(z)).normalized(); }
  V3d world(const V3d& d) const { return (d.x * x + d.y * y + d.z * z).normalized(); }
};

// up: of any length, in the world. Empty if it is parallel to the normal, or 0.
std::optional<BsdfFrame> bsdfFrame(const Interaction& at, const V3d& up);

// A model of scattering; see surface_scattering.h for its members.
class BsdfScattering {
 public:
  // Keeps a reference to the data. thickness (world units): of the geometry behind the front that the surface
  // hides; transmitted light passes through it. views: over how many views within a cell the scattering of
  // direct light is averaged.
  BsdfScattering(const BsdfMaterial& material, const BsdfData& data, const Interaction& at,
                 const BsdfFrame& frame, double thickness, int views, const MaterialOptions& options);

  const SharpPaths& sharp() const { return sharp_; }
  Components components() const { return kComponents; }
  std::optional<Lobe> lobe(Component component, Random& random);
  LobeSample draw(Component component, int i, int n, Random& random) const;
  Coefficient indirect(Component component) const {
    return Coefficient(component == Component::reflected ? reflectance_ + unsampledReflection_
                                                         : transmittance_ + unsampledTransmission_);
  }
  const V3d& normal(Component) const { return frame_.normal; }
  const V3d& trueNormal() const { return at_.normal; }
  // Transmitted light arrives behind the thickness, and so does that of sources behind. Without a thickness,
  // the direct light of both sides is estimated at the same point, and together.
  const V3d& offset(Component component) const {
    return component == Component::reflected ? kNoOffset : across_;
  }
  bool takesDirect(Component component) const { return component == Component::reflected || thick_; }
  const V3d& front() const { return kNoFront; }
  Coefficient coefficient(Component component, const V3d& toSource, double solidAngle, Random& random) const;
  double lobeDensity(Component, const V3d&) const { return 0; }
  Color lobeShare(Component) const { return {}; }
  bool isEven() const { return false; }

 private:
  const DirectedScattering* part(Component component) const {
    return component == Component::transmitted ? data_->transmission(at_.front)
                                               : data_->reflection(at_.front);
  }
  V3d jittered(const V3d& view, double projectedSolidAngle, Random& random) const;
  Color directed(const V3d& toSource, double solidAngle, Random& random) const;

  const BsdfData* data_;
  Interaction at_;
  BsdfFrame frame_;
  bool thick_;
  int views_;
  double threshold_, spread_;    // -st, -ss
  V3d view_{0, 0, 1};            // direction that the ray came from, in the frame
  V3d across_{0, 0, 0};          // from the hit to where transmitted rays start (world units)
  BsdfData::Through through_{};  // the peak of straight transmission, times the pattern
  bool showsThrough_ = false;    // whether a ray follows the straight transmission
  SharpPaths sharp_;
  DirectedScattering::Resolution resolution_{};
  Color reflectance_{0, 0, 0}, transmittance_{0, 0, 0};                  // of the diffuse parts
  Color unsampledReflection_{0, 0, 0}, unsampledTransmission_{0, 0, 0};  // of lobes too weak to be sampled
};

}  // namespace rsphere
