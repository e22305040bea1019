#pragma once
#include <string>
#include <string_view>

#include "image/raster.h"

namespace rsphere {

// The bytes of a RADIANCE picture: `header` (its lines, each with a line end, the first "#?RADIANCE"),
// FORMAT, the resolution, and 4-byte pixels (rgbePixel(), image/rgbe.h: each channel is rounded down by up
// to 1/128 of the largest). Scanlines are run-length coded, unless the width is below 8 or above 32767.
// Source: RADIANCE file formats, "Picture file format".
std::string radiancePicture(const Raster& raster, std::string_view header);

}  // namespace rsphere
