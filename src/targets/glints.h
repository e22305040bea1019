#pragma once
// Glints: the images of light sources in mirroring balls. Most are small and far brighter than their
// surroundings. The few directions that hit one by chance cause much variance, and directions sent to the
// ball are spread over the whole ball. The law of reflection gives the places of the images, so that
// directions can be aimed at them.
#include <span>
#include <vector>

#include "silhouettes/silhouette.h"
#include "silhouettes/special_objects.h"
#include "transport/path_tracer.h"

namespace rsphere {

// The image of a source, or of a part of one.
struct Glint {
  Silhouette region;       // approximate
  double brightness = 0;   // upper bound, W/sr/m2
  bool continues = false;  // part of one image together with the preceding glint
};

class Glints {
 public:
  // Uses the objects that are spheres of mirror, of glass or another dielectric, or of metal or plastic
  // smoother than kSharpRoughness, and all light sources except virtual ones. Keeps a reference to the
  // prepared scene.
  Glints(const PreparedScene& prepared, std::span<const SpecialObject> objects);

  // The images visible from a point (world); the parts of one image are successive. Omits images whose
  // estimated solid angle (sr) times squared brightness is below `least`, and images that are hidden
  // according to shadow rays: one from the point to the ball, and up to 17 from the ball to a rectangular
  // part of the source. A point in or on a ball sees no image in that ball. The result depends only on the
  // arguments.
  std::vector<Glint> find(const V3d& point, double least) const;

 private:
  struct Ball {
    Sphere sphere;
    double reflectance = 0;
  };
  struct Light {
    LightId source;
    double brightness = 0;
  };
  static std::vector<Ball> ballsAmong(const Scene& scene, std::span<const SpecialObject> objects);
  static std::vector<Box3d> boxesOf(std::span<const Ball> balls);
  void addOf(const Ball& ball, const Light& light, const V3d& point, double least,
             std::vector<Glint>& found) const;
  bool shines(const LightSource& source, std::span<const V3d> corners, const V3d& middle,
              const V3d& at) const;

  const PreparedScene& prepared_;
  std::vector<Ball> balls_;
  ById<LightId, std::optional<Light>> lights_;  // empty for images and dark sources
  HiddenBoxes hidden_;                          // the boxes around balls_
};

}  // namespace rsphere
