#pragma once
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "rad_parser/scene_file.h"

namespace rsphere {

// A folder of octrees and meshes that goes with the test.
class SceneFolder {
 public:
  SceneFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "rsphere_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder for the test");
    path_ = pattern;
  }
  ~SceneFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path(name);
  }

  // An octree (not frozen) of a scene text, without cells. Returns its path.
  std::string octree(const std::string& name, const std::string& text) const {
    const std::string scene = write(name + ".rad", text);
    const size_t objects = rad::readSceneText(text, scene).primitives.size();
    std::string bytes = "#?RADIANCE\nFORMAT=Radiance_octree\n\n";
    number(bytes, 283 + 4, 2);
    for (const std::string& word :
         {std::string("0"), std::string("0"), std::string("0"), std::string("1"), scene, std::string()}) {
      bytes += word;
      bytes += '\0';
    }
    number(bytes, objects, 4);
    bytes += '\0';
    return write(name, bytes);
  }

  // A mesh without materials: `side` squared vertices of a hill over (0,0)..(1,1), two triangles to each
  // square.
  std::string hill(const std::string& name, uint32_t side) const {
    const auto height = [&](double x, double y) { return .25 + .2 * x * (1 - x) * (3 + 2 * y); };
    std::string bytes = "#?RADIANCE\nFORMAT=Radiance_tmesh\n\n";
    number(bytes, 319 + 4, 2);
    for (const char* word : {"0", "0", "0", "1"}) {
      bytes += word;
      bytes += '\0';
    }
    for (int i = 0; i < 4; ++i) number(bytes, 0, 5);  // (u,v) from 0 to 0
    bytes += '\0';                                    // no cells
    bytes += '\0';                                    // no types
    bytes += '\xff';                                  // no materials
    // A patch for each square, of its four vertices: no vertex is shared, and edges have two owners.
    number(bytes, uint64_t{side} * side, 4);
    for (uint32_t i = 0; i < side; ++i)
      for (uint32_t j = 0; j < side; ++j) {
        number(bytes, 1, 1);
        number(bytes, 4, 2);
        for (uint32_t corner = 0; corner < 4; ++corner) {
          const double x = static_cast<double>(i + (corner & 1)) / side * .999;
          const double y = static_cast<double>(j + corner / 2) / side * .999;
          for (double c : {x, y, height(x, y)}) number(bytes, static_cast<uint64_t>(c * 4294967296.), 4);
        }
        number(bytes, 2, 2);
        for (int v : {0, 1, 3, 0, 3, 2}) number(bytes, static_cast<uint64_t>(v), 1);
        number(bytes, 1, 2);       // one material:
        number(bytes, 0xffff, 2);  // none
        number(bytes, 0, 2);
        number(bytes, 0, 2);
      }
    return write(name, bytes);
  }

 private:
  static void number(std::string& bytes, uint64_t value, int width) {
    for (int i = width - 1; i >= 0; --i) bytes += static_cast<char>(i < 8 ? value >> 8 * i : 0);
  }

  std::filesystem::path path_;
};

}  // namespace rsphere
