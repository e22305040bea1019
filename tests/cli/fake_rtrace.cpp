// A program that looks like the original rtrace: answers each ray with the same value, but for a relative
// bias and noise. $FAKE holds "value bias noise". Rays and answers are doubles (-fdd), or names are asked for
// (-fda -os).
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/random.h"

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "-version") == 0) return std::puts("RADIANCE 0.0 (of a test)") < 0;
  bool names = false;
  for (int i = 1; i < argc; ++i) names |= std::string(argv[i]) == "-os";
  double value = 1, bias = 0, noise = 0;
  const char* fake = std::getenv("FAKE");
  if (fake == nullptr || std::sscanf(fake, "%lf %lf %lf", &value, &bias, &noise) != 3) return 1;
  rsphere::Random random(1);
  double ray[6];
  while (std::fread(ray, sizeof ray, 1, stdin) == 1) {
    if (names) {
      std::puts("floor\t");
      continue;
    }
    const double r = std::sqrt(-2 * std::log(1 - random.uniform()));
    const double normal = r * std::cos(6.283185307179586 * random.uniform());
    const double answer = value * (1 + bias) * (1 + noise * normal);
    const double rgb[3] = {answer, answer, answer};
    std::fwrite(rgb, sizeof rgb, 1, stdout);
  }
  return 0;
}
