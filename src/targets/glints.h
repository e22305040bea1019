#pragma once
// Targets that are glints: the images of light sources in mirroring balls. Most are small and far brighter
// than their surroundings. The few directions that hit one by chance cause much variance, and directions sent
// to the ball are spread over the whole ball. The law of reflection gives the places of the images, so that
// directions can be aimed at them.
#include <optional>
#include <span>
#include <vector>

#include "targets/target_finder.h"

namespace rsphere {

// Images whose solid angle (sr) times squared radiance is below this are no targets. usual: see TargetFinder.
double leastGlint(double usual);
// The reflectance (brightness) of the outside of a ball or cylinder that mirrors, at normal incidence; 0 for
// materials that do not, and for trans.
double mirroredShare(const Material& material);

class Glints {
 public:
  // Uses the special objects that are spheres of mirror, of glass or another dielectric, or of metal or
  // plastic smoother than kSharpRoughness, and all light sources except virtual ones.
  explicit Glints(const TargetScene& scene);

  // See TargetFinder. The parts of one image are successive. Leaves out images below leastGlint(usual), and
  // images that are hidden according to shadow rays: one from the point to the ball, and up to 17 from the
  // ball to a rectangular part of the source. A point in or on a ball sees no image in that ball.
  std::vector<FoundRegion> find(const V3d& point, double usual) const;

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
             std::vector<FoundRegion>& found) const;
  bool shines(const LightSource& source, std::span<const V3d> corners, const V3d& middle,
              const V3d& at) const;

  const PreparedScene& prepared_;
  std::vector<Ball> balls_;
  ById<LightId, std::optional<Light>> lights_;  // empty for images and dark sources
  HiddenBoxes hidden_;                          // the boxes around balls_
};

}  // namespace rsphere
