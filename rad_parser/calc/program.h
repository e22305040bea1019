#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rad::calc {

// The data of one evaluation, at one point of a surface. The caller owns all spans.
struct Point {
  std::span<const double> inputs;  // the renderer's variables, in the order of Interface::inputs
  // arg(1), arg(2), ... of the primitive. Not read if the program was compiled for these values.
  std::span<const double> reals;
  std::span<const double> arguments;  // arguments of the function, in a program from Library::compileCall()
};

// Reasons why an undefined value is replaced by 0, as in RADIANCE: division by zero, or a power or library
// function without a finite result.
enum Fault : uint32_t { kDivisionByZero = 1, kIllegalPower = 2, kDomainError = 4, kRangeError = 8 };

// The name of the first fault that is set. "not finite" if there is none, because in RADIANCE the overflow of
// a sum or product is not a fault.
const char* faultName(uint32_t faults);

// A function supplied by the renderer. It is called with all arguments of the call, at least `arity`. It may
// only depend on the point and its arguments, and may throw. `needs`: bit i is set if it reads input i of
// Interface::inputs.
struct HostFunction {
  std::string name;
  int arity = 1;
  uint64_t needs = 0;
  double (*call)(const Point& point, std::span<const double> arguments) = nullptr;
};

// The memory for evaluations, one for each thread. It can be used for any number of programs.
class State {
 public:
  uint32_t faults = 0;  // Fault bits of all evaluations since the caller cleared them

 private:
  friend class Program;
  // A value that is computed when it is first needed. pc: the start of its code; kDone after the computation,
  // kBusy during it.
  struct Cell {
    uint32_t pc, base, cellBase;
  };
  struct Return {
    uint32_t pc, base, cellBase, cell, to;
  };
  std::vector<double> registers_;
  std::vector<Cell> cells_;
  std::vector<Return> returns_;
};

// The functions of graph.cpp rely on the order.
enum class Op : uint8_t {
  // values without operands
  constant,
  input,
  argument,
  parameter,
  global,
  // arithmetic
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  // library functions of one argument
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  exp,
  log,
  log10,
  sqrt,
  floor,
  ceil,
  random,
  erf,
  erfc,
  j0,
  j1,
  y0,
  y1,
  // library functions of two arguments
  atan2,
  jn,
  yn,
  min,
  max,
  // library functions of three arguments
  noise3,
  fractalNoise3,
  // operations with any number of operands
  finite,
  ifPositive,
  select,
  realArgument,
  host,
  call,
  // throws an error when evaluated
  fail,
  // instructions without a value
  move,
  moveFinite,
  jump,
  jumpUnlessPositive,
  choose,
  force,
  forceGlobal,
  returnCell,
  returnCall,
  zeroRange,
  halt,
};

// Compiled expressions. Immutable, and shared by all threads. The program is straight-line code on registers.
// A value that is needed in only one branch of an if() is computed in that branch. A value that may be needed
// in several places is computed once, at the first place that is reached.
class Program {
 public:
  // The number of results of evaluate(): one for each expression.
  size_t outputs() const { return outputs_.size(); }

  // Bit i is set if evaluate() may read Point::inputs[i].
  uint64_t inputs() const { return inputs_; }

  // Whether the values do not depend on the point. An empty Point is then sufficient.
  bool isConstant() const { return constant_; }

  // Evaluates all expressions at a point. Requires out.size() >= outputs(). In case of a fault, the value is
  // 0 and a bit of state.faults is set. Throws Error, with the place in the function file, for an undefined
  // name, a missing argument, or recursion beyond kMaxDepth or kMaxCalls; the state may be used again
  // afterwards. Thread-safe if each thread has its own state.
  void evaluate(const Point& point, State& state, std::span<double> out) const;
  double evaluate(const Point& point, State& state) const {
    double value = 0;
    evaluate(point, state, {&value, 1});
    return value;
  }

  // The number of instructions, for tests.
  size_t size() const { return code_.size(); }

  // Limits on the number of calls and postponed values in progress at the same time, and on their registers
  // (8 bytes each).
  static constexpr size_t kMaxDepth = 100000, kMaxRegisters = size_t{1} << 25;
  // Limit on the calls in one evaluation; they take about a second. Branching recursion can run for very long
  // without being deep.
  static constexpr size_t kMaxCalls = 20000000;

 private:
  friend class CodeWriter;
  static constexpr uint32_t kDone = 0, kBusy = 0xffffffff, kNoCell = 0xffffffff;

  struct Instruction {
    Op op;
    uint32_t to, a, b, c;
  };
  // The code of a function and the memory of one activation. The first registers hold constants,
  // the next ones parameters.
  struct Frame {
    std::string name;  // "fun.cal:7: f"
    uint32_t begin = 0;
    uint32_t registers = 0;
    uint32_t firstConstant = 0, constants = 0;
    uint32_t parameters = 0;
    uint32_t firstCell = 0, cells = 0;  // the first cells belong to the parameters
  };

  double* enter(const Frame& frame, State& state, uint32_t base, uint32_t cellBase) const;
  static void push(const Frame& frame, State& state, size_t depth, size_t registers, State::Return back);

  std::vector<Instruction> code_;
  std::vector<Frame> frames_;  // the first one evaluates the expressions
  std::vector<double> constants_;
  std::vector<uint32_t> cellStarts_;
  std::vector<uint32_t> lists_;  // operands of instructions with many operands
  std::vector<std::string> messages_;
  std::vector<HostFunction> hosts_;
  std::vector<uint32_t> outputs_;  // registers
  uint64_t inputs_ = 0;
  bool constant_ = false;
};

// The value of an operator or of a library function of one to three arguments. Sets a bit of `faults` and
// returns 0 if the value is undefined.
double apply(Op op, double a, double b, double c, uint32_t& faults);

}  // namespace rad::calc
