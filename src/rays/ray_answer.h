#pragma once
#include <string>
#include <string_view>

#include "base/radiometry.h"
#include "scene/scene.h"

namespace rsphere {

// The length that rtrace writes if a ray hits nothing or a distant source.
inline constexpr double kInfiniteLength = 1e10;

// The name of the surface that a ray hit. It is only decoded when it is written.
class SurfaceName {
 public:
  SurfaceName() = default;
  SurfaceName(const char* text) : text_(text) {}
  // Both must outlive this object.
  SurfaceName(const Scene& scene, SurfaceId surface) : scene_(&scene), surface_(surface) {}

  bool isNone() const { return !scene_ && text_ == "*"; }
  std::string text() const {
    return scene_ ? scene_->surfaceName(scene_->surfaces[surface_]) : std::string(text_);
  }

 private:
  const Scene* scene_ = nullptr;
  SurfaceId surface_;
  std::string_view text_ = "*";
};

// The quantities of a ray that the letters of -o (in ray mode) and of -Sd report. A quantity whose letter is
// not selected may have its default value. Names are "*" if nothing was hit; they refer to the scene. With -i
// and -I, radiances are those of a diffuse surface of reflectance pi, so that they equal its irradiance
// (W/m2).
struct RayAnswer {
  V3d origin{0, 0, 0}, direction{0, 0, 0};  // o d
  Radiance value;                           // v  with -i and -I equal to the irradiance
  Radiance standardError;                   // e  of v; with its brightness:
  double brightnessError = 0;
  Radiance mirroredContribution;                    // r
  Radiance unmirroredContribution;                  // x
  double mirroredLength = kInfiniteLength;          // R
  double unmirroredLength = kInfiniteLength;        // X
  double effectiveLength = kInfiniteLength;         // l
  double firstLength = kInfiniteLength;             // L
  double u = 0, v = 0;                              // c  local surface coordinates
  V3d point{0, 0, 0};                               // p
  V3d normal{0, 0, 0};                              // n  perturbed, facing the ray
  V3d unperturbedNormal{0, 0, 0};                   // N  without textures, not turned
  SurfaceName surface;                              // s
  std::string_view modifier = "*", material = "*";  // m M
  double rayWeight = 1;                             // w
  Coefficient contribution{1};  // W  factor on `value` in the primary ray's value. V is the product W v
  double solidAngle = 0;        // w with -Sd, sr
};

}  // namespace rsphere
