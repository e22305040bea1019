#pragma once
// The quantities of an answer at a point, by their -o letters. The command line, the writer of answers,
// -defaults and the manual take them from one table: a new quantity is a row of it.
#include <cstdint>
#include <span>
#include <string_view>

#include "base/function_ref.h"
#include "points/point_answer.h"
#include "points/sphere_options.h"

namespace rsphere {

struct PointQuantity {
  // place: coordinates. colors, errors: by `each`. vector: the light vector. count: of directions.
  enum class Form : uint8_t { place, colors, errors, vector, count };
  // Takes a color, or the standard error of a color and that of its brightness.
  using Add = FunctionRef<void(const Color& color, double ofBrightness)>;

  char letter;
  std::string_view name;  // in -defaults
  Form form;
  int values;  // number of colors, errors or numbers; kOfZones: one color for each zone (-Sz)
  std::string_view definition, unit;  // for the manual; lines of the definition have at most 51 characters
  // Calls `add` for each color or error.
  void (*each)(const PointAnswer& answer, const SphereOptions& options, const Add& add) = nullptr;

  static constexpr int kOfZones = 0;
};

// In the order of the manual.
std::span<const PointQuantity> pointQuantities();
// Null: no quantity has the letter.
const PointQuantity* pointQuantity(char letter);
// Whether one of the letters is a standard error.
bool haveErrors(std::string_view letters);

}  // namespace rsphere
