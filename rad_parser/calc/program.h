#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rad::calc {

// What one evaluation sees: the point at which the renderer stands. All spans belong to the caller.
struct Point {
  std::span<const double> inputs;  // the renderer's variables, in the order of Interface::inputs
  std::span<const double>
      reals;  // arg(1), arg(2).. of the primitive; not read where the program was given them
  std::span<const double> arguments;  // of a program compiled by Library::compileCall
};

// What went wrong in a value that is therefore 0, as the original defines it: x/0; a power, or a library
// function's value, that is not a number or not finite.
enum Fault : uint32_t { kDivisionByZero = 1, kIllegalPower = 2, kDomainError = 4, kRangeError = 8 };

// A function that the renderer supplies: called with `arity` arguments, of which more may be given. It may
// depend on the point and nothing else, and may throw. `needs`: bit i for each of Interface::inputs that it
// reads.
struct HostFunction {
  std::string name;
  int arity = 1;
  uint64_t needs = 0;
  double (*call)(const Point& point, std::span<const double> arguments) = nullptr;
};

// Registers and stack of evaluations: one for each thread, for any number of programs.
class State {
 public:
  uint32_t faults = 0;  // Fault bits, collected until the caller clears them

 private:
  friend class Program;
  // A value that is computed when first needed. pc: its code; kDone when it has been computed, kBusy while it
  // is.
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
  // of two
  atan2,
  jn,
  yn,
  min,
  max,
  // of three
  noise3,
  fractalNoise3,
  // of any number
  finite,
  ifPositive,
  select,
  realArgument,
  host,
  call,
  // an error if it is evaluated
  fail,
  // instructions that are no values
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

// Compiled expressions: immutable, shared by all threads. Straight-line code over registers; what only one
// branch of an if() needs is in that branch, what several places may need is computed once, at the first.
class Program {
 public:
  // Number of values that evaluate() writes: one for each expression.
  size_t outputs() const { return outputs_.size(); }

  // Bit i: evaluate() reads Point::inputs[i].
  uint64_t inputs() const { return inputs_; }

  // Whether the values depend on nothing. Then any point will do.
  bool isConstant() const { return constant_; }

  // Evaluates all expressions at a point. out.size() >= outputs(). Every fault makes its value 0 and sets a
  // bit in state.faults. Throws Error with the place in the function file: a name that is not defined, an
  // argument that is missing, recursion beyond kMaxDepth or kMaxCalls. After a throw, state may be used
  // again. Thread-safe with one state for each thread.
  void evaluate(const Point& point, State& state, std::span<double> out) const;
  double evaluate(const Point& point, State& state) const {
    double value = 0;
    evaluate(point, state, {&value, 1});
    return value;
  }

  // Number of instructions, for tests and curiosity.
  size_t size() const { return code_.size(); }

  // Calls and postponed values under evaluation at one time, and the registers (8 bytes each) that they may
  // hold.
  static constexpr size_t kMaxDepth = 100000, kMaxRegisters = size_t{1} << 25;
  // Calls in one evaluation, a second or so: recursion that branches ends late though it is not deep.
  static constexpr size_t kMaxCalls = 20000000;

 private:
  friend class CodeWriter;
  static constexpr uint32_t kDone = 0, kBusy = 0xffffffff, kNoCell = 0xffffffff;

  struct Instruction {
    Op op;
    uint32_t to, a, b, c;
  };
  // A function's code and what its activation needs: constants in the first registers, then parameters, then
  // the rest.
  struct Frame {
    std::string name;  // "fun.cal:7: f"
    uint32_t begin = 0;
    uint32_t registers = 0;
    uint32_t firstConstant = 0, constants = 0;
    uint32_t parameters = 0;
    uint32_t firstCell = 0, cells = 0;  // the first cells are the parameters'
  };

  double* enter(const Frame& frame, State& state, uint32_t base, uint32_t cellBase) const;
  static void push(const Frame& frame, State& state, size_t depth, size_t registers, State::Return back);

  std::vector<Instruction> code_;
  std::vector<Frame> frames_;  // the first evaluates the expressions
  std::vector<double> constants_;
  std::vector<uint32_t> cellStarts_;
  std::vector<uint32_t> lists_;  // operands of instructions that have many
  std::vector<std::string> messages_;
  std::vector<HostFunction> hosts_;
  std::vector<uint32_t> outputs_;  // registers
  uint64_t inputs_ = 0;
  bool constant_ = false;
};

// The value of an operator or function of one to three arguments; 0 and a fault where it has none.
double apply(Op op, double a, double b, double c, uint32_t& faults);

}  // namespace rad::calc
