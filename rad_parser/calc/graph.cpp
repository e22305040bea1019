#include "rad_parser/calc/graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rad::calc {
namespace {

constexpr uint32_t kMostCost = 1u << 20;  // cap on costs, so that sums do not overflow

// Whether an operation is one of these, in the order of the enumeration.
bool isWithin(Op op, Op first, Op last) { return first <= op && op <= last; }

uint32_t ownCost(Op op) {
  if (isWithin(op, Op::constant, Op::parameter)) return 0;
  if (isWithin(op, Op::negate, Op::multiply) || isWithin(op, Op::min, Op::max) || op == Op::finite) return 1;
  if (isWithin(op, Op::ifPositive, Op::select)) return 2;
  if (op == Op::divide || isWithin(op, Op::sqrt, Op::ceil) || op == Op::realArgument) return 3;
  if (op == Op::noise3) return 30;
  if (op == Op::global || op == Op::fractalNoise3 || isWithin(op, Op::host, Op::call)) return 100;
  return 15;
}

}  // namespace

int directOperands(Op op) {
  if (isWithin(op, Op::constant, Op::global) || op == Op::select || isWithin(op, Op::host, Op::fail))
    return 0;
  if (isWithin(op, Op::add, Op::power) || isWithin(op, Op::atan2, Op::max)) return 2;
  if (isWithin(op, Op::noise3, Op::fractalNoise3) || op == Op::ifPositive) return 3;
  return 1;
}

Id Graph::add(Node n) {
  uint64_t hash = static_cast<uint64_t>(n.op);
  const auto mix = [&](uint64_t v) { hash = (hash ^ v) * 0x9e3779b97f4a7c15ull + (hash >> 29); };
  mix(n.a);
  mix(n.b);
  mix(n.c);
  mix(std::bit_cast<uint64_t>(n.value));
  for (Id id : n.list) mix(id);
  const auto [from, to] = known_.equal_range(hash);
  for (auto it = from; it != to; ++it) {
    if (nodes_[it->second] == n) return it->second;
  }
  const Id id = static_cast<Id>(nodes_.size());
  weigh(n);
  nodes_.push_back(std::move(n));
  known_.emplace(hash, id);
  return id;
}

Id Graph::constant(double value) { return add({.value = value}); }

Id Graph::leaf(Op op, uint32_t a) { return add({.op = op, .a = a}); }

Id Graph::operate(Op op, Id a, Id b, Id c) {
  const int operands = directOperands(op);
  if (isConstant(a) && (operands < 2 || isConstant(b)) && (operands < 3 || isConstant(c))) {
    uint32_t faults = 0;
    const double value = apply(op, nodes_[a].value, operands > 1 ? nodes_[b].value : 0,
                               operands > 2 ? nodes_[c].value : 0, faults);
    if (faults == 0) return constant(value);
  }
  switch (op) {
    case Op::negate:
      if (nodes_[a].op == Op::negate) return nodes_[a].a;
      break;
    case Op::subtract:
      if (isConstant(b)) return operate(Op::add, a, constant(-nodes_[b].value));
      break;
    case Op::add:
      if (isConstant(b, 0)) return a;
      if (isConstant(a, 0)) return b;
      if (a > b) std::swap(a, b);
      break;
    case Op::multiply:
      if (isConstant(a, 0) || isConstant(b, 1)) return a;
      if (isConstant(b, 0) || isConstant(a, 1)) return b;
      if (a > b) std::swap(a, b);
      break;
    case Op::divide:
      // Like RADIANCE, multiplies by the reciprocal of a constant divisor. The result may differ from the
      // quotient by one rounding.
      if (isConstant(b) && std::isnormal(1 / nodes_[b].value))
        return operate(Op::multiply, a, constant(1 / nodes_[b].value));
      break;
    case Op::power: return raise(a, b);
    case Op::finite:
      if (nodes_[a].isFinite) return a;
      break;
    default: break;
  }
  Node n{.op = op, .a = a};
  if (operands > 1) n.b = b;
  if (operands > 2) n.c = c;
  return add(std::move(n));
}

Id Graph::product(Id a, int times) {
  if (times == 1) return a;
  const Id half = product(a, times / 2);
  const Id even = operate(Op::multiply, half, half);
  return times % 2 == 0 ? even : operate(Op::multiply, even, a);
}

// Small integer powers are computed by multiplication. The result differs from pow() by at most as many
// roundings as the exponent. As in Op::power, it is zero if it is not finite.
Id Graph::raise(Id a, Id b) {
  if (isConstant(b)) {
    const double e = nodes_[b].value;
    if (e == 0) return constant(1);
    if (e == 1) return operate(Op::finite, a);
    if (e == .5) return operate(Op::sqrt, a);
    if (e >= 2 && e <= 16 && e == std::floor(e)) return operate(Op::finite, product(a, static_cast<int>(e)));
  }
  if (isConstant(a, 1)) return a;
  return add({.op = Op::power, .a = a, .b = b});
}

// Sets the members of a node that depend on its operands.
void Graph::weigh(Node& n) const {
  n.cost = ownCost(n.op);
  n.mayFail = n.op == Op::fail || n.op == Op::call || n.op == Op::host || n.op == Op::realArgument ||
              n.op == Op::global;
  const auto include = [&](Id operand) {
    n.cost = std::min(n.cost + nodes_[operand].cost, kMostCost);
    n.mayFail |= nodes_[operand].mayFail;
  };
  const int operands = directOperands(n.op);
  if (operands > 0) include(n.a);
  if (operands > 1) include(n.b);
  if (operands > 2) include(n.c);
  for (Id id : n.list) include(id);
  n.isFinite = isAlwaysFinite(n);
}

bool Graph::isAlwaysFinite(const Node& n) const {
  switch (n.op) {
    case Op::constant: return std::isfinite(n.value);
    case Op::negate: return nodes_[n.a].isFinite;
    case Op::min:
    case Op::max: return nodes_[n.a].isFinite && nodes_[n.b].isFinite;
    case Op::call:
    case Op::realArgument: return false;
    default: return !isWithin(n.op, Op::argument, Op::global) && !isWithin(n.op, Op::add, Op::divide);
  }
}

}  // namespace rad::calc
