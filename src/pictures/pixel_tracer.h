#pragma once
#include "pictures/smooth_light.h"
#include "transport/transport.h"

namespace rsphere {

// The light that one ray of a picture finds, by component. Colors are in red, green and blue.
struct PixelSample {
  V3d rest{0, 0, 0};      // radiance (W/sr/m2) without the components below
  V3d indirect{0, 0, 0};  // indirect light reflected by the visible surface, divided by the surface's pattern
  V3d gloss{0, 0, 0};     // rough reflection and transmission, where neighboring pixels may share it
  V3d direct{0, 0, 0};    // light of sources found by shadow rays, where neighboring pixels may share it
  V3d mirrored{0, 0, 0};  // indirect light of surfaces that panes and mirrors show, without patterns
  V3d pattern{1, 1, 1};   // of the surface
  SeenSurface seen;       // material kNone: `rest` and `mirrored` are all light
  SeenSurface mirror;     // the first surface that mirrors; material kNone: `mirrored` is 0
  bool sharesGloss = false, sharesDirect = false;
  ShownSource shown;  // the source that the ray hit
  LeftOut leftOut;    // components that were not requested

  V3d value() const { return rest + pattern * indirect + gloss + direct + mirrored; }
};

// The components to compute. Where components cannot be separated, `rest` always contains all light.
enum class PixelParts : uint8_t { all, noIndirect, restAlone };

// Traces the rays of a picture. Separates the components that vary little between pixels, so that neighboring
// pixels may share them.
class PixelTracer {
 public:
  // Keeps references.
  PixelTracer(const V3d& point, const Transport& transport);
  PixelTracer(const PixelTracer&) = delete;
  PixelTracer& operator=(const PixelTracer&) = delete;

  PixelSample trace(const V3d& direction, uint64_t seed, PixelParts parts);
  // Paths that find all light, without separating components.
  PathsFrom paths() { return PathsFrom(tracer_, point_); }

 private:
  PixelSample traceOnce(const V3d& direction, uint64_t seed, PixelParts parts);

  const V3d& point_;
  const PreparedScene& prepared_;
  PathTracer tracer_;
  const bool separates_;
};

}  // namespace rsphere
