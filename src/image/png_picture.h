#pragma once
#include <string>

#include "image/raster.h"

namespace rsphere {

// The contents of a PNG file: screen colours from 0 to 1, which are rounded to 8 bits and marked as sRGB.
// Values beyond are clipped. Source: ISO/IEC 15948, "Portable Network Graphics".
std::string pngPicture(const Raster& raster);

}  // namespace rsphere
