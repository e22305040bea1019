// The smallest program on the library: the mean radiance at one point of a scene.
//   minimal scene.rad [x y z]
#include <rsphere/scene.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 2 && argc != 5) {
    std::fprintf(stderr, "usage: %s scene.rad [x y z]\n", argv[0]);
    return 1;
  }
  rsphere::Point point{0, 0, 0};
  for (int i = 2; i < argc; ++i) point[static_cast<size_t>(i - 2)] = std::atof(argv[i]);
  try {
    const rsphere::Scene scene({argv[1]});
    rsphere::Options options;
    options.ambientBounces = 2;
    const rsphere::PointAnswers answers = scene.sphere({&point, 1}, options);
    const auto mean = answers.mean[0];
    std::printf("%.4f %.4f %.4f\n", mean[0], mean[1], mean[2]);
  } catch (const rsphere::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
