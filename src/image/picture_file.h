#pragma once
// Pictures as files.
#include <string>
#include <string_view>
#include <vector>

namespace rsphere {

// Red, green and blue of each pixel (W/sr/m2, or screen colours from 0 to 1), the highest row first.
struct Raster {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

// What a format keeps.
enum class PictureFormat {
  radiance,  // RADIANCE's own (HDR): radiance, and a header in which views are told
  linear,    // EXR and TIFF: radiance
  screen     // PNG, JPEG and all others: screen colours
};

// The format that the suffix of a name asks for; .pic is RADIANCE's, too. Throws rad::Error (Status::system),
// with the name, where there is no such format.
PictureFormat pictureFormat(const std::string& name);

// A file for a picture, made empty when it is opened, so that what cannot be written is known before anything
// is computed for it. Both throw rad::Error (Status::system), which names the file and what the system says
// of it: 'cannot write picture "a.png": No space left on device'. A file that is not whole is left empty.
class PictureFile {
 public:
  explicit PictureFile(std::string name);
  ~PictureFile();
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  PictureFormat format() const { return format_; }

  // Once. header: for PictureFormat::radiance, the lines before FORMAT, each with its line end.
  void write(const Raster& raster, std::string_view header);

 private:
  [[noreturn]] void fail(const std::string& why);

  std::string name_;
  PictureFormat format_;
  int fd_ = -1;
};

}  // namespace rsphere
