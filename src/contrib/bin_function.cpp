#include "contrib/bin_function.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rad_parser/number.h"
#include "rad_parser/rayinit/interface.h"

namespace rsphere {
namespace {

namespace calc = rad::calc;

constexpr double kMostBins = 100000;  // of directionBins(): the limit of -Sz

// Converts the parameters of -p to definitions. Throws rad::Error if they are not a list of named numbers.
std::vector<std::string> definitionsOf(const std::string& parameters) {
  std::vector<std::string> definitions;
  for (const std::string_view one : rad::split(parameters, ",:;")) {
    const size_t equals = one.find('=');
    if (equals == 0 || equals == one.npos || !rad::parseReal(one.substr(equals + 1)))
      throw rad::Error(fmt::format("bad parameter list '{}': -p name=number,name=number", parameters));
    definitions.emplace_back(one);
  }
  return definitions;
}

void define(calc::Library& library, const BinDefinitions& definitions) {
  for (const SharedDefinitions& shared : definitions.shared)
    if (shared.isFile)
      library.include(shared.text);
    else
      library.define(shared.text, fmt::format("-e '{}'", shared.text));
  for (const std::string& one : definitionsOf(definitions.parameters))
    library.define(one, fmt::format("-p '{}'", definitions.parameters));
}

void put(double* to, const V3d& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

// The expression uses world coordinates.
void setInputs(const RayEnd& end, std::array<double, calc::kInputs>& in) {
  put(&in[calc::Dx], end.ray.direction);
  put(&in[calc::Nx], end.hit.normal);
  put(&in[calc::Px], end.hit.point);
  in[calc::T] = end.context.pathLength + end.hit.length;
  in[calc::Ts] = end.context.shadowLength + end.hit.length;
  in[calc::Rdot] = std::clamp(end.hit.cosine, -1., 1.);
  in[calc::Lu] = end.hit.u;
  in[calc::Lv] = end.hit.v;
  in[calc::S] = in[calc::Ix] = in[calc::Jy] = in[calc::Kz] = 1;
}

}  // namespace

bool BinDefinitions::operator==(const BinDefinitions& other) const {
  const auto same = [](const SharedDefinitions& a, const SharedDefinitions& b) {
    return a.isFile == b.isFile && a.text == b.text;
  };
  return parameters == other.parameters &&
         std::equal(shared.begin(), shared.end(), other.shared.begin(), other.shared.end(), same);
}

std::optional<double> BinFunction::at(const RayEnd& end, BinScratch& scratch) const {
  setInputs(end, scratch.inputs);
  return evaluate(scratch);
}

std::optional<double> BinFunction::at(const V3d& direction, BinScratch& scratch) const {
  put(&scratch.inputs[calc::Dx], direction);
  return evaluate(scratch);
}

std::optional<double> BinFunction::evaluate(BinScratch& scratch) const {
  const double value = program_->evaluate({scratch.inputs, {}, {}}, scratch.state);
  if (!std::isfinite(value)) return std::nullopt;
  return std::floor(value + .5);
}

double BinFunction::constant() const {
  calc::State state;
  return program_->evaluate({}, state);
}

calc::Library& BinFunctions::libraryOf(const BinDefinitions& definitions) {
  for (const Entry& entry : libraries_)
    if (entry.definitions == definitions) return *entry.library;
  auto library = std::make_unique<calc::Library>(
      calc::sceneInterface(), [](std::string_view name) { return loadFunctionFile(name, {}); });
  define(*library, definitions);
  libraries_.push_back({definitions, std::move(library)});
  return *libraries_.back().library;
}

BinFunction BinFunctions::compile(std::string_view option, const std::string& expression,
                                  const BinDefinitions& definitions, BinInputs inputs) {
  calc::Request request;
  request.place = fmt::format("{} '{}'", option, expression);
  request.expressions = {&expression, 1};
  request.available = inputs == BinInputs::ray ? calc::kPointInputs : uint64_t{7} << calc::Dx;
  request.reals = std::span<const double>();
  return BinFunction(libraryOf(definitions).compile(request));
}

std::shared_ptr<const DirectionBins> directionBins(const std::string& bin, const std::string& count,
                                                   const BinDefinitions& definitions) {
  BinFunctions functions;
  const BinFunction number = functions.compile("-Szn", count, definitions, BinInputs::direction);
  const double bins = number.isConstant() ? std::floor(number.constant() + .5) : 0;
  if (!(bins >= 1 && bins <= kMostBins))
    throw rad::Error(
        fmt::format("-Szn '{}': the number of bins must be a constant from 1 to {:.0f}", count, kMostBins));
  const BinFunction of = functions.compile("-Szb", bin, definitions, BinInputs::direction);
  BinScratch scratch;
  const auto binOf = [&](const V3d& direction) {
    const std::optional<double> found = of.at(direction, scratch);
    return found && *found >= 0 && *found < bins ? static_cast<size_t>(*found) : static_cast<size_t>(bins);
  };
  return std::make_shared<const DirectionBins>(static_cast<size_t>(bins), binOf);
}

}  // namespace rsphere
