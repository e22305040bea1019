#include "rad_parser/calc/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <map>
#include <unordered_map>

#include "rad_parser/calc/noise.h"
#include "rad_parser/error.h"

// How a program is made. Function files are many small definitions that refer to each other, so:
// 1. Every expression is expanded into one graph of operations: a call is replaced by the function's body, an
//    argument by its value's node; equal nodes are one node, operations on constants are done. Recursion is
//    expanded too as long as some argument is a new constant each time (an octave of turbulence); else it
//    becomes a call of a compiled frame. Arguments that are functions are known by name, so each frame is
//    made for the functions it was given.
// 2. Nodes are placed in scopes: the outermost is always evaluated, each branch of an if() or select() is an
//    inner one. A node goes where all its uses can see it. Where none of its uses is certain to be reached,
//    and it costs more than a test, it becomes a cell: code of its own that runs once, when first needed.
//    Arguments of calls likewise.
// 3. Scopes are written as code in the order of the nodes' creation, in which operands precede their users.
namespace rad::calc {
namespace {

using Kind = Syntax::Kind;
using Id = uint32_t;
constexpr Id kNone = 0xffffffff;

constexpr int kMaxCompileDepth =
    2500;                         // levels of trees within definitions within arguments: the stack is finite
constexpr int kMaxUnrolled = 64;  // expansions of a function within itself
constexpr size_t kMaxExpansions = 20000;  // in one program; beyond it functions are called
constexpr uint32_t kCheap = 8;            // cost up to which a value is computed unasked. Unit: an addition
constexpr uint32_t kMostCost = 1u << 20;

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

// Operands that are nodes in Node::a, b, c.
int directOperands(Op op) {
  switch (op) {
    case Op::constant:
    case Op::input:
    case Op::argument:
    case Op::parameter:
    case Op::global:
    case Op::fail:
    case Op::select:
    case Op::host:
    case Op::call:
      return 0;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::atan2:
    case Op::jn:
    case Op::yn:
    case Op::min:
    case Op::max:
      return 2;
    case Op::noise3:
    case Op::fractalNoise3:
    case Op::ifPositive:
      return 3;
    default:
      return 1;
  }
}

uint32_t ownCost(Op op) {
  switch (op) {
    case Op::constant:
    case Op::input:
    case Op::argument:
    case Op::parameter:
      return 0;
    case Op::negate:
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::min:
    case Op::max:
    case Op::finite:
      return 1;
    case Op::divide:
    case Op::sqrt:
    case Op::floor:
    case Op::ceil:
    case Op::realArgument:
      return 3;
    case Op::ifPositive:
    case Op::select:
      return 2;
    case Op::noise3:
      return 30;
    case Op::host:
    case Op::call:
    case Op::global:
    case Op::fractalNoise3:
      return 100;
    default:
      return 15;
  }
}

struct Node {
  Op op = Op::constant;
  uint32_t a = 0, b = 0, c = 0;  // operands, or what the operation is about: a slot, a message, a frame
  double value = 0;              // constant
  std::vector<Id> list;          // operands of host, call, and select: its index, their number, they
  uint32_t cost = 0;             // of itself and all below, as if nothing were shared
  bool mayFail = false;          // evaluating it can throw, or not end
  bool isFinite = false;         // always

  bool operator==(const Node& n) const {
    return op == n.op && a == n.a && b == n.b && c == n.c &&
           std::bit_cast<uint64_t>(value) == std::bit_cast<uint64_t>(n.value) && list == n.list;
  }
};

// The operations of one frame, each once, operands before users.
class Graph {
 public:
  const Node& operator[](Id id) const { return nodes_[id]; }
  size_t size() const { return nodes_.size(); }

  Id add(Node n) {
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

  Id constant(double value) {
    Node n;
    n.value = value;
    return add(n);
  }
  Id leaf(Op op, uint32_t a) {
    Node n;
    n.op = op;
    n.a = a;
    return add(n);
  }
  bool isConstant(Id id) const { return nodes_[id].op == Op::constant; }
  bool isConstant(Id id, double value) const { return isConstant(id) && nodes_[id].value == value; }

  // An operator or function of one to three arguments, simplified.
  Id operate(Op op, Id a, Id b = kNone, Id c = kNone) {
    const int operands = directOperands(op);
    if (isConstant(a) && (operands < 2 || isConstant(b)) && (operands < 3 || isConstant(c))) {
      uint32_t faults = 0;
      const double value = apply(op, nodes_[a].value, operands > 1 ? nodes_[b].value : 0,
                                 operands > 2 ? nodes_[c].value : 0, faults);
      // What has no value says so whenever it is evaluated.
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
        // One multiplication, as the original has it where the divisor is a constant: off by a rounding.
        if (isConstant(b) && std::isnormal(1 / nodes_[b].value)) {
          return operate(Op::multiply, a, constant(1 / nodes_[b].value));
        }
        break;
      case Op::power:
        return raise(a, b);
      case Op::finite:
        if (nodes_[a].isFinite) return a;
        break;
      default:
        break;
    }
    Node n;
    n.op = op;
    n.a = a;
    if (operands > 1) n.b = b;
    if (operands > 2) n.c = c;
    return add(n);
  }

 private:
  Id product(Id a, int times) {
    if (times == 1) return a;
    const Id half = product(a, times / 2);
    const Id even = operate(Op::multiply, half, half);
    return times % 2 == 0 ? even : operate(Op::multiply, even, a);
  }

  // Small powers by multiplication, within as many roundings of pow() as the exponent says, and zero like it
  // where the result is not finite.
  Id raise(Id a, Id b) {
    if (isConstant(b)) {
      const double e = nodes_[b].value;
      if (e == 0) return constant(1);
      if (e == 1) return operate(Op::finite, a);
      if (e == .5) return operate(Op::sqrt, a);
      if (e >= 2 && e <= 16 && e == std::floor(e))
        return operate(Op::finite, product(a, static_cast<int>(e)));
    }
    if (isConstant(a, 1)) return a;
    Node n;
    n.op = Op::power;
    n.a = a;
    n.b = b;
    return add(n);
  }

  void weigh(Node& n) const {
    n.cost = ownCost(n.op);
    n.mayFail = n.op == Op::fail || n.op == Op::call || n.op == Op::host || n.op == Op::realArgument ||
                n.op == Op::global;
    const auto below = [&](Id id) {
      n.cost = std::min(n.cost + nodes_[id].cost, kMostCost);
      n.mayFail |= nodes_[id].mayFail;
    };
    const int operands = directOperands(n.op);
    if (operands > 0) below(n.a);
    if (operands > 1) below(n.b);
    if (operands > 2) below(n.c);
    for (Id id : n.list) below(id);
    switch (n.op) {
      case Op::constant:
        n.isFinite = std::isfinite(n.value);
        break;
      case Op::input:
        n.isFinite = true;
        break;
      case Op::negate:
        n.isFinite = nodes_[n.a].isFinite;
        break;
      case Op::min:
      case Op::max:
        n.isFinite = nodes_[n.a].isFinite && nodes_[n.b].isFinite;
        break;
      case Op::argument:
      case Op::parameter:
      case Op::global:
      case Op::add:
      case Op::subtract:
      case Op::multiply:
      case Op::divide:
      case Op::call:
      case Op::realArgument:
        n.isFinite = false;
        break;
      default:
        n.isFinite = true;
        break;
    }
  }

  std::vector<Node> nodes_;
  std::unordered_multimap<uint64_t, Id> known_;
};

// A frame while it is being compiled: a graph and the nodes of its results.
struct FrameGraph {
  Graph graph;
  std::string name;
  uint32_t parameters = 0;
  std::vector<Id> results;
  std::vector<Id> globals;  // of the first frame: nodes that others refer to
};

// Where a tree stands: the definition that it belongs to and what its parameters are.
struct Scope;

// An argument that has not been looked at, or its node.
struct Argument {
  const Syntax* tree = nullptr;  // none: node or symbol is given
  const Scope* scope = nullptr;  // in which the tree stands
  Id node = kNone;
  int symbol = -1;  // a function's name, where the frame was made for it
};

struct Scope {
  const Definition* definition = nullptr;  // none: the primitive's own expressions
  const Scope* caller = nullptr;           // in which the call of the definition stands
  mutable std::vector<Argument> arguments;
  FrameGraph* frame = nullptr;
};

class Compiler {
 public:
  explicit Compiler(const CompileInput& input) : input_(input) { newFrame("expression", 0); }

  void expressions(std::span<const Syntax> trees) {
    const Scope* scope = newScope(nullptr, nullptr, *frames_[0]);
    for (const Syntax& tree : trees) frames_[0]->results.push_back(compile(tree, *scope));
  }

  void call(int symbol, int count) {
    Scope* scope = newScope(nullptr, nullptr, *frames_[0]);
    Syntax tree;
    tree.kind = Kind::call;
    tree.args.resize(static_cast<size_t>(count) + 1);
    tree.args[0].kind = Kind::name;
    tree.args[0].index = symbol;
    for (int i = 0; i < count; ++i) {
      Syntax& argument = tree.args[static_cast<size_t>(i) + 1];
      argument.kind = Kind::parameter;
      argument.index = i;
      scope->arguments.push_back({});
      scope->arguments.back().node = frames_[0]->graph.leaf(Op::argument, static_cast<uint32_t>(i));
    }
    frames_[0]->results.push_back(compile(tree, *scope));
  }

  std::vector<std::unique_ptr<FrameGraph>>& frames() { return frames_; }
  std::vector<std::string>& messages() { return messages_; }
  std::vector<HostFunction>& hosts() { return hosts_; }

 private:
  FrameGraph* newFrame(std::string name, uint32_t parameters) {
    frames_.push_back(std::make_unique<FrameGraph>());
    frames_.back()->name = std::move(name);
    frames_.back()->parameters = parameters;
    return frames_.back().get();
  }

  Scope* newScope(const Definition* definition, const Scope* caller, FrameGraph& frame) {
    scopes_.push_back({});
    scopes_.back().definition = definition;
    scopes_.back().caller = caller;
    scopes_.back().frame = &frame;
    return &scopes_.back();
  }

  std::string place(const Syntax& tree, const Scope& scope) const {
    return scope.definition != nullptr ? fmt::format("{}:{}", scope.definition->file, tree.line)
                                       : input_.place;
  }

  uint32_t message(std::string text) {
    messages_.push_back(std::move(text));
    return static_cast<uint32_t>(messages_.size() - 1);
  }

  // Reported when it is evaluated: as in the original, what is not needed need not be right.
  Id fail(const Syntax& tree, const Scope& scope, std::string_view problem) {
    return scope.frame->graph.leaf(Op::fail, message(fmt::format("{}: {}", place(tree, scope), problem)));
  }

  const Symbol& symbol(int index) const { return input_.symbols[static_cast<size_t>(index)]; }

  static bool callable(const Symbol& s) {
    return s.definition != nullptr ? s.definition->isFunction() : s.library != nullptr || s.host != nullptr;
  }

  Id compile(const Syntax& tree, const Scope& scope) {
    if (++depth_ > kMaxCompileDepth) {
      throw Error(fmt::format("{}: definitions nested too deeply", place(tree, scope)));
    }
    const Id id = compileInner(tree, scope);
    --depth_;
    return id;
  }

  Id compileInner(const Syntax& tree, const Scope& scope) {
    Graph& graph = scope.frame->graph;
    switch (tree.kind) {
      case Kind::number:
        return graph.constant(tree.number);
      case Kind::channel:
        return channel(tree, scope);
      case Kind::name:
        return variable(tree, scope);
      case Kind::parameter:
        return argument(tree, scope, static_cast<size_t>(tree.index));
      case Kind::negate:
        return graph.operate(Op::negate, compile(tree.args[0], scope));
      case Kind::sum:
      case Kind::product: {
        Id left = compile(tree.args[0], scope);
        for (size_t i = 1; i < tree.args.size(); ++i) {
          const char c = tree.text[i - 1];
          const Op op = c == '+' ? Op::add : c == '-' ? Op::subtract : c == '*' ? Op::multiply : Op::divide;
          left = graph.operate(op, left, compile(tree.args[i], scope));
        }
        return left;
      }
      case Kind::power: {
        const Id base = compile(tree.args[0], scope);
        const Id exponent = compile(tree.args[1], scope);
        // The original's rule for a zero that is written as a number: even 0^0 is 0 where the exponent is
        // not.
        if (tree.args[0].kind == Kind::number && tree.args[0].number == 0 && !graph.isConstant(exponent))
          return base;
        return graph.operate(Op::power, base, exponent);
      }
      case Kind::call:
        return call(tree, scope);
    }
    return kNone;
  }

  Id channel(const Syntax& tree, const Scope& scope) {
    if (tree.index < 1 || static_cast<size_t>(tree.index) > input_.inputs) {
      return fail(tree, scope, fmt::format("there is no channel ${}", tree.index));
    }
    return scope.frame->graph.leaf(Op::input, static_cast<uint32_t>(tree.index - 1));
  }

  bool isUnavailable(const Definition& d) const {
    return !d.isFunction() && d.body.kind == Kind::channel && d.body.index >= 1 && d.body.index <= 64 &&
           (input_.available >> (d.body.index - 1) & 1) == 0;
  }

  Id variable(const Syntax& tree, const Scope& scope) {
    const Symbol& s = symbol(tree.index);
    if (s.definition == nullptr || s.definition->isFunction() || isUnavailable(*s.definition)) {
      return fail(tree, scope, fmt::format("undefined variable \"{}\"", s.name));
    }
    FrameGraph& first = *frames_[0];
    auto [it, isNew] = variables_.try_emplace(s.definition, kNone);
    if (isNew) {
      const Scope* inner = newScope(s.definition, nullptr, first);
      const Id id = compile(s.definition->body, *inner);
      variables_[s.definition] = id;
    } else if (it->second == kNone) {
      return fail(tree, scope, fmt::format("variable \"{}\" is defined by itself", s.name));
    }
    const Id id = variables_[s.definition];
    if (scope.frame == &first) return id;
    // A frame may run many times for one point: what does not depend on its arguments stays with the first
    // frame.
    const Node& n = first.graph[id];
    if (n.op == Op::constant) return scope.frame->graph.constant(n.value);
    if (n.op == Op::input) return scope.frame->graph.leaf(Op::input, n.a);
    first.globals.push_back(id);
    return scope.frame->graph.leaf(Op::global, id);
  }

  Id argument(const Syntax& tree, const Scope& scope, size_t index) {
    if (index >= scope.arguments.size()) {
      const std::string name = scope.definition != nullptr ? scope.definition->name : "expression";
      return fail(tree, scope, fmt::format("{}(): too few arguments", name));
    }
    // Not a reference: compiling may lengthen nothing here, but the argument may be reached again from
    // within.
    const Argument given = scope.arguments[index];
    if (given.node != kNone) return given.node;
    if (given.tree == nullptr) {
      return fail(tree, scope, fmt::format("undefined variable \"{}\"", symbol(given.symbol).name));
    }
    const Id id = compile(*given.tree, *given.scope);
    scope.arguments[index].node = id;
    return id;
  }

  // The function that a callee or argument names, or -1 and what is wrong with it.
  int function(const Syntax& tree, const Scope& scope, std::string& problem) const {
    const Syntax* t = &tree;
    const Scope* s = &scope;
    while (t->kind == Kind::parameter) {
      const size_t index = static_cast<size_t>(t->index);
      if (index >= s->arguments.size()) {
        problem = "too few arguments";
        return -1;
      }
      const Argument& given = s->arguments[index];
      if (given.symbol >= 0) return given.symbol;
      if (given.tree == nullptr) break;
      t = given.tree;
      s = given.scope;
    }
    if (t->kind != Kind::name) {
      problem = "argument that is called is not a function";
      return -1;
    }
    return t->index;
  }

  Id call(const Syntax& tree, const Scope& scope) {
    std::string problem;
    const int index = function(tree.args[0], scope, problem);
    if (index < 0) return fail(tree, scope, fmt::format("{}(): {}", tree.args[0].text, problem));
    const Symbol& s = symbol(index);
    if (s.definition != nullptr && s.definition->isFunction()) return userCall(tree, scope, *s.definition);
    if (s.library != nullptr) return libraryCall(tree, scope, *s.library);
    if (s.host != nullptr && input_.hasHosts) return hostCall(tree, scope, *s.host);
    return fail(tree, scope, fmt::format("undefined function \"{}()\"", s.name));
  }

  Id userCall(const Syntax& tree, const Scope& scope, const Definition& d) {
    Scope* inner = newScope(&d, &scope, *scope.frame);
    for (size_t i = 1; i < tree.args.size() && i <= d.parameters.size(); ++i) {
      inner->arguments.push_back({&tree.args[i], &scope, kNone, -1});
    }
    if (++expansions_ > kMaxExpansions || !mayExpand(d, *inner)) return frameCall(tree, *inner, d);
    return compile(d.body, *inner);
  }

  // Whether the body of d can replace a call: where it does not stand within itself already, or where an
  // argument is a constant that it was not there.
  bool mayExpand(const Definition& d, const Scope& inner) {
    int active = 0;
    std::vector<bool> isNew;
    for (const Scope* s = inner.caller; s != nullptr; s = s->caller) {
      if (s->definition != &d) continue;
      if (++active > kMaxUnrolled) return false;
      if (active == 1) {
        isNew.assign(inner.arguments.size(), false);
        for (size_t i = 0; i < isNew.size(); ++i) {
          std::string unused;
          if (isFunction(inner, i)) continue;
          isNew[i] = inner.frame->graph.isConstant(argument(d.body, inner, i));
        }
      }
      for (size_t i = 0; i < isNew.size(); ++i) {
        if (!isNew[i]) continue;
        const Id before = i < s->arguments.size() ? s->arguments[i].node : kNone;
        // An argument of the outer call that was never looked at, or no constant, is no proof of progress.
        isNew[i] =
            before != kNone && inner.frame->graph.isConstant(before) && before != inner.arguments[i].node;
      }
    }
    return active == 0 || std::find(isNew.begin(), isNew.end(), true) != isNew.end();
  }

  bool isFunction(const Scope& inner, size_t i) const {
    const Argument& given = inner.arguments[i];
    if (given.symbol >= 0) return true;
    if (given.tree == nullptr || (given.tree->kind != Kind::name && given.tree->kind != Kind::parameter))
      return false;
    std::string unused;
    const int index = function(*given.tree, *given.scope, unused);
    return index >= 0 && callable(symbol(index));
  }

  // A call of a frame made for d with these functions as arguments.
  Id frameCall(const Syntax& tree, Scope& inner, const Definition& d) {
    std::string key = fmt::format("{}", static_cast<const void*>(&d));
    std::vector<int> functions;
    for (size_t i = 0; i < inner.arguments.size(); ++i) {
      std::string unused;
      const Argument& given = inner.arguments[i];
      functions.push_back(!isFunction(inner, i) ? -1
                          : given.symbol >= 0   ? given.symbol
                                                : function(*given.tree, *given.scope, unused));
      key += fmt::format(" {}", functions.back());
    }
    auto [it, isNew] = instances_.try_emplace(key, static_cast<uint32_t>(frames_.size()));
    const uint32_t index = it->second;
    if (isNew) {
      const auto count = static_cast<uint32_t>(d.parameters.size());
      FrameGraph* frame = newFrame(fmt::format("{}:{}: {}()", d.file, d.line, d.name), count);
      Scope* body = newScope(&d, nullptr, *frame);
      for (size_t i = 0; i < inner.arguments.size(); ++i) {
        Argument a;
        a.symbol = functions[i];
        if (a.symbol < 0) a.node = frame->graph.leaf(Op::parameter, static_cast<uint32_t>(i));
        body->arguments.push_back(a);
      }
      const Id result = compile(d.body, *body);
      frame->results.push_back(result);
    }
    Node n;
    n.op = Op::call;
    n.a = index;
    for (size_t i = 0; i < d.parameters.size(); ++i) {
      const bool isValue = i < inner.arguments.size() && functions[i] < 0;
      // A frame has no use for the value of a missing argument or of a function's name.
      n.list.push_back(isValue ? argument(tree, inner, i) : inner.frame->graph.constant(0));
    }
    return inner.frame->graph.add(std::move(n));
  }

  Id libraryCall(const Syntax& tree, const Scope& scope, const LibraryFunction& f) {
    Graph& graph = scope.frame->graph;
    const size_t given = tree.args.size() - 1;
    const auto value = [&](size_t n) {
      return n <= given ? compile(tree.args[n], scope)
                        : fail(tree, scope, fmt::format("{}(): too few arguments", f.name));
    };
    switch (f.op) {
      case Op::ifPositive: {
        const Id condition = value(1);
        if (graph.isConstant(condition))
          return graph.operate(Op::finite, value(graph[condition].value > 0 ? 2 : 3));
        Node n;
        n.op = Op::ifPositive;
        n.a = condition;
        n.b = value(2);
        n.c = value(3);
        if (n.b == n.c) return graph.operate(Op::finite, n.b);
        return graph.add(std::move(n));
      }
      case Op::select: {
        const Id index = value(1);
        if (graph.isConstant(index)) {
          const double x = graph[index].value;
          if (!(x >= -.5) || x + .5 >= static_cast<double>(given)) return graph.constant(0);
          const auto n = static_cast<size_t>(x + .5);
          return n == 0 ? graph.constant(static_cast<double>(given - 1))
                        : graph.operate(Op::finite, value(n + 1));
        }
        Node n;
        n.op = Op::select;
        n.list = {index, graph.constant(static_cast<double>(given - 1))};
        for (size_t k = 2; k <= given; ++k) n.list.push_back(value(k));
        return graph.add(std::move(n));
      }
      case Op::min:
      case Op::max: {
        // The original's order, which matters where a value is not a number.
        Id extreme = value(1);
        for (size_t k = given; k > 1; --k) extreme = graph.operate(f.op, extreme, value(k));
        return graph.operate(Op::finite, extreme);
      }
      case Op::realArgument:
        return realArgument(tree, scope, value(1));
      case Op::noise3: {
        const Id p[3] = {value(1), value(2), value(3)};
        const Id here = graph.operate(Op::noise3, p[0], p[1], p[2]);
        if (f.name == "noise3") return here;
        const size_t axis = static_cast<size_t>(f.name.back() - 'x');
        Id q[3] = {p[0], p[1], p[2]};
        q[axis] = graph.operate(Op::subtract, q[axis], graph.constant(kNoiseStep));
        const Id before = graph.operate(Op::noise3, q[0], q[1], q[2]);
        return graph.operate(Op::divide, graph.operate(Op::subtract, here, before),
                             graph.constant(kNoiseStep));
      }
      default: {
        const Id a = value(1);
        const Id b = f.arity > 1 ? value(2) : kNone;
        const Id c = f.arity > 2 ? value(3) : kNone;
        return graph.operate(f.op, a, b, c);
      }
    }
  }

  Id realArgument(const Syntax& tree, const Scope& scope, Id index) {
    Graph& graph = scope.frame->graph;
    if (input_.reals && graph.isConstant(index)) {
      const size_t count = input_.reals->size();
      const double x = graph[index].value + .5;
      if (!(x >= 1)) return graph.constant(static_cast<double>(count));
      if (x >= static_cast<double>(count) + 1) {
        return fail(tree, scope, fmt::format("missing real argument {:.0f}", std::floor(x)));
      }
      return graph.constant((*input_.reals)[static_cast<size_t>(x) - 1]);
    }
    Node n;
    n.op = Op::realArgument;
    n.a = index;
    n.b = realArgumentMessage(place(tree, scope));
    return graph.add(std::move(n));
  }

  // One message for each place, so that equal nodes are equal.
  uint32_t realArgumentMessage(const std::string& place) {
    auto [it, isNew] = places_.try_emplace(place, 0);
    if (isNew) it->second = message(place);
    return it->second;
  }

  Id hostCall(const Syntax& tree, const Scope& scope, const HostFunction& f) {
    if (static_cast<int>(tree.args.size()) - 1 < f.arity) {
      return fail(tree, scope, fmt::format("{}(): too few arguments", f.name));
    }
    Node n;
    n.op = Op::host;
    const auto known =
        std::find_if(hosts_.begin(), hosts_.end(), [&](const auto& h) { return h.name == f.name; });
    n.a = static_cast<uint32_t>(known - hosts_.begin());
    if (known == hosts_.end()) hosts_.push_back(f);
    for (size_t i = 1; i < tree.args.size(); ++i) n.list.push_back(compile(tree.args[i], scope));
    return scope.frame->graph.add(std::move(n));
  }

  const CompileInput& input_;
  std::vector<std::unique_ptr<FrameGraph>> frames_;
  std::deque<Scope> scopes_;
  std::unordered_map<const Definition*, Id> variables_;
  std::map<std::string, uint32_t> instances_;
  std::map<std::string, uint32_t> places_;
  std::vector<std::string> messages_;
  std::vector<HostFunction> hosts_;
  size_t expansions_ = 0;
  int depth_ = 0;
};

}  // namespace

// Writes the graphs as code.
class CodeWriter {
 public:
  explicit CodeWriter(Compiler& compiler) : frames_(compiler.frames()) {
    program_->messages_ = std::move(compiler.messages());
    program_->hosts_ = std::move(compiler.hosts());
  }

  std::shared_ptr<const Program> write() {
    emit(Op::fail);  // at 0, which no jump means
    program_->frames_.resize(frames_.size());
    for (size_t i = 0; i < frames_.size(); ++i) writeFrame(i);
    summarize();
    return program_;
  }

 private:
  using Instruction = Program::Instruction;
  static constexpr uint32_t kRoot = 0;

  struct Block {
    uint32_t parent = kNone;
    uint32_t depth = 0;
    bool isInline = true;     // entered where it stands, not from anywhere
    std::vector<Id> nodes;    // placed in it, operands first
    std::vector<Id> ensured;  // cells that have been forced in it
  };
  struct Placement {
    uint32_t block = kNone;  // of all uses so far the common one; then its own
    bool direct = false;     // a use is in that very block
    bool isCell = false;
    uint32_t cell = 0;
    uint32_t firstBlock =
        kNone;  // of a branching node or a call: that of its first branch, the others follow
    uint32_t reg = 0;
  };
  struct Postponed {  // code to be written after the frame's main line
    uint32_t block;
    Id result;
    uint32_t patch;  // where its begin goes: an entry of lists_ or, for cells, of cellStarts_
    bool isCell;
  };

  uint32_t emit(Op op, uint32_t to = 0, uint32_t a = 0, uint32_t b = 0, uint32_t c = 0) {
    program_->code_.push_back({op, to, a, b, c});
    return static_cast<uint32_t>(program_->code_.size() - 1);
  }
  uint32_t here() const { return static_cast<uint32_t>(program_->code_.size()); }

  uint32_t newBlock(uint32_t parent, bool isInline) {
    blocks_.push_back({});
    Block& b = blocks_.back();
    b.parent = parent;
    b.depth = parent == kNone ? 0 : blocks_[parent].depth + 1;
    b.isInline = isInline;
    return static_cast<uint32_t>(blocks_.size() - 1);
  }

  uint32_t common(uint32_t a, uint32_t b) const {
    while (a != b) {
      if (blocks_[a].depth >= blocks_[b].depth) {
        a = blocks_[a].parent;
      } else {
        b = blocks_[b].parent;
      }
    }
    return a;
  }

  void use(Id id, uint32_t block) {
    Placement& p = placed_[id];
    if (p.block == kNone) {
      p.block = block;
      p.direct = true;
      return;
    }
    const uint32_t shared = common(p.block, block);
    p.direct = (p.direct && shared == p.block) || shared == block;
    p.block = shared;
  }

  bool isPostponed(const Node& n) const { return n.cost > kCheap || n.mayFail; }

  // A parameter may be code that has not run.
  bool isThunk(const Node& n) const { return n.op == Op::parameter || isPostponed(n); }

  // Assigns blocks: users first, so that all uses of a node are known when its turn comes.
  void place(const FrameGraph& frame) {
    const Graph& graph = frame.graph;
    blocks_.clear();
    placed_.assign(graph.size(), {});
    newBlock(kNone, true);
    for (Id id : frame.results) use(id, kRoot);
    std::vector<bool> isGlobal(graph.size(), false);
    for (Id id : frame.globals) {
      use(id, kRoot);
      isGlobal[id] = true;
    }
    for (Id id = static_cast<Id>(graph.size()); id-- > 0;) {
      Placement& p = placed_[id];
      const Node& n = graph[id];
      if (p.block == kNone || n.op == Op::constant || n.op == Op::parameter) continue;
      p.isCell = isGlobal[id] || (!p.direct && isPostponed(n));
      if (p.isCell) p.block = newBlock(p.block, false);
      const uint32_t block = p.block;
      blocks_[block].nodes.push_back(id);
      switch (n.op) {
        case Op::ifPositive:
          use(n.a, block);
          branch(id, block, n.b, true);
          branch(id, block, n.c, true);
          break;
        case Op::select:
          use(n.list[0], block);
          for (size_t i = 1; i < n.list.size(); ++i) branch(id, block, n.list[i], true);
          break;
        case Op::call:
          for (Id operand : n.list) {
            if (isThunk(graph[operand])) {
              branch(id, block, operand, false);
            } else {
              use(operand, block);
            }
          }
          break;
        default: {
          const int operands = directOperands(n.op);
          if (operands > 0) use(n.a, block);
          if (operands > 1) use(n.b, block);
          if (operands > 2) use(n.c, block);
          for (Id operand : n.list) use(operand, block);
        }
      }
    }
    for (Block& b : blocks_) std::reverse(b.nodes.begin(), b.nodes.end());
  }

  void branch(Id id, uint32_t block, Id operand, bool isInline) {
    const uint32_t inner = newBlock(block, isInline);
    if (placed_[id].firstBlock == kNone) placed_[id].firstBlock = inner;
    use(operand, inner);
  }

  void writeFrame(size_t index) {
    const FrameGraph& frame = *frames_[index];
    graph_ = &frame.graph;
    place(frame);
    Program::Frame& out = program_->frames_[index];
    out.name = frame.name;
    out.parameters = frame.parameters;
    assignRegisters(frame, out);

    for (Id id : blocks_[kRoot].nodes) {
      const Node& n = (*graph_)[id];
      if (index == 0 && n.op == Op::fail) throw Error(program_->messages_[n.a]);
    }
    postponed_.clear();
    out.begin = here();
    writeBlock(kRoot);
    for (Id id : frame.results) ensure(id, kRoot);
    if (index == 0) {
      for (Id id : frame.results) program_->outputs_.push_back(placed_[id].reg);
      emit(Op::halt);
    } else {
      emit(Op::returnCall, 0, placed_[frame.results[0]].reg);
    }
    for (Id id = 0; id < graph_->size(); ++id) {
      if (placed_[id].isCell)
        postponed_.push_back({placed_[id].block, id, out.firstCell + placed_[id].cell, true});
    }
    for (Id id : frame.globals) globals_[id] = {placed_[id].cell, placed_[id].reg};
    for (size_t i = 0; i < postponed_.size(); ++i) {
      const Postponed p = postponed_[i];
      (p.isCell ? program_->cellStarts_ : program_->lists_)[p.patch] = here();
      writeBlock(p.block);
      if (!p.isCell) ensure(p.result, p.block);
      emit(Op::returnCell, 0, placed_[p.result].reg);
    }
  }

  void assignRegisters(const FrameGraph& frame, Program::Frame& out) {
    out.firstConstant = static_cast<uint32_t>(program_->constants_.size());
    out.firstCell = static_cast<uint32_t>(program_->cellStarts_.size());
    uint32_t cells = frame.parameters;
    for (Id id = 0; id < graph_->size(); ++id) {
      if (placed_[id].block == kNone || (*graph_)[id].op != Op::constant) continue;
      placed_[id].reg = out.constants++;
      program_->constants_.push_back((*graph_)[id].value);
    }
    uint32_t next = out.constants + frame.parameters;
    for (Id id = 0; id < graph_->size(); ++id) {
      const Node& n = (*graph_)[id];
      if (placed_[id].block == kNone || n.op == Op::constant) continue;
      if (n.op == Op::parameter) {
        placed_[id].reg = out.constants + n.a;
        placed_[id].cell = n.a;
        continue;
      }
      placed_[id].reg = next++;
      if (placed_[id].isCell) placed_[id].cell = cells++;
    }
    out.registers = std::max(next, 1u);
    out.cells = cells;
    program_->cellStarts_.resize(out.firstCell + cells);
  }

  void writeBlock(uint32_t block) {
    // Inner blocks are written from within; blocks_ does not grow any more.
    for (Id id : blocks_[block].nodes) writeNode(id, block);
  }

  // Sees to it that a node's register holds its value when code in `block` goes on.
  void ensure(Id id, uint32_t block) {
    const Node& n = (*graph_)[id];
    const Placement& p = placed_[id];
    if (!p.isCell && n.op != Op::parameter) return;
    if (isEnsured(id, block)) return;
    emit(Op::force, p.reg, p.cell);
    blocks_[block].ensured.push_back(id);
  }

  bool isEnsured(Id id, uint32_t block) const {
    while (true) {
      const Block& b = blocks_[block];
      if (std::find(b.ensured.begin(), b.ensured.end(), id) != b.ensured.end()) return true;
      if (!b.isInline || b.parent == kNone) return false;
      block = b.parent;
    }
  }

  // What the code reads, as far as that is known without running it.
  void summarize() {
    program_->constant_ = true;
    for (const Instruction& i : program_->code_) {
      if (i.op == Op::input && i.a < 64) program_->inputs_ |= uint64_t{1} << i.a;
      if (i.op == Op::host) program_->inputs_ |= program_->hosts_[i.a].needs;
      const bool isOpen = i.op == Op::input || i.op == Op::argument || i.op == Op::realArgument ||
                          i.op == Op::host || (i.op == Op::fail && &i != program_->code_.data());
      if (isOpen) program_->constant_ = false;
    }
  }

  uint32_t reg(Id id) const { return placed_[id].reg; }

  void writeNode(Id id, uint32_t block) {
    const Node& n = (*graph_)[id];
    const uint32_t to = reg(id);
    const auto writeBranch = [&](uint32_t inner, Id result) {
      writeBlock(inner);
      ensure(result, inner);
      emit((*graph_)[result].isFinite ? Op::move : Op::moveFinite, to, reg(result));
    };
    switch (n.op) {
      case Op::constant:
      case Op::parameter:
        break;
      case Op::input:
        emit(Op::input, to, n.a);
        break;
      case Op::argument:
        emit(Op::argument, to, n.a);
        break;
      case Op::fail:
        emit(Op::fail, to, n.a);
        break;
      case Op::global: {
        const auto& [cell, from] = globals_.at(n.a);
        emit(Op::forceGlobal, from, cell);
        emit(Op::global, to, from);
        break;
      }
      case Op::ifPositive: {
        ensure(n.a, block);
        const uint32_t test = emit(Op::jumpUnlessPositive, 0, reg(n.a));
        const uint32_t first = placed_[id].firstBlock;
        writeBranch(first, n.b);
        const uint32_t skip = emit(Op::jump);
        program_->code_[test].b = here();
        writeBranch(first + 1, n.c);
        program_->code_[skip].a = here();
        break;
      }
      case Op::select: {
        ensure(n.list[0], block);
        const auto choices = static_cast<uint32_t>(n.list.size() - 1);
        const auto list = static_cast<uint32_t>(program_->lists_.size());
        program_->lists_.resize(list + choices + 1);
        emit(Op::choose, 0, reg(n.list[0]), list, choices);
        std::vector<uint32_t> jumps;
        program_->lists_[list] = emit(Op::zeroRange, to);
        jumps.push_back(emit(Op::jump));
        for (uint32_t k = 0; k < choices; ++k) {
          program_->lists_[list + 1 + k] = here();
          writeBranch(placed_[id].firstBlock + k, n.list[k + 1]);
          jumps.push_back(emit(Op::jump));
        }
        for (uint32_t jump : jumps) program_->code_[jump].a = here();
        break;
      }
      case Op::host: {
        for (Id operand : n.list) ensure(operand, block);
        const auto list = static_cast<uint32_t>(program_->lists_.size());
        for (Id operand : n.list) program_->lists_.push_back(reg(operand));
        emit(Op::host, to, n.a, list, static_cast<uint32_t>(n.list.size()));
        break;
      }
      case Op::call:
        writeCall(id, block);
        break;
      case Op::realArgument:
        ensure(n.a, block);
        emit(n.op, to, reg(n.a), n.b);
        break;
      default: {
        const int operands = directOperands(n.op);
        ensure(n.a, block);
        if (operands > 1) ensure(n.b, block);
        if (operands > 2) ensure(n.c, block);
        emit(n.op, to, reg(n.a), operands > 1 ? reg(n.b) : 0, operands > 2 ? reg(n.c) : 0);
      }
    }
  }

  void writeCall(Id id, uint32_t block) {
    const Node& n = (*graph_)[id];
    for (Id operand : n.list) {
      if (!isThunk((*graph_)[operand])) ensure(operand, block);
    }
    const auto list = static_cast<uint32_t>(program_->lists_.size());
    program_->lists_.resize(list + 3 * n.list.size());
    uint32_t inner = placed_[id].firstBlock;
    for (size_t i = 0; i < n.list.size(); ++i) {
      const Id operand = n.list[i];
      const auto entry = list + 3 * static_cast<uint32_t>(i);
      program_->lists_[entry] = reg(operand);
      program_->lists_[entry + 1] = Program::kDone;
      program_->lists_[entry + 2] = Program::kNoCell;
      if (!isThunk((*graph_)[operand])) continue;
      const Placement& p = placed_[operand];
      const bool hasCell = p.isCell || (*graph_)[operand].op == Op::parameter;
      const bool isThere = hasCell ? isEnsured(operand, block) : p.block != inner;
      if (!isThere) postponed_.push_back({inner, operand, entry + 1, false});
      if (hasCell) program_->lists_[entry + 2] = p.cell;
      ++inner;
    }
    emit(Op::call, reg(id), n.a, list);
  }

  std::vector<std::unique_ptr<FrameGraph>>& frames_;
  std::shared_ptr<Program> program_ = std::make_shared<Program>();
  const Graph* graph_ = nullptr;
  std::vector<Block> blocks_;
  std::vector<Placement> placed_;
  std::vector<Postponed> postponed_;
  std::unordered_map<Id, std::pair<uint32_t, uint32_t>> globals_;  // of the first frame: cell and register
};

std::shared_ptr<const Program> compileExpressions(const CompileInput& input,
                                                  std::span<const Syntax> expressions) {
  Compiler compiler(input);
  compiler.expressions(expressions);
  return CodeWriter(compiler).write();
}

std::shared_ptr<const Program> compileCall(const CompileInput& input, int symbol, int count) {
  Compiler compiler(input);
  compiler.call(symbol, count);
  return CodeWriter(compiler).write();
}

const LibraryFunction* findLibraryFunction(std::string_view name) {
  const auto found = std::find_if(std::begin(kLibrary), std::end(kLibrary),
                                  [&](const LibraryFunction& f) { return f.name == name; });
  return found != std::end(kLibrary) ? found : nullptr;
}

}  // namespace rad::calc
