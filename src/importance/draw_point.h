#pragma once
#include <cstdint>
#include <functional>

#include "image/picture_file.h"
#include "importance/point_picture.h"
#include "importance/seen_sources.h"
#include "transport/transport.h"

namespace rsphere {

// Called before each row with the fraction of the work that is done, 0 to 1; may throw to abandon the
// picture.
using DrawingProgress = std::function<void(double done)>;

// Draws the radiance (W/sr/m2) that arrives at a point (world), in red, green and blue.
// - A ray is traced through the middle of each pixel. Where the picture has edges or is noisy, four more are,
//   and another four where these differ. With forScreen they are averaged as colors that a screen can show,
//   at the exposure of exposureOf(): windows and luminaires have even edges there, however bright they are.
// - The indirect light of the surfaces that are seen is gathered at one pixel in four, or in nine without
//   daylight, from -ad + -as rays. It is averaged over nearby pixels, as are rough reflections and the light
//   of sources (smooth_light.h).
// - Sources that are seen directly (SeenSources) and are so small that pixels may miss them are sampled
//   separately. Their light is added to the pixels that they cover, so that none is lost and none looks
//   larger.
// transport: with the options of pictures (pictureDefaults() in cli/option_table.h). All random numbers
// follow from seed.
Raster drawPoint(const V3d& point, const PixelMap& map, const Transport& transport,
                 const SeenSources& sources, uint64_t seed, bool forScreen,
                 const DrawingProgress& progress = {});

}  // namespace rsphere
