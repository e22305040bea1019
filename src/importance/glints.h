#pragma once
// The images of light sources in mirroring balls. Each is small and mostly far brighter than all around it:
// the few directions that meet one by chance carry too much, and an even share of the ball's own too little.
// Where they are follows from the law of reflection, so they can have directions of their own.
#include <span>
#include <vector>

#include "importance/silhouette.h"
#include "importance/special_objects.h"
#include "transport/path_tracer.h"

namespace rsphere {

// The image of a source or of a part of one: about what it fills.
struct Glint {
  Silhouette region;
  double brightness = 0;   // W/sr/m2, no more than
  bool continues = false;  // another part of the image before it
};

class Glints {
 public:
  // Keeps a reference to transport. Of the objects, those that are spheres of metal or plastic as smooth as a
  // mirror, of mirror, or of glass and other dielectrics. The sources: all that are not virtual.
  Glints(const Transport& transport, std::span<const SpecialObject> objects);

  // The images that a point (world) sees, parts of one image one after the other. Left out: those whose solid
  // angle (sr) times brightness squared is surely below least, and those that shadow rays, one from the point
  // and up to five to the source, find hidden. A point in or on a ball sees none in it. Depends on the
  // arguments alone.
  std::vector<Glint> find(const V3d& point, double least) const;

 private:
  struct Ball {
    Sphere sphere;
    double reflectance = 0;
  };
  struct Light {
    uint32_t source = 0;  // index in LightSources
    double brightness = 0;
  };
  bool shines(const LightSource& source, std::span<const V3d> corners, const V3d& middle,
              const V3d& at) const;

  const Transport& transport_;
  std::vector<Ball> balls_;
  std::vector<Light> lights_;
};

}  // namespace rsphere
