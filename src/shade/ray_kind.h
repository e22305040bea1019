#pragma once

namespace rsphere {

// The way in which a ray was generated. A ray carries its kind and, as bits, the kinds of its ancestors.
enum RayKind : unsigned {
  kPrimary = 1,
  kReflectedShadow = 2,  // to a light source, on the side from which the ray arrived
  kReflected = 4,        // mirrored
  kRefracted = 8,
  kTransmitted = 16,        // undeflected, or nearly so
  kReflectedAmbient = 32,   // gathers indirect light
  kReflectedSpecular = 64,  // a sample of a rough reflection
  kTransmittedShadow = 128,
  kTransmittedAmbient = 256,
  kTransmittedSpecular = 512,
  kShadow = kReflectedShadow | kTransmittedShadow,
  kAmbient = kReflectedAmbient | kTransmittedAmbient,
  kSpecular = kReflectedSpecular | kTransmittedSpecular,
  // the kinds that -lr counts as reflections
  kReflections = kReflectedShadow | kReflected | kReflectedAmbient | kReflectedSpecular
};

}  // namespace rsphere
