#pragma once
// Sensors and eyes as goals without a surface in the scene.
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// A place that receives light like a very small Lambertian surface: in proportion to the cosine, on the side
// of its normal.
struct Sensor {
  V3d point{0, 0, 0};   // world
  V3d normal{0, 0, 1};  // unit
};

// Sensors from consecutive numbers x y z dx dy dz; the length of dx dy dz is ignored. Throws rad::Error if a
// direction is 0 or a number is not finite; the message begins with `name` and the number of the sensor, from
// 1.
std::vector<Sensor> sensorsOf(std::span<const double> numbers, const std::string& name);

// Adds sensors as goals, named "sensor1" and so on: light sources whose radiance times area is 1 W/sr, so
// that each contributes like a goal of area 1. All other sources, except goals from setGoals(), are dark. A
// sensor is a square of side kSensorSide that is hit only by rays aimed at it: it neither blocks nor
// reflects light. Sensors in the same place are moved apart by two sides. Throws rad::Error if there are too
// many to be numbered.
void addSensors(Scene& scene, std::span<const Sensor> sensors);

// The side of a sensor's square (world units): in metres, a hundredth of a millimetre. Small compared with
// usual distances, large compared with rounding and kSamePlace. In a small scene it is less, by the factor by
// which Scene::samePlace is less than kSamePlace.
inline constexpr double kSensorSide = 1e-5;

}  // namespace rsphere
