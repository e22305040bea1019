#pragma once
// The arguments of surfaces: one reader for each kind of primitive, which checks the number and range of the
// arguments and makes the shape.
//
// Each reader throws rad::Error with the primitive's place for arguments that RADIANCE refuses. Where
// RADIANCE warns and ignores the surface, it warns and returns nothing.
#include <optional>
#include <string>
#include <vector>

#include "scene/arguments.h"
#include "scene/shape.h"

namespace rsphere {

// vertices: those of the description.
std::optional<Polygon> readPolygon(const PrimitiveArguments& arguments, const rad::Warn& warn,
                                   std::span<const V3d> vertices);
std::optional<Shape> readSphere(const PrimitiveArguments& arguments, const rad::Warn& warn);    // and bubble
std::optional<Shape> readCone(const PrimitiveArguments& arguments, const rad::Warn& warn);      // and cup
std::optional<Shape> readCylinder(const PrimitiveArguments& arguments, const rad::Warn& warn);  // and tube
std::optional<Shape> readRing(const PrimitiveArguments& arguments, const rad::Warn& warn);
std::optional<Shape> readSource(const PrimitiveArguments& arguments);

// instance, mesh: a file and where its contents are placed.
struct PlacedFile {
  std::string file;
  Placement placement;
};
PlacedFile readPlacedFile(const PrimitiveArguments& arguments);

}  // namespace rsphere
