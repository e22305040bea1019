#pragma once
#include <string>

namespace rsphere {

// Writes pictures in the formats of OpenImageIO. The codec is a shared object that is loaded when the first
// such picture is written. A program linked with OpenImageIO and its dependencies (250 libraries in Debian
// 12, 750 MB) would take .3 s to start instead of 3 ms, and most runs of rtrace are short. For the same
// reason, RADIANCE's pictures and PNG are written without it (rgbe.h, picture_formats.h). The
// functions return an error message, which is empty on success. Thread-safe.
struct ImageCodec {
  // OpenImageIO's name of the format for a file's name.
  std::string (*formatOf)(const std::string& name, std::string& format);
  // The contents of a file of that format. pixels: 3 * width * height numbers, beginning with the highest
  // row: radiance (W/sr/m2), or screen colors from 0 to 1. The file is not written here, because the writers
  // of some formats do not notice a full disk, and that of JPEG ends the process.
  std::string (*encode)(const std::string& name, int width, int height, bool radiance, const float* pixels,
                        std::string& bytes);
};

// The symbol of the ImageCodec in the shared object.
inline constexpr const char* kImageCodecSymbol = "rsphereImageCodec";

// Loads the shared object once: rsphere/openimageio.so from the folder of librsphere.so,
// ../lib/rsphere/openimageio.so relative to the program's folder, or openimageio.so found by the loader.
// Null if it cannot be loaded: it is in a package of its own.
const ImageCodec* imageCodec();

}  // namespace rsphere
