#include "rad_parser/calc/symbols.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "rad_parser/calc/code_writer.h"

namespace rad::calc {
namespace {

using Kind = Syntax::Kind;

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

bool isNumber(const Syntax& s) { return s.kind == Kind::number; }

void setNumber(Syntax& tree, double number) {
  Syntax result;
  result.kind = Kind::number;
  result.line = tree.line;
  result.number = number;
  tree = std::move(result);
}

void refuse(uint32_t faults, const std::string& place) {
  if (faults == 0) return;
  throw Error(fmt::format("{}: constant expression has no value: {}", place, faultName(faults)));
}

// The faults of a library function called with numbers.
uint32_t faultsOf(const LibraryFunction& f, const Syntax& call) {
  uint32_t faults = 0;
  const auto number = [&](size_t i) { return i < call.args.size() ? call.args[i].number : 0; };
  if (f.op == Op::select) {
    const double n = number(1);
    const bool exists = n >= -.5 && n + .5 < static_cast<double>(call.args.size()) - 1;
    return exists ? 0u : uint32_t{kDomainError};
  }
  if (f.op != Op::ifPositive) apply(f.op, number(1), number(2), number(3), faults);
  return faults;
}

}  // namespace

const LibraryFunction* findLibraryFunction(std::string_view name) {
  const auto found = std::ranges::find(kLibrary, name, &LibraryFunction::name);
  return found != std::end(kLibrary) ? found : nullptr;
}

Op operatorOf(char c) {
  return c == '+' ? Op::add : c == '-' ? Op::subtract : c == '*' ? Op::multiply : Op::divide;
}

std::vector<std::string> candidates(std::string_view name, std::string_view context) {
  const bool local = name.front() == kContextMark;
  if (local) name.remove_prefix(1);
  if (!name.empty() && name.back() == kContextMark) return {std::string(name.substr(0, name.size() - 1))};
  std::vector<std::string> all;
  while (true) {
    all.push_back(std::string(name) + std::string(context));
    if (local || context.empty()) return all;
    const size_t next = context.find(kContextMark, 1);
    context.remove_prefix(next == std::string_view::npos ? context.size() : next);
  }
}

SymbolTable::SymbolTable(size_t inputs, std::span<const HostFunction> hosts, Warn warn)
    : inputs_(inputs), hosts_(hosts), warn_(std::move(warn)) {}

int SymbolTable::find(const std::string& qualified) const {
  const auto found = byName_.find(qualified);
  return found == byName_.end() ? -1 : found->second;
}

const HostFunction* SymbolTable::findHost(std::string_view name) const {
  const auto found = std::ranges::find_if(hosts_, [&](const HostFunction& h) { return h.name == name; });
  return found != hosts_.end() ? &*found : nullptr;
}

int SymbolTable::insert(const std::string& qualified) {
  const auto [it, isNew] = byName_.try_emplace(qualified, static_cast<int>(symbols_.size()));
  if (isNew) symbols_.push_back({qualified, nullptr, findLibraryFunction(qualified), findHost(qualified)});
  return it->second;
}

int SymbolTable::refer(const std::string& name, const std::string& context) {
  const std::vector<std::string> all = candidates(name, context);
  for (const std::string& qualified : all) {
    const int known = find(qualified);
    if (known >= 0) return known;
  }
  const bool isProvided = findLibraryFunction(name) != nullptr || findHost(name) != nullptr;
  return insert(isProvided ? name : all.front());
}

CompileInput SymbolTable::compileInput(std::string place) const {
  CompileInput input;
  input.symbols = symbols_;
  input.inputs = inputs_;
  input.place = std::move(place);
  return input;
}

bool SymbolTable::define(Definition definition, const std::string& context) {
  bind(definition.body, context, definition.file, definition.line != 0);
  const std::string qualified = candidates(definition.name, context).front();
  if (qualified.empty())
    throw Error(fmt::format("{}:{}: expected a name to define", definition.file, definition.line));
  Symbol& symbol = symbols_[static_cast<size_t>(insert(qualified))];
  const Definition* before = symbol.definition;
  if (before != nullptr && before->constant && warn_ && !same(before->body, definition.body))
    warn_(fmt::format("{}:{}: constant \"{}\" redefined", definition.file, definition.line, qualified));
  definitions_.push_back(std::move(definition));
  symbol.definition = &definitions_.back();
  return before != nullptr || context.empty() || !qualified.ends_with(context);
}

void SymbolTable::bind(Syntax& tree, const std::string& context, const std::string& file, bool hasLines) {
  const auto place = [&] { return hasLines ? fmt::format("{}:{}", file, tree.line) : file; };
  if (tree.kind == Kind::name) {
    tree.index = refer(tree.text, context);
    const Definition* d = (*this)[tree.index].definition;
    if (d == nullptr || !d->constant || d->isFunction()) return;
    const std::optional<double> value = isNumber(d->body) ? d->body.number : constantValue(tree, place());
    if (value) setNumber(tree, *value);
    return;
  }
  for (Syntax& inner : tree.args) bind(inner, context, file, hasLines);
  fold(tree, place());
}

bool SymbolTable::isConstantFunction(const Syntax& name) const {
  if (name.kind != Kind::name) return false;
  const Symbol& s = (*this)[name.index];
  if (s.definition != nullptr) return s.definition->isFunction() && s.definition->constant;
  return s.library != nullptr && s.library->op != Op::realArgument;
}

// The value of a constant. Empty if it is not known yet, because it uses something that is undefined or
// defined with '='; the tree then remains as it is. Throws Error if the value depends on the ray, as rtrace
// does, because such a constant has no meaning.
std::optional<double> SymbolTable::constantValue(const Syntax& tree, const std::string& place) const {
  std::shared_ptr<const Program> program;
  try {
    program = writeProgram(expandExpressions(compileInput(place), {&tree, 1}));
  } catch (const Error&) {
    return std::nullopt;  // the error is reported if the value is ever needed
  }
  State state;
  if (program->isConstant()) return program->evaluate({}, state);
  if (needsRay(tree, place))
    throw Error(fmt::format("{}: constant expression depends on the ray or the primitive", place));
  return std::nullopt;
}

// Whether the evaluation of a tree needs a ray, the real arguments of a primitive, or the renderer's
// functions. REQUIRES: the tree compiles.
bool SymbolTable::needsRay(const Syntax& tree, const std::string& place) const {
  CompileInput input = compileInput(place);
  input.hasHosts = false;
  input.inputs = 0;
  input.available = 0;
  input.reals = std::span<const double>();
  try {
    State state;
    writeProgram(expandExpressions(input, {&tree, 1}))->evaluate({}, state);
  } catch (const Error&) {
    return true;
  }
  return false;
}

// Replaces an operation on numbers, or a call of a constant function with constant arguments, by its value.
void SymbolTable::fold(Syntax& tree, const std::string& place) const {
  switch (tree.kind) {
    case Kind::negate:
      if (isNumber(tree.args[0])) setNumber(tree, -tree.args[0].number);
      break;
    case Kind::power:
      if (std::ranges::all_of(tree.args, isNumber)) {
        uint32_t faults = 0;
        const double value = apply(Op::power, tree.args[0].number, tree.args[1].number, 0, faults);
        refuse(faults, place);
        setNumber(tree, value);
      }
      break;
    case Kind::sum:
    case Kind::product: foldChain(tree, place); break;
    case Kind::call: foldCall(tree, place); break;
    default: break;
  }
}

void SymbolTable::foldChain(Syntax& tree, const std::string& place) const {
  for (size_t i = 0; i < tree.text.size(); ++i) {
    const Syntax& right = tree.args[i + 1];
    if (tree.text[i] == '/' && isNumber(right) && right.number == 0) refuse(kDivisionByZero, place);
  }
  if (!std::ranges::all_of(tree.args, isNumber)) return;
  double value = tree.args[0].number;
  uint32_t faults = 0;
  for (size_t i = 0; i < tree.text.size(); ++i)
    value = apply(operatorOf(tree.text[i]), value, tree.args[i + 1].number, 0, faults);
  refuse(faults, place);
  setNumber(tree, value);
}

void SymbolTable::foldCall(Syntax& tree, const std::string& place) const {
  if (!isConstantFunction(tree.args[0])) return;
  const bool closed = std::all_of(tree.args.begin() + 1, tree.args.end(),
                                  [&](const Syntax& s) { return isNumber(s) || isConstantFunction(s); });
  if (!closed) return;
  const std::optional<double> value = constantValue(tree, place);
  if (!value) return;
  const Symbol& callee = (*this)[tree.args[0].index];
  // Compiling a library function with numbers evaluates it without reporting its faults.
  if (callee.definition == nullptr) refuse(faultsOf(*callee.library, tree), place);
  setNumber(tree, *value);
}

}  // namespace rad::calc
