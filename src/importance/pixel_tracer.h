#pragma once
#include "importance/smooth_light.h"
#include "transport/transport.h"

namespace rsphere {

// What one ray of a picture sees. Colors are in red, green and blue.
struct PixelSample {
  V3d rest{0, 0, 0};      // radiance (W/sr/m2) without the three components below
  V3d indirect{0, 0, 0};  // reflected indirect light of the surface that is seen, divided by its pattern
  V3d gloss{0, 0, 0};     // rough reflections and transmissions, where neighboring pixels may share them
  V3d direct{0, 0, 0};    // light of sources by shadow rays, where neighboring pixels may share it
  V3d pattern{1, 1, 1};   // of the surface
  SeenSurface seen;       // material kNone: `rest` is everything
  bool sharesGloss = false, sharesDirect = false;
  ShownSource shown;  // the source that the ray showed
  LeftOut leftOut;    // parts that were not requested

  V3d value() const { return rest + pattern * indirect + gloss + direct; }
};

// Which components of a ray are computed. Where they cannot be separated, `rest` contains all of the light in
// any case.
enum class PixelParts : uint8_t { all, noIndirect, restAlone };

// Traces the rays of a picture, and separates components that vary little between pixels from all other
// light, so that pixels may share them.
class PixelTracer {
 public:
  // Keeps references.
  PixelTracer(const V3d& point, const Transport& transport);
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;

  PixelSample trace(const V3d& direction, uint64_t seed, PixelParts parts);
  // Paths that find all light, not divided into components.
  PathsFrom paths() { return PathsFrom(tracer_, point_); }

 private:
  PixelSample traceOnce(const V3d& direction, uint64_t seed, PixelParts parts);

  const V3d& point_;
  const PreparedScene& prepared_;
  PathTracer tracer_;
  const bool separates_;
};

}  // namespace rsphere
