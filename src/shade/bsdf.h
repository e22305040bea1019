#pragma once
// Bidirectional scattering distribution functions from XML files: evaluation and sampling.
//
// Directions are unit vectors that point away from the surface, in its local frame: z is its normal, so that
// z > 0 is the front, and y is "up". Scattering depends on the view and another direction. The view is looked
// up as the direction of incident light in the data. If the data lack transmission for light from the side of
// the view, the transmission from the other side is used with exchanged directions (Helmholtz reciprocity).
//
// Sources: WINDOW 6's Klems matrices; Ward et al., LBNL-6535E, 2012 (tensor trees); Shirley and Chiu, "A low
// distortion map between disk and square", JGT 2/3, 1997; RADIANCE's notes on BSDF directions.
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>

#include "base/color.h"
#include "rad_parser/tables/bsdf_file.h"

namespace rsphere {

using Tristimulus = V3d;  // values x, y, z; y is luminance
// Converts to RADIANCE's primaries and white point. Colors outside their gamut are mixed with gray of the
// same luminance until no channel is negative.
Color rgbOf(const Tristimulus& c);

// One of the four components of a BSDF file, without its diffuse part.
class DirectedScattering {
 public:
  // incidentFront, scatteredFront: whether the light arrives and leaves at the front.
  DirectedScattering(bool incidentFront, bool scatteredFront)
      : incidentFront_(incidentFront), scatteredFront_(scatteredFront) {}
  virtual ~DirectedScattering() = default;

  bool transmits() const { return incidentFront_ != scatteredFront_; }
  // Whether views on this side use the data with exchanged directions.
  bool turned(const V3d& view) const { return transmits() && (view.z > 0) != incidentFront_; }

  // A cell of the data for a pair of directions: the view and the other direction.
  struct Cell {
    Tristimulus value{0, 0, 0};      // 1/sr, without the diffuse part
    double projectedSolidAngle = 0;  // sr: of the view's cell or of the other direction's, the smaller one
    uint64_t number = 0;
  };
  // The value is 0 if one of the directions is outside the range of the data.
  virtual Cell cell(const V3d& view, const V3d& other) const = 0;

  // The fraction of the luminance that is scattered into all directions together.
  virtual double albedo(const V3d& view) const = 0;
  // Samples a direction for uniform u1, u2 in [0, 1). Its density by projected solid angle is proportional to
  // luminance. REQUIRES an albedo above 0.
  virtual V3d sample(const V3d& view, double u1, double u2) const = 0;

  // Projected solid angles (sr) of the cells for a view.
  struct Resolution {
    double finest = 0, coarsest = 0;  // 0: no data
  };
  virtual Resolution resolution(const V3d& view) const = 0;
  // Prepares albedo() and sample() for views for which turned() is true: they come from the side that has no
  // data, and use the data of the other side with the two directions exchanged. Returns false for isotropic
  // tensor trees, for which the albedo of these views is 0: they store one angle less, so that exchanged
  // directions do not determine the scattering.
  virtual bool prepareTurned() = 0;
  // The projected solid angle (sr) of the smallest cell, and the largest albedo of any view.
  double finestCell() const { return finestCell_; }
  double largestAlbedo() const { return largestAlbedo_; }

 protected:
  bool incidentFront_, scatteredFront_;
  double finestCell_ = 0, largestAlbedo_ = 0;
};

// The data of a file, prepared for sampling. Immutable: threads may use it at the same time.
class BsdfData {
 public:
  // name: of the file, for messages. Warns if the data scatter more light than arrives, or if they do not
  // determine the transmission from one side.
  BsdfData(const rad::BsdfFile& file, std::string_view name, const rad::Warn& warn);

  // The fraction of light that is scattered diffusely, by the side of the view: the smallest value of the
  // data, or 0 if it is less than 1% of the light. All other scattering is directed.
  const Color& diffuseReflectance(bool front) const { return diffuse_[front ? 0 : 1]; }
  const Color& diffuseTransmittance(bool front) const { return diffuse_[front ? 2 : 3]; }

  // The directed part for a view on this side; null if there is none.
  const DirectedScattering* reflection(bool front) const { return directed_[front ? 0 : 1].get(); }
  const DirectedScattering* transmission(bool front) const {
    const auto& own = directed_[front ? 2 : 3];
    return own ? own.get() : directed_[front ? 3 : 2].get();
  }

  // The directed part between two directions.
  const DirectedScattering* between(const V3d& view, const V3d& other) const {
    const bool front = view.z > 0;
    return front == (other.z > 0) ? reflection(front) : transmission(front);
  }

  // The projected solid angles of the finest and the coarsest cells for a view, in reflection and
  // transmission together; pi if there is no directed part.
  DirectedScattering::Resolution resolution(const V3d& view) const;

  // The fraction of light that is transmitted undeflected, and the scattering (1/sr) around that direction;
  // black if the data have no narrow peak there. Both exclude the diffuse part.
  struct Through {
    Color peak{0, 0, 0}, around{0, 0, 0};
  };
  Through through(const V3d& view) const;

 private:
  std::array<Color, 4> diffuse_;  // by rad::BsdfFile::Component
  std::array<double, 4> diffuseLuminance_{};
  std::array<std::unique_ptr<const DirectedScattering>, 4> directed_;
};

}  // namespace rsphere
