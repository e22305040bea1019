#pragma once
// Pictures of the view from a point: pixels are traced like directions (pixel_tracer.h), and noisy components
// of their light are averaged over neighbours (smooth_light.h).
#include <cstdint>
#include <functional>

#include "pictures/point_picture.h"
#include "silhouettes/seen_sources.h"
#include "transport/transport.h"

namespace rsphere {

// Called before each row with the finished fraction of the work, 0 to 1. May throw to abandon the picture.
using DrawingProgress = std::function<void(double done)>;

// Draws the radiance (W/sr/m2) that arrives at a point (world), in red, green and blue.
// - One ray is traced through the middle of each pixel, four more where the picture has edges or noise, and
//   another four where the first four differ. forScreen: the rays of a pixel are averaged as displayed
//   colors, by the ToneCurve of `white`, so that windows and luminaires have smooth edges however bright they
//   are.
// - The indirect light of visible surfaces is gathered at one pixel in four, or in nine without daylight,
//   from -ad + -as rays. Nearby pixels share it, and also rough reflections and the light of sources
//   (smooth_light.h).
// - Directly visible sources (SeenSources) that are so small that pixels may miss them are sampled
//   separately. Their light is added to the pixels that they cover, so that none is lost and none looks
//   enlarged.
// transport: with the options for pictures (pictureDefaults() in cli/option_table.h). All random numbers
// follow from seed. white: radiance that is shown as white (W/sr/m2); 0: the eye adapts.
Raster drawPoint(const V3d& point, const PixelMap& map, const Transport& transport,
                 const SeenSources& sources, uint64_t seed, bool forScreen, double white = 0,
                 const DrawingProgress& progress = {});

}  // namespace rsphere
