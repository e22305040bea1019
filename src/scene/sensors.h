#pragma once
// Sensors and eyes as goals: places without a surface.
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace rsphere {

// A place that receives light like a very small Lambertian surface: by the cosine, from the side that the
// normal points to.
struct Sensor {
  V3d point{0, 0, 0};   // world
  V3d normal{0, 0, 1};  // unit
};

// The sensors of consecutive numbers x y z dx dy dz. The length of dx dy dz does not matter. Throws
// rad::Error, which begins with `name` and the number of the sensor from 1, if a normal is 0 or a number is
// not finite.
std::vector<Sensor> sensorsOf(std::span<const double> numbers, const std::string& name);

// The names that the sensors have as contributors: "sensor1" and so on.
std::vector<std::string> namesOfSensors(size_t count);

// Makes goals of the sensors: light sources whose radiance times area is 1 W/sr, so that each counts as a
// goal of area 1. Every other source but goals (setGoals()) is dark. A sensor is a square with a side of
// kSensorSide, which only rays that are aimed at it meet: it blocks nothing, and reflects nothing. Sensors
// in the same place are moved apart by two sides. Throws rad::Error if there are more than can be numbered.
void addSensors(Scene& scene, std::span<const Sensor> sensors);

// The side of a sensor's square (world units): a hundredth of a millimetre, in metres. Small beside what
// distances are measured by, and large beside rounding and kSamePlace.
inline constexpr double kSensorSide = 1e-5;

}  // namespace rsphere
