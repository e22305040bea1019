#include "rad_parser/calc/functions.h"

#include <algorithm>
#include <iterator>

namespace rad::calc {
namespace {

constexpr LibraryFunction kLibrary[] = {
    {"acos", Op::acos, 1},      {"arg", Op::realArgument, 1},
    {"asin", Op::asin, 1},      {"atan", Op::atan, 1},
    {"atan2", Op::atan2, 2},    {"ceil", Op::ceil, 1},
    {"cos", Op::cos, 1},        {"erf", Op::erf, 1},
    {"erfc", Op::erfc, 1},      {"exp", Op::exp, 1},
    {"floor", Op::floor, 1},    {"fnoise3", Op::fractalNoise3, 3},
    {"if", Op::ifPositive, 3},  {"j0", Op::j0, 1},
    {"j1", Op::j1, 1},          {"jn", Op::jn, 2},
    {"log", Op::log, 1},        {"log10", Op::log10, 1},
    {"max", Op::max, 1},        {"min", Op::min, 1},
    {"noise3", Op::noise3, 3},  {"noise3x", Op::noise3, 3},
    {"noise3y", Op::noise3, 3}, {"noise3z", Op::noise3, 3},
    {"rand", Op::random, 1},    {"select", Op::select, 1},
    {"sin", Op::sin, 1},        {"sqrt", Op::sqrt, 1},
    {"tan", Op::tan, 1},        {"y0", Op::y0, 1},
    {"y1", Op::y1, 1},          {"yn", Op::yn, 2},
};

}  // namespace

const LibraryFunction* findLibraryFunction(std::string_view name) {
  const auto found = std::find_if(std::begin(kLibrary), std::end(kLibrary),
                                  [&](const LibraryFunction& f) { return f.name == name; });
  return found != std::end(kLibrary) ? found : nullptr;
}

Op operatorOf(char c) {
  return c == '+' ? Op::add : c == '-' ? Op::subtract : c == '*' ? Op::multiply : Op::divide;
}

}  // namespace rad::calc
