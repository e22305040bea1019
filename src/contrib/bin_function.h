#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/calc/library.h"
#include "rad_parser/rayinit/inputs.h"
#include "rays/ray.h"
#include "shade/function_file.h"
#include "sphere/direction_bins.h"

namespace rsphere {

// Definitions that an expression of bins may use.
struct BinDefinitions {
  std::vector<SharedDefinitions> shared;  // -e and -f, in the order given
  std::string parameters;                 // -p: "name=value", separated by commas, colons or semicolons

  bool operator==(const BinDefinitions& other) const;
};

// The properties of a ray that an expression may use: all variables of function files, or only the direction.
enum class BinInputs : uint8_t { ray, direction };

// Working memory for the evaluations of one thread.
struct BinScratch {
  rad::calc::State state;
  std::array<double, rad::calc::kInputs> inputs{};
};

// The number of the bin to which a ray belongs, as a function of the point that it hits (Px, Py, Pz), its
// unit direction (Dx, Dy, Dz) and the other variables of function files, in world coordinates. Immutable.
class BinFunction {
 public:
  explicit BinFunction(std::shared_ptr<const rad::calc::Program> program) : program_(std::move(program)) {}

  // The value at the end of a ray, rounded to a whole number. Empty if it is not a number. Throws rad::Error
  // if the expression uses an undefined name.
  std::optional<double> at(const RayEnd& end, BinScratch& scratch) const;
  // The value for a unit direction. REQUIRES: compiled for BinInputs::direction.
  std::optional<double> at(const V3d& direction, BinScratch& scratch) const;

  bool isConstant() const { return program_->isConstant(); }
  double constant() const;

 private:
  std::optional<double> evaluate(BinScratch& scratch) const;

  std::shared_ptr<const rad::calc::Program> program_;
};

// Compiles expressions. Expressions with equal definitions share one library.
class BinFunctions {
 public:
  // option: the option that contains the expression, for messages. Throws rad::Error if a definition or the
  // expression is invalid.
  BinFunction compile(std::string_view option, const std::string& expression,
                      const BinDefinitions& definitions, BinInputs inputs = BinInputs::ray);

  // Reads the definitions before an expression needs them. Throws like compile().
  void load(const BinDefinitions& definitions) { libraryOf(definitions); }

 private:
  rad::calc::Library& libraryOf(const BinDefinitions& definitions);

  struct Entry {
    BinDefinitions definitions;
    std::unique_ptr<rad::calc::Library> library;
  };
  std::vector<Entry> libraries_;
};

// Bins that are numbered by an expression of the direction (Dx, Dy, Dz, in the world), as with rcontrib's -b.
// count: an expression for their number. Throws rad::Error if a definition or an expression is invalid, if
// `bin` uses other properties of a ray, or if `count` is not a constant from 1 to 100,000.
std::shared_ptr<const DirectionBins> directionBins(const std::string& bin, const std::string& count,
                                                   const BinDefinitions& definitions);

}  // namespace rsphere
