#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "image/codec.h"

namespace rsphere {
namespace {

// The format is said, not guessed: others are called ".pic" too.
std::string decodeRadiance(const std::string& file, size_t columns, size_t rows, float* pixels) {
  OIIO::Filesystem::IOMemReader memory(file.data(), file.size());
  const auto input = OIIO::ImageInput::create("hdr");
  if (!input) return OIIO::geterror();
  OIIO::ImageSpec spec;
  if (!input->set_ioproxy(&memory) || !input->open("picture.hdr", spec)) return input->geterror();
  if (static_cast<size_t>(spec.width) != columns || static_cast<size_t>(spec.height) != rows ||
      spec.nchannels != 3)
    return "its resolution is not its decoder's";
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels)) return input->geterror();
  return "";
}

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
const ImageCodec rsphereImageCodec{decodeRadiance, formatOf, write};
}

}  // namespace rsphere
