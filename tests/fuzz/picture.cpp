// Reads RADIANCE pictures and evaluates their colours.
#include "shade/picture.h"

#include <vector>

#include "memory_file.h"
#include "rad_parser/error.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const MemoryFile file(data, size);
  try {
    const rsphere::Picture picture = rsphere::Picture::read(file.path());
    for (double x : {-1e300, -1., 0., .3, 1., 7., 1e30})
      for (double y : {-2., 0., .5, 1e9}) static_cast<void>(picture.value(x, y));
  } catch (const rad::Error&) {
  }
  try {
    const rsphere::SpectralPicture picture = rsphere::SpectralPicture::read(file.path());
    std::vector<double> spectrum(picture.components());
    for (double x : {-1e300, 0., .3, 1e30})
      for (double y : {-2., .5, 1e9}) picture.value(x, y, spectrum);
  } catch (const rad::Error&) {
  }
  return 0;
}
