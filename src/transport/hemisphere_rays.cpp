#include "transport/hemisphere_rays.h"

#include <cmath>

#include "scene/even_sequence.h"
#include "transport/bright_spots.h"
#include "transport/openings.h"
#include "transport/ray_functions.h"
#include "transport/ray_limits.h"
#include "transport/tuning.h"

namespace rsphere {

void sendOverHemisphere(const Transport& transport, const BrightSpots* aims, Random& random, const Ray& root,
                        const V3d& normal, const V3d& trueNormal, RayKind kind, int rays, GatherRay each) {
  V3d x, y;
  frame(normal, x, y);
  Openings::Aim openings;
  if (transport.openings()) transport.openings()->aim(root.point, normal, openings);
  BrightSpots::Aim spots;
  if (aims) aims->aim(root.point, normal, spots);
  double shares[3] = {1, openings.share, spots.share};
  shares[2] *= 1 - shares[1];
  shares[0] = 1 - shares[1] - shares[2];
  // The kind of each of few rays is drawn at random; its density is that of the mixture.
  int counts[3] = {rays, 0, 0};
  if (rays < tuning::HemisphereRays::kFew && shares[0] < 1) {
    counts[0] = 0;
    for (int i = 0; i < rays; ++i) {
      const double u = random.uniform();
      ++counts[u < shares[0] ? 0 : u < shares[0] + shares[1] ? 1 : 2];
    }
  } else {
    for (int k = 1; k < 3; ++k) counts[k] = static_cast<int>(shares[k] * rays + .5);
    counts[0] = rays - counts[1] - counts[2];
    for (int k = 0; k < 3; ++k) shares[k] = static_cast<double>(counts[k]) / rays;
  }
  const auto send = [&](const V3d& direction) {
    const double cosine = direction.dot(normal);
    if (cosine <= 0 || direction.dot(trueNormal) <= 0) return;
    double density = shares[0];
    if (shares[1] > 0)
      density += shares[1] * kPi / cosine * transport.openings()->density(openings, root.point, direction);
    if (shares[2] > 0) density += shares[2] * kPi / cosine * aims->density(spots, direction);
    Ray child;
    child.direction = direction;
    Coefficient weight(kMeanReflectance);
    if (!continueRay(transport, random, child, kind, root, weight)) return;
    ++child.ambientLevel;
    each(child, weight.rgb.x / (kMeanReflectance * density * rays));
  };
  const double shift1 = random.uniform(), shift2 = random.uniform(), shift3 = random.uniform();
  // A Fibonacci lattice over the projected hemisphere, shifted at random. It is as evenly distributed as a
  // jittered grid, for any number of rays.
  constexpr double kGolden = .6180339887498949;
  for (int i = 0; i < counts[0]; ++i) {
    const double around = shift2 + i * kGolden;
    send(diffuseDirection(normal, (i + shift1) / counts[0], around - std::floor(around)));
  }
  for (int i = 0; i < counts[1]; ++i) {
    const Imath::V2d u = evenly(static_cast<size_t>(i), shift1, shift2);
    send(transport.openings()->sample(openings, root.point, (i + shift3) / counts[1], u.x, u.y));
  }
  for (int i = 0; i < counts[2]; ++i) {
    const Imath::V2d u = evenly(static_cast<size_t>(i), shift1, shift2);
    send(aims->sample(spots, (i + shift3) / counts[2], u.x, u.y));
  }
}

}  // namespace rsphere
