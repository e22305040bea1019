#pragma once
// Pictures as files.
#include <string>
#include <string_view>

#include "image/picture_formats.h"

namespace rsphere {

// Formats by the values that they store.
enum class PictureFormat {
  radiance,  // RADIANCE's format (HDR): radiance, with the view in its header
  linear,    // EXR, TIFF and PFM: radiance
  screen     // PNG, JPEG and all others: screen colors
};

// The format for the suffix of a name; .pic is also RADIANCE's. Throws rad::Error (Status::system), with the
// name and the usual suffixes, if the suffix is unknown.
PictureFormat pictureFormat(const std::string& name);

// A file for a picture. An incomplete picture is never visible: it is written to a temporary file in the same
// folder, which replaces the target when it is complete. A device, a pipe or the file of a standard
// descriptor (/dev/stdout) is written directly. The constructor checks whether the file can be written, so
// that errors occur before the picture is computed. Constructor and write() throw rad::Error (Status::system)
// with the name of the file and the system's message: 'cannot write picture "a.png": No space left on
// device'.
class PictureFile {
 public:
  explicit PictureFile(std::string name);
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;

  const std::string& name() const { return name_; }
  PictureFormat format() const { return format_; }

  // REQUIRES that it was not called before. header: for PictureFormat::radiance, the lines before FORMAT with
  // their line ends.
  void write(const Raster& raster, std::string_view header);

 private:
  std::string name_;
  PictureFormat format_;
  std::string target_;  // the file to replace, after resolving links; empty: the file is written directly
};

}  // namespace rsphere
