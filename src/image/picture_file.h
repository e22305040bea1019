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
// name and the usual suffixes, if there is no such format.
PictureFormat pictureFormat(const std::string& name);

// A file for a picture. Nobody finds a picture that is empty or cut: it is written beside the file under
// another name, which it loses when it is complete, and a file that was there before remains until then. A
// device, a pipe or the file of a standard descriptor (/dev/stdout) is written itself.
// The constructor finds out whether the file can be written, so that an error comes before the picture is
// computed. It and write() throw rad::Error (Status::system) with the name of the file and the system's
// message: 'cannot write picture "a.png": No space left on device'.
class PictureFile {
 public:
  explicit PictureFile(std::string name);
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  PictureFormat format() const { return format_; }

  // REQUIRES that it has not been called before. header: for PictureFormat::radiance, the lines before
  // FORMAT, each with its line end.
  void write(const Raster& raster, std::string_view header);

 private:
  std::string name_;
  PictureFormat format_;
  std::string target_;  // the file to replace, behind all links; empty: the file itself is written
};

}  // namespace rsphere
