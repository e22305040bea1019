#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "rad_parser/scene_file.h"
#include "rays/ray_report.h"
#include "scene/build_scene.h"
#include "transport/transport.h"

// Rays that hit instances and meshes, compared with the original.
namespace rsphere {
namespace {

constexpr const char* kFolder = RSPHERE_TESTS "/scenes/instances";

struct RayText {
  V3d origin, towards;
};
std::vector<RayText> raysOf(const std::string& file) {
  std::ifstream in(file);
  std::vector<RayText> rays;
  for (RayText r; in >> r.origin.x >> r.origin.y >> r.origin.z >> r.towards.x >> r.towards.y >> r.towards.z;)
    rays.push_back(r);
  return rays;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');) fields.push_back(field);
  return fields;
}

// tests/scenes/instances: octrees in octrees, meshes with and without materials, normals and (u,v), mirrored,
// scaled, with modifiers and without; patterns and textures of position, distance and (u,v). rtrace.txt is
// rtrace -h -oospmMLNncv -ab 0 -ss 0 -st 1 -dt 0 scene.oct < rays.txt (RADIANCE 6.1a).
TEST(Instances, LookAsToTheOriginal) {
  setenv("RAYPATH", kFolder, 1);
  RayOptions o;
  o.ambientBounces = 0;
  o.specularSampling = 0;
  o.specularThreshold = 1;
  o.directThreshold = 0;
  const std::string text = "!xform " + std::string(kFolder) + "/scene.rad\n";
  const Scene scene = buildScene(rad::readSceneText(text, "room.rad"));
  const Transport transport(scene, o, IrradianceAt::none);
  PathTracer tracer = transport.pathTracer();
  const std::vector<RayText> rays = raysOf(std::string(kFolder) + "/rays.txt");
  std::ifstream file(std::string(kFolder) + "/rtrace.txt");
  std::string line;
  size_t n = 0;
  for (; std::getline(file, line); ++n) {
    SCOPED_TRACE(n + 1);
    ASSERT_LT(n, rays.size());
    const std::vector<std::string> expected = split(line);
    ASSERT_EQ(expected.size(), 21u);
    const RayAnswer a = answerOf(scene, tracer.trace(rays[n].origin, rays[n].towards.normalized(), 0,
                                                     seedOf(std::initializer_list<double>{1})));
    EXPECT_EQ(a.surface.text(), expected[3]);
    EXPECT_EQ(a.modifier, expected[7]);
    EXPECT_EQ(a.material, expected[8]);
    const auto near = [&](double value, size_t at, double within) {
      EXPECT_NEAR(value, std::stod(expected[at]), within) << "field " << at;
    };
    for (size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<int>(i);
      near(a.point[k], 4 + i, 1e-5);
      near(a.unperturbedNormal[k], 10 + i, 1e-5);
      near(a.normal[k], 13 + i, 1e-5);
      near(a.value.color[k], 18 + i, 1e-4 * std::abs(a.value.color[k]) + 1e-7);
    }
    near(a.firstLength, 9, 1e-5);
    near(a.u, 16, 1e-5);
    near(a.v, 17, 1e-5);
  }
  EXPECT_EQ(n, 124u);
  unsetenv("RAYPATH");
}

}  // namespace
}  // namespace rsphere
