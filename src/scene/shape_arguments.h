#pragma once
// The arguments of surfaces. Each kind of primitive has a reader that checks the number and range of its
// arguments and makes the shape.
//
// Each reader throws rad::Error with the file and line of the primitive for arguments that RADIANCE rejects.
// Where RADIANCE warns and ignores the surface, it warns, too, and returns nothing.
#include <optional>
#include <string>

#include "scene/arguments.h"
#include "scene/shape.h"

namespace rsphere {

// vertices: of the description.
std::optional<Polygon> readPolygon(const PrimitiveArguments& arguments, const rad::Warn& warn,
                                   std::span<const V3d> vertices);
std::optional<Shape> readSphere(const PrimitiveArguments& arguments, const rad::Warn& warn);  // and bubble
std::optional<Shape> readCone(const PrimitiveArguments& arguments,
                              const rad::Warn& warn);  // cup, cylinder, tube
std::optional<Shape> readRing(const PrimitiveArguments& arguments, const rad::Warn& warn);
std::optional<Shape> readSource(const PrimitiveArguments& arguments);

// instance, mesh: a file and the placement of its contents.
struct PlacedFile {
  std::string file;
  Placement placement;
};
PlacedFile readPlacedFile(const PrimitiveArguments& arguments);

}  // namespace rsphere
