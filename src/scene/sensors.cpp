#include "scene/sensors.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/frame.h"

namespace rsphere {
namespace {

// Moves sensors at the same place apart, so that a ray aimed at one does not hit another.
std::vector<Sensor> movedApart(std::span<const Sensor> sensors, double side) {
  const double gap = 2 * side;
  std::vector<Sensor> apart;
  for (Sensor sensor : sensors) {
    const V3d wanted = sensor.point;
    const auto collides = [&] {
      for (const Sensor& other : apart)
        if ((other.point - sensor.point).length2() < .99 * gap * gap) return true;
      return false;
    };
    // Tries the places of a cubic lattice, shell by shell outwards.
    for (int shell = 1; collides(); ++shell)
      for (int i = 0; i < (2 * shell + 1) * (2 * shell + 1) * (2 * shell + 1) && collides(); ++i) {
        const int places = 2 * shell + 1;
        sensor.point =
            wanted + gap * V3d(i % places - shell, i / places % places - shell, i / places / places - shell);
      }
    apart.push_back(sensor);
  }
  return apart;
}

Polygon squareOf(const Sensor& sensor, double side, std::vector<V3d>& vertices) {
  const auto [u, v] = frame(sensor.normal, side / 2);
  const auto first = static_cast<uint32_t>(vertices.size());
  for (const V3d& corner : {-u - v, u - v, u + v, v - u}) vertices.push_back(sensor.point + corner);
  Polygon square = makePolygon(vertices, first, 4);
  // The plane is set exactly, because vertices far from the origin are rounded.
  square.normal = sensor.normal;
  square.offset = sensor.normal.dot(sensor.point);
  return square;
}

// Appends a primitive for use in messages and names.
PrimitiveId describe(Scene& scene, const std::string& name, uint32_t file, uint32_t number) {
  rad::Primitive p;
  p.type = rad::Type::polygon;
  p.place = {file, number};
  p.name = name;
  scene.description.primitives.push_back(p);
  return scene.description.primitives.last();
}

}  // namespace

std::vector<Sensor> sensorsOf(std::span<const double> numbers, const std::string& name) {
  std::vector<Sensor> sensors;
  for (size_t i = 0; i + 6 <= numbers.size(); i += 6) {
    const auto fail = [&](const char* what) {
      throw rad::Error(fmt::format("{}: sensor {}: {}", name, i / 6 + 1, what));
    };
    for (const double number : numbers.subspan(i, 6))
      if (!std::isfinite(number)) fail("a coordinate is not a finite number");
    const V3d normal(numbers[i + 3], numbers[i + 4], numbers[i + 5]);
    if (!(normal.length() > 0)) fail("the direction that it faces is 0 0 0");
    sensors.push_back({V3d(numbers[i], numbers[i + 1], numbers[i + 2]), normal.normalized()});
  }
  return sensors;
}

void addSensors(Scene& scene, std::span<const Sensor> sensors) {
  if (sensors.empty()) return;
  if (scene.vertices.size() + 4 * sensors.size() > std::numeric_limits<uint32_t>::max())
    throw rad::Error("more vertices than can be numbered");
  const SurfaceList before = std::move(scene.surfaces);
  const size_t outermost = scene.outermostIds().size(), more = sensors.size();
  SurfaceList& all = scene.surfaces = {};
  all.finishes() = before.finishes();
  all.reserve(before.size() + more);
  const auto keep = [&](size_t i) {
    const SurfaceId id(i);
    const Shape shape = visit([](const auto& own) { return Shape(own); }, before[id].shape);
    all.push_back(shape, before.face(id).finish, before.primitiveOf(id));
  };
  for (size_t i = 0; i < outermost; ++i) keep(i);
  // The world's surfaces precede those of octrees and meshes, and only they can be light sources.
  const auto file = static_cast<uint32_t>(scene.description.files.size());
  scene.description.files.push_back({.name = "sensors", .numbered = false});
  uint32_t number = 0;
  // In a small scene the side is less than kSensorSide.
  const double side = kSensorSide * (scene.samePlace / kSamePlace);
  for (const Sensor& sensor : movedApart(sensors, side)) {
    const std::string name = fmt::format("sensor{}", ++number);
    Finish finish;
    finish.goal = finish.sensor = true;
    finish.importance = Radiance(1 / (side * side));
    finish.name = name;
    all.finishes().push_back(std::move(finish));
    all.push_back(squareOf(sensor, side, scene.vertices), static_cast<uint32_t>(all.finishes().size()) - 1,
                  describe(scene, name, file, number));
  }
  for (size_t i = outermost; i < before.size(); ++i) keep(i);
  if (scene.names.size() == before.size()) {
    ById<SurfaceId, std::string> renamed;
    for (const SurfaceId i : all.ids())
      renamed.push_back(scene.description.primitives.name(all.primitiveOf(i)));
    scene.names = std::move(renamed);
  }
  if (scene.groups.empty()) scene.groups.push_back({{0, 0}});
  scene.groups[0].surfaces = {0, outermost + more};
  for (size_t g = 1; g < scene.groups.size(); ++g) {
    const IdRange<SurfaceId>& was = scene.groups[g].surfaces;
    if (was.size() > 0) scene.groups[g].surfaces = {was[0].index() + more, was.size()};
  }
  for (Mesh& mesh : scene.meshes)
    for (SurfaceId& faces : mesh.facesOf)
      if (faces != kNone) faces = SurfaceId(faces.index() + more);
  scene.importance = true;
}

}  // namespace rsphere
