#pragma once
// The quantities of an answer at a point, by their -o letters. The command line, the writer of answers,
// -defaults and the manual take them from one table: a new quantity is a row of it.
//
// The letter e is the standard error of the quantity before it: of the mean if there is none before it, or
// one without errors (o, k).
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/function_ref.h"
#include "points/kernels.h"
#include "points/point_answer.h"
#include "points/sphere_options.h"

namespace rsphere {

struct PointQuantity {
  // place: coordinates. colors, errors: by `each`. vector, vectorErrors: the light vector and its errors.
  // count: of directions.
  enum class Form : uint8_t { place, colors, errors, vector, vectorErrors, count };
  // Takes a color, or the standard error of a color and that of its brightness.
  using Add = FunctionRef<void(const Color& color, double ofBrightness)>;

  char letter;
  std::string_view name;  // in -defaults
  Form form;
  int values;  // number of colors, errors or numbers; kOfZones: one color for each zone (-Sz)
  std::string_view definition, unit;  // for the manual; lines of the definition have at most 51 characters
  // Calls `add` for each color or error.
  void (*each)(const PointAnswer& answer, const SphereOptions& options, const Add& add) = nullptr;
  char of = 0;  // for a standard error, the letter of its quantity; other than v, not in the manual
  // For a standard error that does not follow from that of the mean or of zones: the first of its Kernels.
  size_t kernel = Kernels::kQuantities;

  bool isError() const { return form == Form::errors || form == Form::vectorErrors; }

  static constexpr int kOfZones = 0;
};

// In the order of the manual.
std::span<const PointQuantity> pointQuantities();
// Null: no quantity has the letter; e: that of the mean.
const PointQuantity* pointQuantity(char letter);
// The quantities of these letters, in their order. REQUIRES that each is the letter of a quantity.
std::vector<const PointQuantity*> pointQuantities(std::string_view letters);
// Whether one of the letters is a standard error.
bool haveErrors(std::string_view letters);
// The quantities whose standard errors do not follow from that of the mean.
Kernels::Some ownErrors(std::string_view letters);

}  // namespace rsphere
