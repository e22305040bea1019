#pragma once
// The rays of a gather: most of them stratified by projected solid angle, the others aimed at openings that
// daylight comes in by and at bright spots. Each is weighted by the density with which all of these together
// choose its direction (multiple importance sampling with the balance heuristic).
#include "transport/function_ref.h"
#include "transport/ray.h"
#include "transport/transport.h"

namespace rsphere {

// Gets a child that is ready to be traced, and its share of the mean over the hemisphere.
using GatherRay = FunctionRef<void(Ray& child, double part)>;

// Sends about `rays` rays from the hit of the root over the hemisphere around the normal (unit). aims: null
// if no bright spots are aimed at. No rays are sent behind trueNormal (unit), as if it were dark there.
void sendOverHemisphere(const Transport& transport, const BrightSpots* aims, Random& random, const Ray& root,
                        const V3d& normal, const V3d& trueNormal, RayKind kind, int rays, GatherRay each);

}  // namespace rsphere
