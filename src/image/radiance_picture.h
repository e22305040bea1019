#pragma once
#include <string>
#include <string_view>

#include "image/raster.h"

namespace rsphere {

// The contents of a RADIANCE picture: `header` (lines with line ends, beginning with "#?RADIANCE"), FORMAT,
// the resolution, and 4-byte pixels (rgbePixel(), image/rgbe.h: each channel is rounded down by up to 1/128
// of the largest). Scanlines are run-length coded, unless the width is below 8 or above 32767. Source:
// RADIANCE file formats, "Picture file format".
std::string radiancePicture(const Raster& raster, std::string_view header);

}  // namespace rsphere
