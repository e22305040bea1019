#pragma once
// Bidirectional scattering from XML files: how much goes from one direction to another, and sampling of it.
//
// Directions are unit vectors that point away from the surface, in its own frame: z is its normal, so that
// z > 0 is the front, and y is "up". Scattering is told for a view and another direction, the view being the
// one that the data have light arrive from; where they lack this side's transmission the other side's serves,
// turned round (Helmholtz reciprocity).
//
// Sources: WINDOW 6's Klems matrices; Ward et al., LBNL-6535E, 2012 (tensor trees); Shirley and Chiu, "A low
// distortion map between disk and square", JGT 2/3, 1997; RADIANCE's notes on BSDF directions.
#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/rgb.h"
#include "rad_parser/bsdf_file.h"

namespace rsphere {

// Luminance and the other two tristimulus values.
struct Tristimulus {
  double x = 0, y = 0, z = 0;
};
// For RADIANCE's primaries and white; colours outside of what they can mix are mixed with grey of the same
// luminance until no channel is negative.
Rgb rgbOf(const Tristimulus& c);

// One of the four components of a file, but for the part that is the same for all directions.
class DirectedScattering {
 public:
  // incidentFront, scatteredFront: the sides that its data are for.
  DirectedScattering(bool incidentFront, bool scatteredFront)
      : incidentFront_(incidentFront), scatteredFront_(scatteredFront) {}
  virtual ~DirectedScattering() = default;

  bool transmits() const { return incidentFront_ != scatteredFront_; }
  bool incidentFront() const { return incidentFront_; }
  // Whether a view on this side asks for the data turned round.
  bool turned(const V3d& view) const { return transmits() && (view.z > 0) != incidentFront_; }

  // A cell of the data, without what is diffuse: what is constant over it, its smaller projected solid angle
  // (sr), and its number.
  struct Cell {
    Tristimulus value;  // 1/sr
    double projectedSolidAngle = 0;
    uint64_t number = 0;
  };
  // Empty of light where either direction lies beyond the data's angles.
  virtual Cell cell(const V3d& view, const V3d& other) const = 0;

  // The share of light that is scattered, all directions together, by luminance.
  virtual double albedo(const V3d& view) const = 0;
  // A direction drawn with the density (by projected solid angle) of luminance, for uniform u1, u2 in [0, 1).
  // Requires an albedo above 0.
  virtual V3d sample(const V3d& view, double u1, double u2) const = 0;

  // Projected solid angles (sr) of cells about a view.
  struct Resolution {
    double finest = 0, coarsest = 0;  // 0: no data
  };
  virtual Resolution resolution(const V3d& view) const = 0;
  // Makes it ready to be asked from the other side; false where it cannot be, and answers an albedo of 0.
  virtual bool prepareTurned() = 0;
  // Of all cells.
  double finestCell() const { return finestCell_; }
  double largestAlbedo() const { return largestAlbedo_; }

 protected:
  bool incidentFront_, scatteredFront_;
  double finestCell_ = 0, largestAlbedo_ = 0;
};

// A file made ready. Not changed by questions: any number of threads may ask.
class BsdfData {
 public:
  // name: of the file, for messages. Warns where more than all light is scattered, and of what the data
  // cannot be asked for.
  BsdfData(const rad::BsdfFile& file, std::string_view name, const rad::Warn& warn);

  // The share of light that is scattered evenly, by the side of the view: the smallest value that the data
  // have for it, where that is worth more than 1% of the light; the rest is directed.
  const Rgb& diffuseReflectance(bool front) const { return diffuse_[front ? 0 : 1]; }
  const Rgb& diffuseTransmittance(bool front) const { return diffuse_[front ? 2 : 3]; }

  // The directed part of what a view on this side sees; null where there is none.
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

  // The finest and the coarsest cells about a view in reflection and transmission; pi where there is no
  // directed part.
  DirectedScattering::Resolution resolution(const V3d& view) const;

  // The share of light that goes straight on, and the scattering (1/sr) around that; black where the data
  // have no narrow peak there. The diffuse part is in neither.
  struct Through {
    Rgb peak{0, 0, 0}, around{0, 0, 0};
  };
  Through through(const V3d& view) const;

 private:
  std::array<Rgb, 4> diffuse_;  // by rad::BsdfFile::Component
  std::array<double, 4> diffuseLuminance_{};
  std::array<std::unique_ptr<const DirectedScattering>, 4> directed_;
};

}  // namespace rsphere
