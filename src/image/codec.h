#pragma once
#include <string>
#include <string_view>

namespace rsphere {

// Writes pictures in the formats of OpenImageIO. The codec is a shared object that is loaded when such a
// picture is first written: a program that is linked with OpenImageIO and the libraries that it depends on
// (250 in Debian 12) takes 0.3 s to start instead of 3 ms, and most runs of rtrace are short. For the same
// reason, RADIANCE's own pictures are read and written without it (shade/picture.h, radiance_picture.h). The
// functions return an error message, empty on success; any thread may call them.
struct ImageCodec {
  // The format for a file's name, as OpenImageIO calls it.
  std::string (*formatOf)(const std::string& name, std::string& format);
  // The bytes of a file of that format. pixels: 3 * width * height numbers, the highest row first, which are
  // radiance (W/sr/m2) or screen colours from 0 to 1. The file itself is not written here, because the
  // writers of some formats do not notice a full disk, and that of JPEG then ends the process.
  std::string (*encode)(const std::string& name, int width, int height, bool radiance, const float* pixels,
                        std::string& bytes);
};

// The name of the ImageCodec in the shared object.
inline constexpr const char* kImageCodecSymbol = "rsphereImageCodec";

// Loads the shared object once: rsphere/openimageio.so from the folder of librsphere.so,
// ../lib/rsphere/openimageio.so from that of the program, or wherever the loader looks for openimageio.so.
// Throws rad::Error (Status::system) if it cannot be loaded.
const ImageCodec& imageCodec();

}  // namespace rsphere
