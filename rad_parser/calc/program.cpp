#include "rad_parser/calc/program.h"

#include <fmt/format.h>
#include <math.h>  // j0 and the other Bessel functions are POSIX, not in namespace std

#include <algorithm>
#include <cmath>

#include "rad_parser/calc/noise.h"
#include "rad_parser/error.h"

namespace rad::calc {
namespace {

// Rounds like RADIANCE: adds one half, then truncates towards zero. Returns -1 for NaN.
int rounded(double x) { return std::isnan(x) ? -1 : static_cast<int>(std::clamp(x, -1e9, 1e9) + .5); }

double checked(double value, uint32_t& faults) {
  if (std::isfinite(value)) return value;
  faults |= std::isnan(value) ? kDomainError : kRangeError;
  return 0;
}

double quotient(double a, double b, uint32_t& faults) {
  if (b != 0) return a / b;
  faults |= kDivisionByZero;
  return 0;
}

double power(double a, double b, uint32_t& faults) {
  const double value = std::pow(a, b);
  if (std::isfinite(value)) return value;
  faults |= kIllegalPower;
  return 0;
}

}  // namespace

const char* faultName(uint32_t faults) {
  return faults & kDivisionByZero ? "division by zero"
         : faults & kIllegalPower ? "illegal power"
         : faults & kDomainError  ? "domain error"
         : faults & kRangeError   ? "range error"
                                  : "not finite";
}

double apply(Op op, double a, double b, double c, uint32_t& faults) {
  switch (op) {
    case Op::negate: return -a;
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return a * b;
    case Op::divide: return quotient(a, b, faults);
    case Op::power: return power(a, b, faults);
    case Op::sin: return checked(std::sin(a), faults);
    case Op::cos: return checked(std::cos(a), faults);
    case Op::tan: return checked(std::tan(a), faults);
    case Op::asin: return checked(std::asin(a), faults);
    case Op::acos: return checked(std::acos(a), faults);
    case Op::atan: return checked(std::atan(a), faults);
    case Op::exp: return checked(std::exp(a), faults);
    case Op::log: return checked(std::log(a), faults);
    case Op::log10: return checked(std::log10(a), faults);
    case Op::sqrt: return checked(std::sqrt(a), faults);
    case Op::floor: return checked(std::floor(a), faults);
    case Op::ceil: return checked(std::ceil(a), faults);
    case Op::random: return checked(randomOf(a), faults);
    case Op::erf: return checked(std::erf(a), faults);
    case Op::erfc: return checked(std::erfc(a), faults);
    case Op::j0: return checked(::j0(a), faults);
    case Op::j1: return checked(::j1(a), faults);
    case Op::y0: return checked(::y0(a), faults);
    case Op::y1: return checked(::y1(a), faults);
    case Op::atan2: return checked(std::atan2(a, b), faults);
    // The order is rounded like the index of select(). Its magnitude is limited because the C library's
    // recurrences take time in proportion to it.
    case Op::jn: return std::abs(a) < 1e6 ? checked(::jn(static_cast<int>(a + .5), b), faults) : 0;
    case Op::yn: return std::abs(a) < 1e6 ? checked(::yn(static_cast<int>(a + .5), b), faults) : 0;
    case Op::min: return a > b ? b : a;
    case Op::max: return a < b ? b : a;
    case Op::noise3: return checked(noise3(a, b, c), faults);
    case Op::fractalNoise3: return checked(fractalNoise3(a, b, c), faults);
    case Op::finite: return checked(a, faults);
    default: return 0;  // not an operator
  }
}

// Allocates and initializes an activation of a frame: the constants, and the cells, none of which is computed
// yet.
double* Program::enter(const Frame& frame, State& state, uint32_t base, uint32_t cellBase) const {
  const size_t top = size_t{base} + frame.registers, cellTop = size_t{cellBase} + frame.cells;
  if (state.registers_.size() < top) state.registers_.resize(2 * top);
  if (state.cells_.size() < cellTop) state.cells_.resize(2 * cellTop);
  double* r = state.registers_.data() + base;
  const double* constants = constants_.data() + frame.firstConstant;
  for (uint32_t i = 0; i < frame.constants; ++i) r[i] = constants[i];
  State::Cell* cells = state.cells_.data() + cellBase;
  const uint32_t* starts = cellStarts_.data() + frame.firstCell;
  for (uint32_t i = frame.parameters; i < frame.cells; ++i) cells[i] = {starts[i], base, cellBase};
  return r;
}

// Pushes an entry onto the return stack. The caller keeps the depth of the stack, so that the interpreter can
// hold it in a register.
void Program::push(const Frame& frame, State& state, size_t depth, size_t registers, State::Return back) {
  if (depth >= kMaxDepth || registers > kMaxRegisters)
    throw Error(fmt::format("{}: recursion is too deep or endless", frame.name));
  if (depth == state.returns_.size()) state.returns_.resize(2 * depth + 64);
  state.returns_[depth] = back;
}

void Program::evaluate(const Point& point, State& state, std::span<double> out) const {
  const Instruction* const code = code_.data();
  // base and cellBase are the first register and cell of the running frame; top and cellTop are the first
  // ones that no activation uses. None of these variables is captured or passed by reference, because the
  // compiler would then keep it in memory instead of a register.
  uint32_t base = 0, cellBase = 0;
  double* r = enter(frames_[0], state, 0, 0);
  uint32_t top = frames_[0].registers, cellTop = frames_[0].cells;
  size_t depth = 0, calls = 0;
  uint32_t faults = 0;
  const Instruction* i = code + frames_[0].begin;

  while (true) {
    switch (i->op) {
      case Op::input: r[i->to] = point.inputs[i->a]; break;
      case Op::argument: r[i->to] = point.arguments[i->a]; break;
      case Op::move: r[i->to] = r[i->a]; break;
      case Op::moveFinite: r[i->to] = checked(r[i->a], faults); break;
      case Op::negate: r[i->to] = -r[i->a]; break;
      case Op::add: r[i->to] = r[i->a] + r[i->b]; break;
      case Op::subtract: r[i->to] = r[i->a] - r[i->b]; break;
      case Op::multiply: r[i->to] = r[i->a] * r[i->b]; break;
      case Op::divide: r[i->to] = quotient(r[i->a], r[i->b], faults); break;
      case Op::min: r[i->to] = r[i->a] > r[i->b] ? r[i->b] : r[i->a]; break;
      case Op::max: r[i->to] = r[i->a] < r[i->b] ? r[i->b] : r[i->a]; break;
      case Op::sqrt: r[i->to] = checked(std::sqrt(r[i->a]), faults); break;
      case Op::floor: r[i->to] = checked(std::floor(r[i->a]), faults); break;
      case Op::sin: r[i->to] = checked(std::sin(r[i->a]), faults); break;
      case Op::cos: r[i->to] = checked(std::cos(r[i->a]), faults); break;
      case Op::noise3: r[i->to] = checked(noise3(r[i->a], r[i->b], r[i->c]), faults); break;
      case Op::jump: i = code + i->a; continue;
      case Op::jumpUnlessPositive:
        if (!(r[i->a] > 0)) {
          i = code + i->b;
          continue;
        }
        break;
      case Op::choose: {  // lists_[b]: the target if no choice applies, then the targets of the c choices
        const double x = r[i->a];
        int n = rounded(x);
        const int choices = static_cast<int>(i->c);
        if (!(x >= -.5) || n >= choices) n = -1;
        i = code + lists_[i->b + static_cast<uint32_t>(n + 1)];
        continue;
      }
      case Op::zeroRange:
        faults |= kDomainError;
        r[i->to] = 0;
        break;
      case Op::realArgument: {
        const int n = rounded(r[i->a]);
        if (n > static_cast<int>(point.reals.size()))
          throw Error(fmt::format("{}: missing real argument {}", messages_[i->b], n));
        r[i->to] = n < 1 ? static_cast<double>(point.reals.size()) : point.reals[static_cast<size_t>(n - 1)];
        break;
      }
      case Op::host: {
        const HostFunction& host = hosts_[i->a];
        double arguments[8];
        const size_t count = std::min<size_t>(i->c, 8);
        for (size_t k = 0; k < count; ++k) arguments[k] = r[lists_[i->b + k]];
        r[i->to] = checked(host.call(point, {arguments, count}), faults);
        break;
      }
      case Op::force:
      case Op::forceGlobal: {
        const bool own = i->op == Op::force;
        const uint32_t cell = i->a + (own ? cellBase : 0);
        State::Cell& c = state.cells_[cell];
        if (c.pc == kDone) break;
        if (c.pc == kBusy) throw Error(fmt::format("{}: value depends on itself", frames_[0].name));
        const auto next = static_cast<uint32_t>(i - code) + 1;
        push(frames_[0], state, depth++, top, {next, base, cellBase, cell, i->to + (own ? base : 0)});
        base = c.base;
        cellBase = c.cellBase;
        r = state.registers_.data() + base;
        i = code + c.pc;
        c.pc = kBusy;
        continue;
      }
      case Op::global: r[i->to] = state.registers_[i->a]; break;
      case Op::returnCell: {
        const double value = r[i->a];
        const State::Return& back = state.returns_[--depth];
        state.cells_[back.cell].pc = kDone;
        base = back.base;
        cellBase = back.cellBase;
        r = state.registers_.data() + base;
        state.registers_[back.to] = value;
        i = code + back.pc;
        continue;
      }
      case Op::call: {
        const Frame& callee = frames_[i->a];
        const auto next = static_cast<uint32_t>(i - code) + 1;
        if (++calls > kMaxCalls) throw Error(fmt::format("{}: more than {} calls", callee.name, kMaxCalls));
        push(callee, state, depth++, top, {next, base, cellBase, kNoCell, base + i->to});
        const uint32_t* arguments = lists_.data() + i->b;
        r = enter(callee, state, top, cellTop);
        const double* caller = state.registers_.data() + base;
        const State::Cell* callerCells = state.cells_.data() + cellBase;
        State::Cell* cells = state.cells_.data() + cellTop;
        for (uint32_t k = 0; k < callee.parameters; ++k, arguments += 3) {
          // An argument is a register that holds its value, or code that computes it in the caller's frame.
          // If the caller keeps a cell for that code, the value may meanwhile be there.
          const bool isDone =
              arguments[1] == kDone || (arguments[2] != kNoCell && callerCells[arguments[2]].pc == kDone);
          cells[k] = {isDone ? kDone : arguments[1], base, cellBase};
          if (isDone) r[callee.constants + k] = caller[arguments[0]];
        }
        base = top;
        cellBase = cellTop;
        top += callee.registers;
        cellTop += callee.cells;
        i = code + callee.begin;
        continue;
      }
      case Op::returnCall: {
        const double value = r[i->a];
        const State::Return& back = state.returns_[--depth];
        top = base;
        cellTop = cellBase;
        base = back.base;
        cellBase = back.cellBase;
        r = state.registers_.data() + base;
        state.registers_[back.to] = value;
        i = code + back.pc;
        continue;
      }
      case Op::fail: state.faults |= faults; throw Error(messages_[i->a]);
      case Op::halt:
        for (size_t k = 0; k < outputs_.size(); ++k) out[k] = r[outputs_[k]];
        state.faults |= faults;
        return;
      default: r[i->to] = apply(i->op, r[i->a], r[i->b], r[i->c], faults); break;
    }
    ++i;
  }
}

}  // namespace rad::calc
