#pragma once
// What a point sees, as a picture: the radiance that arrives from all directions.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "image/picture_file.h"
#include "importance/seen_sources.h"
#include "importance/tuning.h"

namespace rsphere {

// How directions lie on a picture.
enum class Projection {
  // Columns are the azimuth from 0 at the left edge to 2 pi, counterclockwise about +z from +x; rows go from
  // the zenith +z to the nadir.
  latitudeLongitude,
  // RADIANCE's view -vta -vh 360 -vv 360 -vd 0 1 0 -vu 0 0 1: +y in the middle, +z above it, and the angle
  // from +y grows with the distance from the middle to pi at the rim. Corners show nothing. RADIANCE has no
  // name for the other one.
  angularFisheye
};

class PixelMap {
 public:
  PixelMap(Projection projection, int width, int height)
      : projection_(projection), width_(width), height_(height) {}
  // About half a million directions: one each .35 degrees, or .45 degrees.
  explicit PixelMap(Projection projection)
      : PixelMap(projection,
                 projection == Projection::angularFisheye ? tuning::Pictures::kFisheyeSide
                                                          : 2 * tuning::Pictures::kLatitudeLongitudeHeight,
                 projection == Projection::angularFisheye ? tuning::Pictures::kFisheyeSide
                                                          : tuning::Pictures::kLatitudeLongitudeHeight) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool wraps() const { return projection_ == Projection::latitudeLongitude; }
  size_t count() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }

  // The direction (unit, world) of a place on the picture, in pixels from its upper left corner; pixels have
  // their middles at halves. Empty beyond the rim.
  std::optional<V3d> direction(double x, double y) const;
  // The pixel that shows a direction, by its place in Raster::pixels.
  size_t pixelOf(const V3d& direction) const;
  // What a pixel covers, sr: exact for latitudeLongitude, to first order in its width for angularFisheye; 0
  // beyond the rim.
  double solidAngle(size_t pixel) const;

 private:
  Projection projection_;
  int width_, height_;
};

// A ray through the middle of each pixel, traced with the options of the tracer and nothing guessed: what
// arrives from there, light sources as bright as they are.
// - Sources too small for the pixels to be sure to meet (SeenSources, straight) are sampled by themselves,
//   and their light is spread over the pixels that they lie in, so that none is lost or painted larger than
//   it is.
// - The indirect light of surfaces that are seen straight is averaged over pixels nearby (smooth_indirect.h).
// checkStop is called once a row; it may throw to give the picture up. The seed decides every random number.
Raster drawPoint(const V3d& point, const PixelMap& map, const Transport& transport,
                 const SeenSources& sources, PathTracer& tracer, uint64_t seed,
                 const std::function<void()>& checkStop = {});

// Radiance to screen colours: the median brightness, by solid angle, of what is not black becomes mid-bright
// (.5 on the sRGB curve), so that rooms are seen whatever shines in them.
void expose(Raster& raster, const PixelMap& map);

// The pattern with its one %d, or %4d, %04d and the like, replaced by the record number, and %% by %. Throws
// rad::Error where there is another %, and where there is no %d for a record after the first, whose picture
// would be lost.
std::string pictureName(const std::string& pattern, uint64_t record);

// The line of a RADIANCE picture's header that tells the view of the angular fisheye, with its line end.
std::string viewLine(const V3d& point);

}  // namespace rsphere
