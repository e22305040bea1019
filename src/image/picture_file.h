#pragma once
// Pictures as files.
#include <string>
#include <string_view>

#include "image/raster.h"

namespace rsphere {

// The formats, by the values that they store.
enum class PictureFormat {
  radiance,  // RADIANCE's own (HDR): radiance, and a header that gives the view
  linear,    // EXR and TIFF: radiance
  screen     // PNG, JPEG and all others: screen colours
};

// The format for the suffix of a name; .pic, too, is RADIANCE's. Throws rad::Error (Status::system), with the
// name, if there is no such format.
PictureFormat pictureFormat(const std::string& name);

// A file for a picture. It is created or emptied when it is opened, so that a file that cannot be written
// causes an error before the picture is computed. The constructor and write() throw rad::Error
// (Status::system) with the name of the file and the system's message: 'cannot write picture "a.png": No
// space left on device'. A file that could not be written completely is left empty.
class PictureFile {
 public:
  explicit PictureFile(std::string name);
  ~PictureFile();
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  PictureFormat format() const { return format_; }

  // REQUIRES that it has not been called before. header: for PictureFormat::radiance, the lines before
  // FORMAT, each with its line end.
  void write(const Raster& raster, std::string_view header);

 private:
  [[noreturn]] void fail(const std::string& why);

  std::string name_;
  PictureFormat format_;
  int fd_ = -1;
};

}  // namespace rsphere
