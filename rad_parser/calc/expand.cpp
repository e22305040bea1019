#include "rad_parser/calc/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "rad_parser/calc/noise.h"
#include "rad_parser/error.h"
#include "rad_parser/printable.h"

namespace rad::calc {
namespace {

using Kind = Syntax::Kind;

// Limit on the compiler's recursion through trees, arguments and definitions, because the stack is finite.
constexpr int kMaxCompileDepth = 2500;
// Limit on the expansions of a function within itself.
constexpr int kMaxUnrolled = 64;
// Limit on the expansions in one program. Beyond this limit, functions are called instead.
constexpr size_t kMaxExpansions = 20000;

struct Scope;

// An argument of a call: a tree that is compiled at its first use in the body; a compiled node; or, in a
// frame for given functions as arguments, the symbol of such a function.
struct Argument {
  const Syntax* tree = nullptr;
  const Scope* scope = nullptr;  // of the tree
  Id node = kNone;
  int symbol = -1;
};

// The environment in which a tree is compiled: the definition whose body it belongs to, and the arguments of
// that definition's parameters.
struct Scope {
  const Definition* definition = nullptr;  // null: the primitive's own expressions
  const Scope* caller = nullptr;           // scope of the call that the definition's body replaces
  mutable std::vector<Argument> arguments;
  FrameGraph* frame = nullptr;
};

class Expander {
 public:
  explicit Expander(const CompileInput& input) : input_(input) { newFrame("expression", 0); }

  void expressions(std::span<const Syntax> trees) {
    const Scope* scope = newScope(nullptr, nullptr, first());
    for (const Syntax& tree : trees) first().results.push_back(compile(tree, *scope));
  }

  void call(int symbol, int count) {
    Scope* scope = newScope(nullptr, nullptr, first());
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
      scope->arguments.back().node = first().graph.leaf(Op::argument, static_cast<uint32_t>(i));
    }
    first().results.push_back(compile(tree, *scope));
  }

  Expansion take() { return std::move(out_); }

 private:
  FrameGraph& first() { return out_.frames.front(); }

  FrameGraph* newFrame(std::string name, uint32_t parameters) {
    FrameGraph& frame = out_.frames.emplace_back();
    frame.name = std::move(name);
    frame.parameters = parameters;
    return &frame;
  }

  Scope* newScope(const Definition* definition, const Scope* caller, FrameGraph& frame) {
    Scope& scope = scopes_.emplace_back();
    scope.definition = definition;
    scope.caller = caller;
    scope.frame = &frame;
    return &scope;
  }

  std::string place(const Syntax& tree, const Scope& scope) const {
    return scope.definition != nullptr ? fmt::format("{}:{}", scope.definition->file, tree.line)
                                       : input_.place;
  }

  // The place of the primitive with a missing item, and of the definition that requires it.
  std::string placeInPrimitive(const Syntax& tree, const Scope& scope) const {
    return scope.definition != nullptr ? fmt::format("{}: {}", input_.place, place(tree, scope))
                                       : input_.place;
  }

  uint32_t message(std::string text) {
    out_.messages.push_back(std::move(text));
    return static_cast<uint32_t>(out_.messages.size() - 1);
  }

  // An operation that throws the error when it is evaluated. As in RADIANCE, an expression that is never
  // evaluated may contain errors.
  Id fail(const Syntax& tree, const Scope& scope, std::string_view problem) {
    return scope.frame->graph.leaf(Op::fail, message(fmt::format("{}: {}", place(tree, scope), problem)));
  }

  const Symbol& symbol(int index) const { return input_.symbols[static_cast<size_t>(index)]; }

  static bool callable(const Symbol& s) {
    return s.definition != nullptr ? s.definition->isFunction() : s.library != nullptr || s.host != nullptr;
  }

  Id compile(const Syntax& tree, const Scope& scope) {
    if (++depth_ > kMaxCompileDepth)
      throw Error(fmt::format("{}: definitions nested too deeply", place(tree, scope)));
    const Id id = compileInner(tree, scope);
    --depth_;
    return id;
  }

  Id compileInner(const Syntax& tree, const Scope& scope) {
    Graph& graph = scope.frame->graph;
    switch (tree.kind) {
      case Kind::number: return graph.constant(tree.number);
      case Kind::channel: return channel(tree, scope);
      case Kind::name: return variable(tree, scope);
      case Kind::parameter: return argument(tree, scope, static_cast<size_t>(tree.index));
      case Kind::negate: return graph.operate(Op::negate, compile(tree.args[0], scope));
      case Kind::sum:
      case Kind::product: {
        Id left = compile(tree.args[0], scope);
        for (size_t i = 1; i < tree.args.size(); ++i)
          left = graph.operate(operatorOf(tree.text[i - 1]), left, compile(tree.args[i], scope));
        return left;
      }
      case Kind::power: {
        const Id base = compile(tree.args[0], scope);
        const Id exponent = compile(tree.args[1], scope);
        // RADIANCE's rule if the base is written as the number 0 and the exponent is variable: the result is
        // 0 even if the exponent is 0.
        if (tree.args[0].kind == Kind::number && tree.args[0].number == 0 && !graph.isConstant(exponent))
          return base;
        return graph.operate(Op::power, base, exponent);
      }
      case Kind::call: return call(tree, scope);
    }
    return kNone;
  }

  Id channel(const Syntax& tree, const Scope& scope) {
    if (tree.index < 1 || static_cast<size_t>(tree.index) > input_.inputs)
      return fail(tree, scope, fmt::format("there is no channel ${}", tree.index));
    return scope.frame->graph.leaf(Op::input, static_cast<uint32_t>(tree.index - 1));
  }

  bool isUnavailable(const Definition& d) const {
    return !d.isFunction() && d.body.kind == Kind::channel && d.body.index >= 1 && d.body.index <= 64 &&
           (input_.available >> (d.body.index - 1) & 1) == 0;
  }

  Id variable(const Syntax& tree, const Scope& scope) {
    const Symbol& s = symbol(tree.index);
    if (s.definition == nullptr || s.definition->isFunction() || isUnavailable(*s.definition))
      return fail(tree, scope, fmt::format("undefined variable \"{}\"", printable(s.name)));
    auto [it, isNew] = variables_.try_emplace(s.definition, kNone);
    if (isNew) {
      const Scope* inner = newScope(s.definition, nullptr, first());
      const Id id = compile(s.definition->body, *inner);
      variables_[s.definition] = id;
    } else if (it->second == kNone) {
      return fail(tree, scope,
                  fmt::format("variable \"{}\" is defined in terms of itself", printable(s.name)));
    }
    const Id id = variables_[s.definition];
    if (scope.frame == &first()) return id;
    // Other frames may run many times for one point. Because variables do not depend on a frame's arguments,
    // they are evaluated once, in the first frame.
    const Node& n = first().graph[id];
    if (n.op == Op::constant) return scope.frame->graph.constant(n.value);
    if (n.op == Op::input) return scope.frame->graph.leaf(Op::input, n.a);
    first().globals.push_back(id);
    return scope.frame->graph.leaf(Op::global, id);
  }

  Id argument(const Syntax& tree, const Scope& scope, size_t index) {
    if (index >= scope.arguments.size()) {
      const std::string name = scope.definition != nullptr ? scope.definition->name : "expression";
      return fail(tree, scope, fmt::format("{}(): too few arguments", name));
    }
    // A copy, because compiling the tree may reach and change this argument.
    const Argument given = scope.arguments[index];
    if (given.node != kNone) return given.node;
    if (given.tree == nullptr) {
      const std::string name = printable(symbol(given.symbol).name);
      return fail(tree, scope, fmt::format("undefined variable \"{}\"", name));
    }
    const Id id = compile(*given.tree, *given.scope);
    scope.arguments[index].node = id;
    return id;
  }

  // The symbol of the function named by a callee or an argument. If it names no function, returns -1 and the
  // problem.
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
    return fail(tree, scope, fmt::format("undefined function \"{}()\"", printable(s.name)));
  }

  Id userCall(const Syntax& tree, const Scope& scope, const Definition& d) {
    Scope* inner = newScope(&d, &scope, *scope.frame);
    for (size_t i = 1; i < tree.args.size() && i <= d.parameters.size(); ++i)
      inner->arguments.push_back({&tree.args[i], &scope, kNone, -1});
    if (++expansions_ > kMaxExpansions || !mayExpand(d, *inner)) return frameCall(tree, *inner, d);
    return compile(d.body, *inner);
  }

  // Whether a call is replaced by the body of d. It is, if d is not already being expanded, or if an argument
  // is a constant that differs from the argument's values in all enclosing expansions of d.
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
        // If the argument of the enclosing call is not constant, or not yet compiled, the recursion may be
        // endless.
        isNew[i] =
            before != kNone && inner.frame->graph.isConstant(before) && before != inner.arguments[i].node;
      }
    }
    return active == 0 || std::ranges::find(isNew, true) != isNew.end();
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

  // A call of the frame for d and for those of its arguments that are functions.
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
    auto [it, isNew] = instances_.try_emplace(key, static_cast<uint32_t>(out_.frames.size()));
    const uint32_t index = it->second;
    if (isNew) {
      const auto count = static_cast<uint32_t>(d.parameters.size());
      FrameGraph* frame = newFrame(fmt::format("{}:{}: {}()", d.file, d.line, d.name), count);
      Scope* body = newScope(&d, nullptr, *frame);
      for (size_t i = 0; i < inner.arguments.size(); ++i) {
        Argument a{.symbol = functions[i]};
        if (a.symbol < 0) a.node = frame->graph.leaf(Op::parameter, static_cast<uint32_t>(i));
        body->arguments.push_back(a);
      }
      const Id result = compile(d.body, *body);
      frame->results.push_back(result);
    }
    Node n{.op = Op::call, .a = index};
    for (size_t i = 0; i < d.parameters.size(); ++i) {
      const bool isValue = i < inner.arguments.size() && functions[i] < 0;
      // The frame does not read parameters whose arguments are missing or are functions.
      n.list.push_back(isValue ? argument(tree, inner, i) : inner.frame->graph.constant(0));
    }
    return inner.frame->graph.add(std::move(n));
  }

  Id libraryCall(const Syntax& tree, const Scope& scope, const LibraryFunction& f) {
    Graph& graph = scope.frame->graph;
    // Argument number n, from 1.
    const auto value = [&](size_t n) {
      return n < tree.args.size() ? compile(tree.args[n], scope)
                                  : fail(tree, scope, fmt::format("{}(): too few arguments", f.name));
    };
    switch (f.op) {
      case Op::ifPositive: return ifCall(graph, value);
      case Op::select: return selectCall(graph, value, tree.args.size() - 1);
      case Op::min:
      case Op::max: {
        // The comparisons are in RADIANCE's order, which matters if a value is NaN.
        Id extreme = value(1);
        for (size_t k = tree.args.size() - 1; k > 1; --k) extreme = graph.operate(f.op, extreme, value(k));
        return graph.operate(Op::finite, extreme);
      }
      case Op::realArgument: return realArgument(tree, scope, value(1));
      case Op::noise3: return noiseCall(graph, value, f.name);
      default: {
        const Id a = value(1);
        const Id b = f.arity > 1 ? value(2) : kNone;
        const Id c = f.arity > 2 ? value(3) : kNone;
        return graph.operate(f.op, a, b, c);
      }
    }
  }

  static Id ifCall(Graph& graph, const auto& value) {
    const Id condition = value(1);
    if (graph.isConstant(condition))
      return graph.operate(Op::finite, value(graph[condition].value > 0 ? 2 : 3));
    Node n{.op = Op::ifPositive, .a = condition};
    n.b = value(2);
    n.c = value(3);
    if (n.b == n.c) return graph.operate(Op::finite, n.b);
    return graph.add(std::move(n));
  }

  static Id selectCall(Graph& graph, const auto& value, size_t given) {
    const Id index = value(1);
    if (graph.isConstant(index)) {
      const double x = graph[index].value;
      if (!(x >= -.5) || x + .5 >= static_cast<double>(given)) return graph.constant(0);
      const auto n = static_cast<size_t>(x + .5);
      return n == 0 ? graph.constant(static_cast<double>(given - 1))
                    : graph.operate(Op::finite, value(n + 1));
    }
    Node n{.op = Op::select, .list = {index, graph.constant(static_cast<double>(given - 1))}};
    for (size_t k = 2; k <= given; ++k) n.list.push_back(value(k));
    return graph.add(std::move(n));
  }

  // noise3, and its backward differences noise3x, noise3y and noise3z.
  static Id noiseCall(Graph& graph, const auto& value, std::string_view name) {
    const Id p[3] = {value(1), value(2), value(3)};
    const Id here = graph.operate(Op::noise3, p[0], p[1], p[2]);
    if (name == "noise3") return here;
    const size_t axis = static_cast<size_t>(name.back() - 'x');
    Id q[3] = {p[0], p[1], p[2]};
    q[axis] = graph.operate(Op::subtract, q[axis], graph.constant(kNoiseStep));
    const Id before = graph.operate(Op::noise3, q[0], q[1], q[2]);
    return graph.operate(Op::divide, graph.operate(Op::subtract, here, before), graph.constant(kNoiseStep));
  }

  Id realArgument(const Syntax& tree, const Scope& scope, Id index) {
    Graph& graph = scope.frame->graph;
    if (input_.reals && graph.isConstant(index)) {
      const size_t count = input_.reals->size();
      const double x = graph[index].value + .5;
      if (!(x >= 1)) return graph.constant(static_cast<double>(count));
      if (x >= static_cast<double>(count) + 1) {
        return scope.frame->graph.leaf(
            Op::fail, message(fmt::format("{}: missing real argument {:.0f}", placeInPrimitive(tree, scope),
                                          std::floor(x))));
      }
      return graph.constant((*input_.reals)[static_cast<size_t>(x) - 1]);
    }
    return graph.add(
        {.op = Op::realArgument, .a = index, .b = realArgumentMessage(placeInPrimitive(tree, scope))});
  }

  // Each place has one message, so that equal operations become one node.
  uint32_t realArgumentMessage(const std::string& place) {
    auto [it, isNew] = realArgumentMessages_.try_emplace(place, 0);
    if (isNew) it->second = message(place);
    return it->second;
  }

  Id hostCall(const Syntax& tree, const Scope& scope, const HostFunction& f) {
    if (static_cast<int>(tree.args.size()) - 1 < f.arity)
      return fail(tree, scope, fmt::format("{}(): too few arguments", f.name));
    Node n{.op = Op::host};
    std::vector<HostFunction>& hosts = out_.hosts;
    const auto known = std::ranges::find_if(hosts, [&](const auto& h) { return h.name == f.name; });
    n.a = static_cast<uint32_t>(known - hosts.begin());
    if (known == hosts.end()) hosts.push_back(f);
    for (size_t i = 1; i < tree.args.size(); ++i) n.list.push_back(compile(tree.args[i], scope));
    return scope.frame->graph.add(std::move(n));
  }

  const CompileInput& input_;
  Expansion out_;
  std::deque<Scope> scopes_;                              // never moved, because arguments point to them
  std::unordered_map<const Definition*, Id> variables_;   // kNone while a variable is being compiled
  std::map<std::string, uint32_t> instances_;             // frames, by definition and functions passed to it
  std::map<std::string, uint32_t> realArgumentMessages_;  // by place
  size_t expansions_ = 0;
  int depth_ = 0;
};

}  // namespace

Expansion expandExpressions(const CompileInput& input, std::span<const Syntax> expressions) {
  Expander expander(input);
  expander.expressions(expressions);
  return expander.take();
}

Expansion expandCall(const CompileInput& input, int symbol, int count) {
  Expander expander(input);
  expander.call(symbol, count);
  return expander.take();
}

}  // namespace rad::calc
