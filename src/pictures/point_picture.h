#pragma once
// Pictures of the view from a point, in all directions or in perspective: projections, exposure and names.
// draw_point.h draws them.
#include <cstdint>
#include <optional>
#include <string>

#include "image/picture_file.h"
#include "scene/scene.h"

namespace rsphere {

// The projection of directions onto a picture.
enum class Projection {
  // The sphere as seen from within: +y is in the middle, +x to its right at a quarter of the width, -y at
  // both edges. Columns are even steps of azimuth; rows descend from the zenith +z to the nadir.
  latitudeLongitude,
  // RADIANCE's view -vta -vh 360 -vv 360 -vd 0 1 0 -vu 0 0 1: +y is in the middle and +z above it. The angle
  // from +y is proportional to the distance from the middle, and reaches pi at the rim. The corners are
  // black.
  angularFisheye,
  // What a camera shows that is held level: RADIANCE's view -vtv -vd 0 1 0 -vu 0 0 1. Vertical edges are
  // vertical.
  perspective
};

// The form of pictures, as options give it.
struct PictureForm {
  int width = 0;         // -Siw  pixels; 0: see PixelMap
  double viewAngle = 0;  // -Siv  horizontal angle of a perspective view (degrees); 0: the whole sphere
  double heading = 90;   // -Sih  azimuth of the middle (degrees, counterclockwise from +x)
  double white = 0;      // -Sie  luminance that is shown as white (cd/m2); 0: see ToneCurve
};

class PixelMap {
 public:
  // The projections are described for the heading 90; others turn them about z. Without a width, there are
  // about half a million pixels of .35 degrees (latitudeLongitude) or .45 degrees (angularFisheye), or three
  // quarters of a million (perspective).
  explicit PixelMap(Projection projection, const PictureForm& form = {});

  int width() const { return width_; }
  int height() const { return height_; }
  bool wraps() const { return projection_ == Projection::latitudeLongitude; }
  size_t count() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }

  // The direction (unit, world) at a position in pixels from the upper left corner of the picture. The
  // middles of pixels have half-integer coordinates. Empty outside the rim of a fisheye.
  std::optional<V3d> direction(double x, double y) const;
  // The pixel that shows a direction (unit); pixels are numbered row by row. Empty outside the picture.
  std::optional<size_t> pixelOf(const V3d& direction) const;
  // The solid angle of a pixel, sr: exact for latitudeLongitude, otherwise to first order in the pixel's
  // width; 0 outside the rim of a fisheye.
  double solidAngle(size_t pixel) const;
  // The header line of a RADIANCE picture from this point that describes the view, including its line end.
  // REQUIRES another projection than latitudeLongitude, which no view of RADIANCE is.
  std::string viewLine(const V3d& point) const;

 private:
  Projection projection_;
  int width_, height_;
  double cosine_, sine_;       // of the angle from +y to the heading
  double right_ = 0, up_ = 0;  // perspective: how far it reaches at distance 1
};

inline V3d valueAt(const Raster& raster, size_t pixel) {
  const float* p = raster.pixels.data() + 3 * pixel;
  return V3d(p[0], p[1], p[2]);
}

inline void setValue(Raster& raster, size_t pixel, const V3d& value) {
  for (int c = 0; c < 3; ++c)
    raster.pixels[3 * pixel + static_cast<size_t>(c)] = static_cast<float>(value[c]);
}

// Converts radiance (W/sr/m2) to what a screen shows, from 0 to 1 in linear sRGB.
// - With a white of 0, the eye is taken to be adapted to the median brightness of all pixels that are not
//   black, weighted by solid angle, and the median is shown mid-bright (.5 in sRGB, or a little more). The
//   photographic operator compresses what is brighter, so that windows and lamps are not all white, and shows
//   the brightest pixel as white. Source: Reinhard, Stark, Shirley, Ferwerda, "Photographic tone reproduction
//   for digital images" (2002), equation 4; their key is the mean of the logarithm, which dark corners shift.
// - Otherwise colors are proportional to radiance, and what is brighter than white is cut off.
class ToneCurve {
 public:
  // white: in W/sr/m2.
  ToneCurve(const Raster& raster, const PixelMap& map, double white);
  V3d shown(const V3d& radiance) const;
  // The inverse of shown(): the least radiance, by channel, that has this color. Where a channel
  // is 1, brighter radiance has it, too.
  V3d radiance(const V3d& shown) const;

 private:
  double exposure_;
  double white_ = 0;  // exposed brightness that is shown as 1; 0: colors are proportional to radiance
};

// Converts radiance to screen colors.
void toScreen(Raster& raster, const ToneCurve& curve);

// The pattern with its one %d (or %4d, %04d and so on) replaced by the record number, and %% by %. Throws
// rad::Error if there is any other %, or if a record after the first has no %d, because its picture would
// overwrite the previous one.
std::string pictureName(const std::string& pattern, uint64_t record);

}  // namespace rsphere
