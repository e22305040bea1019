#pragma once
#include <string>
#include <string_view>

namespace rsphere {

// Pictures in the formats of OpenImageIO. It lives in a shared object that is loaded when such a picture is
// first written: with the libraries that come along (250 in Debian 12) a program takes 0.3 s to start,
// without them 3 ms, and most runs of rtrace are short. That is why RADIANCE's own pictures are read and
// written without it (shade/picture.h, radiance_picture.h). Functions return what went wrong, empty where
// nothing did; any thread may call them.
struct ImageCodec {
  // The format that a file's name asks for, as OpenImageIO calls it.
  std::string (*formatOf)(const std::string& name, std::string& format);
  // The bytes of a file of that format, from 3 * width * height numbers, the highest row first: radiance as
  // it is, or screen colours from 0 to 1. They are not written to the file here, because the writers of some
  // formats do not notice a full disk, and that of JPEG ends the process.
  std::string (*encode)(const std::string& name, int width, int height, bool radiance, const float* pixels,
                        std::string& bytes);
};

// The shared object's name for it.
inline constexpr const char* kImageCodecSymbol = "rsphereImageCodec";

// Loads the shared object once: ../lib/rsphere/openimageio.so from the program's folder, or wherever the
// loader looks for openimageio.so. Throws rad::Error (Status::system) where it can't.
const ImageCodec& imageCodec();

}  // namespace rsphere
