#include <OpenImageIO/imageio.h>

#include "image/codec.h"

namespace rsphere {
namespace {

std::string formatOf(const std::string& name, std::string& format) {
  const auto output = OIIO::ImageOutput::create(name);
  if (!output) return OIIO::geterror();
  format = output->format_name();
  return "";
}

std::string write(const std::string& name, int width, int height, bool radiance, const float* pixels) {
  const auto output = OIIO::ImageOutput::create(name);
  if (!output) return OIIO::geterror();
  OIIO::ImageSpec spec(width, height, 3, radiance ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", radiance ? "Linear" : "sRGB");
  if (!output->open(name, spec) || !output->write_image(OIIO::TypeDesc::FLOAT, pixels) || !output->close())
    return output->geterror();
  return "";
}

}  // namespace

extern "C" {
extern const ImageCodec rsphereImageCodec;
const ImageCodec rsphereImageCodec{formatOf, write};
}

}  // namespace rsphere
