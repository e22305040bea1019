// Counts the pixels of a color in a picture, or in a rectangle of it: for tests that look at what a browser
// draws.
//   count_color PICTURE RRGGBB [LEFT TOP RIGHT BOTTOM]
// prints their number and the middle of the box around them.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 3 && argc != 7) return 2;
  const auto in = OIIO::ImageInput::open(argv[1]);
  if (!in) return 2;
  const OIIO::ImageSpec& spec = in->spec();
  const int channels = spec.nchannels;
  std::vector<unsigned char> pixels(static_cast<size_t>(spec.width * spec.height * channels));
  if (channels < 3 || !in->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data())) return 2;
  const long color = std::strtol(argv[2], nullptr, 16);
  const auto edge = [&](int k, int whole) {
    return argc == 7 ? std::clamp(static_cast<int>(std::strtod(argv[k], nullptr)), 0, whole) : whole;
  };
  const int left = argc == 7 ? edge(3, spec.width) : 0, top = argc == 7 ? edge(4, spec.height) : 0;
  long count = 0;
  int x0 = spec.width, x1 = 0, y0 = spec.height, y1 = 0;
  for (int y = top; y < edge(6, spec.height); ++y)
    for (int x = left; x < edge(5, spec.width); ++x) {
      const unsigned char* p = &pixels[static_cast<size_t>((y * spec.width + x) * channels)];
      if ((p[0] << 16 | p[1] << 8 | p[2]) != color) continue;
      ++count;
      x0 = std::min(x0, x);
      x1 = std::max(x1, x);
      y0 = std::min(y0, y);
      y1 = std::max(y1, y);
    }
  std::printf("%ld %.1f %.1f\n", count, (x0 + x1 + 1) / 2., (y0 + y1 + 1) / 2.);
  return 0;
}
