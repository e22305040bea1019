// Parses, compiles and evaluates function files and expressions. Errors are allowed;
// crashes and hangs are not.
#include <algorithm>
#include <cstdlib>

#include "rad_parser/calc/syntax.h"
#include "rad_parser/rayinit/interface.h"
#include "tests/unit/support/print_syntax.h"

// The input is a function file; its last line is the expression.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace rad::calc;
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const size_t line = std::min(all.rfind('\n'), all.size());
  const std::string file(all.substr(0, line));
  const std::vector<std::string> texts = {std::string(all.substr(std::min(line + 1, all.size())))};
  try {
    const Syntax tree = parseExpression(texts[0], "fuzz");
    if (!same(tree, parseExpression(print(tree), "fuzz"))) std::abort();
  } catch (const rad::Error&) {
  }
  try {
    Library library(sceneInterface(), [&](std::string_view name) {
      return name == "f.cal" ? std::optional<SourceText>({"f.cal", file}) : std::nullopt;
    });
    Request request;
    request.place = "fuzz";
    request.file = "f.cal";
    request.expressions = texts;
    std::vector<double> inputs(kInputs);
    for (size_t i = 0; i < inputs.size(); ++i) inputs[i] = .3 * static_cast<double>(i) - 2;
    const std::vector<double> reals = {.5, 2, -3};
    State state;
    const auto program = library.compile(request);
    const double late = program->evaluate({inputs, reals, {}}, state);
    request.reals = reals;
    const double early = library.compile(request)->evaluate({inputs, reals, {}}, state);
    // Constants that are known in advance change only roundings. The values are not compared, because a
    // rounding can decide an if().
    static_cast<void>(late + early);
  } catch (const rad::Error&) {
  }
  return 0;
}
