#include "rad_parser/calc/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <unordered_map>

#include "rad_parser/calc/code_writer.h"
#include "rad_parser/calc/expand.h"
#include "rad_parser/calc/syntax.h"

namespace rad::calc {
namespace {

using Kind = Syntax::Kind;
constexpr char kMark = '`';

bool isNamePart(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == kMark;
}

// The qualified names that a name in a context may mean, nearest first.
std::vector<std::string> candidates(std::string_view name, std::string_view context) {
  const bool local = name.front() == kMark;
  if (local) name.remove_prefix(1);
  if (!name.empty() && name.back() == kMark) return {std::string(name.substr(0, name.size() - 1))};
  std::vector<std::string> all;
  while (true) {
    all.push_back(std::string(name) + std::string(context));
    if (local || context.empty()) return all;
    const size_t next = context.find(kMark, 1);
    context.remove_prefix(next == std::string_view::npos ? context.size() : next);
  }
}

std::shared_ptr<const Program> compileTrees(const CompileInput& input, std::span<const Syntax> trees) {
  return writeProgram(expandExpressions(input, trees));
}

}  // namespace

std::string contextOf(std::string_view file) {
  if (file == ".") return "";
  constexpr std::string_view suffix = ".cal";
  if (file.size() > suffix.size()) {
    const std::string_view end = file.substr(file.size() - suffix.size());
    const auto same = [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b); };
    if (std::equal(end.begin(), end.end(), suffix.begin(), same)) file.remove_suffix(suffix.size());
  }
  while (!file.empty() && file.front() == kMark) file.remove_prefix(1);
  std::string context;
  for (char c : file) context += isNamePart(c) ? c : '_';
  while (!context.empty() && context.back() == kMark) context.pop_back();
  return context.empty() ? "" : kMark + context;
}

struct Library::Tables {
  std::mutex mutex;
  Interface interface;
  LoadFile load;
  Warn warn;

  std::vector<Symbol> symbols;
  std::unordered_map<std::string, int> byName;
  std::deque<Definition> definitions;  // never moved: symbols and programs in the making point at them
  std::map<std::string, std::optional<Error>> loaded;  // contexts, with the error that ended the loading
  std::map<std::string, std::shared_ptr<const Program>> programs;
  bool begun = false;

  int find(const std::string& qualified) const {
    const auto found = byName.find(qualified);
    return found == byName.end() ? -1 : found->second;
  }

  int insert(const std::string& qualified) {
    const auto [it, isNew] = byName.try_emplace(qualified, static_cast<int>(symbols.size()));
    if (isNew) {
      Symbol s;
      s.name = qualified;
      s.library = findLibraryFunction(qualified);
      for (const HostFunction& host : interface.hosts) {
        if (host.name == qualified) s.host = &host;
      }
      symbols.push_back(std::move(s));
    }
    return it->second;
  }

  bool isProvided(const std::string& name) const {
    return findLibraryFunction(name) != nullptr || std::any_of(interface.hosts.begin(), interface.hosts.end(),
                                                               [&](const auto& h) { return h.name == name; });
  }

  // The symbol that a name refers to; made where there is none, so that later references mean the same one.
  int refer(const std::string& name, const std::string& context) {
    const std::vector<std::string> all = candidates(name, context);
    for (const std::string& qualified : all) {
      const int known = find(qualified);
      if (known >= 0) return known;
    }
    return insert(isProvided(name) ? name : all.front());
  }

  CompileInput compileInput(std::string place) const {
    CompileInput input;
    input.symbols = symbols;
    input.inputs = interface.inputs.size();
    input.place = std::move(place);
    return input;
  }

  bool isConstantFunction(const Syntax& name) const {
    if (name.kind != Kind::name) return false;
    const Symbol& s = symbols[static_cast<size_t>(name.index)];
    if (s.definition != nullptr) return s.definition->isFunction() && s.definition->constant;
    return s.library != nullptr && s.library->op != Op::realArgument;
  }

  // Binds the names of a tree, and replaces what is constant by numbers.
  void bind(Syntax& tree, const std::string& context, const std::string& file, uint32_t line) {
    if (tree.kind == Kind::name) {
      tree.index = refer(tree.text, context);
      const Symbol& s = symbols[static_cast<size_t>(tree.index)];
      const Definition* d = s.definition;
      if (d == nullptr || !d->constant || d->isFunction()) return;
      const std::optional<double> value =
          d->body.kind == Kind::number ? d->body.number : constantValue(tree, placeOf(tree, file, line));
      if (value) setNumber(tree, *value);
      return;
    }
    for (Syntax& inner : tree.args) bind(inner, context, file, line);
    fold(tree, placeOf(tree, file, line));
  }

  static std::string placeOf(const Syntax& tree, const std::string& file, uint32_t line) {
    return line != 0 ? fmt::format("{}:{}", file, tree.line) : file;
  }

  // The value of what is constant by its definition; nullopt where it can't be told yet, since it uses what
  // is undefined so far or what is defined with '=': then it stays as it is. Throws Error where its value is
  // another for each ray: of a constant that makes no sense, and rtrace refuses it.
  std::optional<double> constantValue(const Syntax& tree, const std::string& place) {
    std::shared_ptr<const Program> program;
    try {
      program = compileTrees(compileInput(place), {&tree, 1});
    } catch (const Error&) {
      return std::nullopt;  // reported if it is ever needed
    }
    State state;
    if (program->isConstant()) return program->evaluate({}, state);
    if (needsRay(tree, place)) {
      throw Error(
          fmt::format("{}: constant expression uses what depends on the ray or the primitive", place));
    }
    return std::nullopt;
  }

  // Whether a tree that compiles has no value without a ray, a primitive's arguments and the renderer's
  // functions.
  bool needsRay(const Syntax& tree, const std::string& place) {
    CompileInput input = compileInput(place);
    input.hasHosts = false;
    input.inputs = 0;
    input.available = 0;
    input.reals = std::span<const double>();
    try {
      State state;
      compileTrees(input, {&tree, 1})->evaluate({}, state);
    } catch (const Error&) {
      return true;
    }
    return false;
  }

  static void setNumber(Syntax& tree, double number) {
    Syntax result;
    result.kind = Kind::number;
    result.line = tree.line;
    result.number = number;
    tree = std::move(result);
  }

  void fold(Syntax& tree, const std::string& place) {
    const auto isNumber = [](const Syntax& s) { return s.kind == Kind::number; };
    const auto refuse = [&](uint32_t faults) {
      if (faults == 0) return;
      throw Error(fmt::format("{}: constant expression has no value: {}", place,
                              faults & kDivisionByZero ? "division by zero"
                              : faults & kIllegalPower ? "illegal power"
                              : faults & kDomainError  ? "domain error"
                                                       : "range error"));
    };
    uint32_t faults = 0;
    switch (tree.kind) {
      case Kind::negate:
        if (isNumber(tree.args[0])) setNumber(tree, -tree.args[0].number);
        break;
      case Kind::power:
        if (std::all_of(tree.args.begin(), tree.args.end(), isNumber)) {
          const double value = apply(Op::power, tree.args[0].number, tree.args[1].number, 0, faults);
          refuse(faults);
          setNumber(tree, value);
        }
        break;
      case Kind::sum:
      case Kind::product: {
        for (size_t i = 0; i < tree.text.size(); ++i) {
          if (tree.text[i] == '/' && isNumber(tree.args[i + 1]) && tree.args[i + 1].number == 0) {
            refuse(kDivisionByZero);
          }
        }
        if (!std::all_of(tree.args.begin(), tree.args.end(), isNumber)) break;
        double value = tree.args[0].number;
        for (size_t i = 0; i < tree.text.size(); ++i) {
          const char c = tree.text[i];
          const Op op = c == '+' ? Op::add : c == '-' ? Op::subtract : c == '*' ? Op::multiply : Op::divide;
          value = apply(op, value, tree.args[i + 1].number, 0, faults);
        }
        refuse(faults);
        setNumber(tree, value);
        break;
      }
      case Kind::call: {
        if (!isConstantFunction(tree.args[0])) break;
        const bool closed = std::all_of(tree.args.begin() + 1, tree.args.end(), [&](const Syntax& s) {
          return isNumber(s) || isConstantFunction(s);
        });
        if (!closed) break;
        const std::optional<double> value = constantValue(tree, place);
        if (!value) break;
        const Symbol& callee = symbols[static_cast<size_t>(tree.args[0].index)];
        // A library function of numbers: the compiler has done it, silently.
        if (callee.definition == nullptr) refuse(faultsOf(*callee.library, tree));
        setNumber(tree, *value);
        break;
      }
      default:
        break;
    }
  }

  static uint32_t faultsOf(const LibraryFunction& f, const Syntax& call) {
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

  void add(Definition definition, const std::string& context) {
    bind(definition.body, context, definition.file, definition.line);
    const std::string qualified = candidates(definition.name, context).front();
    if (qualified.empty()) {
      throw Error(fmt::format("{}:{}: expected a name to define", definition.file, definition.line));
    }
    const int index = insert(qualified);
    const Definition* before = symbols[static_cast<size_t>(index)].definition;
    if (before != nullptr && before->constant && warn && !same(before->body, definition.body)) {
      warn(fmt::format("{}:{}: constant \"{}\" redefined", definition.file, definition.line, qualified));
    }
    // Programs that were made before keep what they have; later requests must not.
    if (before != nullptr || context.empty() || !qualified.ends_with(context)) programs.clear();
    definitions.push_back(std::move(definition));
    symbols[static_cast<size_t>(index)].definition = &definitions.back();
  }

  void addAll(std::string_view text, std::string_view file, const std::string& context) {
    std::vector<Definition> all = parseDefinitions(text, file);
    for (Definition& d : all) add(std::move(d), context);
  }

  void begin() {
    if (begun) return;
    for (size_t i = 0; i < interface.inputs.size(); ++i) {
      Definition d;
      d.name = interface.inputs[i];
      d.body.kind = Kind::channel;
      d.body.index = static_cast<int32_t>(i) + 1;
      add(std::move(d), "");
    }
    std::optional<SourceText> prelude;
    if (!interface.preludeName.empty()) prelude = load(interface.preludeName);
    if (prelude) {
      addAll(prelude->text, prelude->path, "");
    } else {
      addAll(interface.preludeText, interface.preludeName, "");
    }
    begun = true;
  }

  std::string searched(std::string_view file) const {
    return interface.searched != nullptr ? interface.searched(file) : std::string();
  }

  SourceText need(std::string_view file) {
    std::optional<SourceText> source = load(file);
    if (!source)
      throw Error(fmt::format("cannot find function file \"{}\"{}", file, searched(file)), Status::system);
    return std::move(*source);
  }

  // The context of a request's file, which has then been loaded.
  std::string enter(const Request& request) {
    begin();
    const std::string context = contextOf(request.file);
    if (request.file == ".") return context;
    const auto known = loaded.find(context);
    if (known != loaded.end()) {
      if (known->second) throw *known->second;
      return context;
    }
    std::optional<SourceText> source = load(request.file);
    if (!source) {
      throw Error(fmt::format("{}: cannot find function file \"{}\"{}", request.place, request.file,
                              searched(request.file)),
                  Status::system);
    }
    try {
      addAll(source->text, source->path, context);
    } catch (const Error& error) {
      loaded.emplace(context, error);
      throw;
    }
    loaded.emplace(context, std::nullopt);
    return context;
  }

  CompileInput compileInput(const Request& request) const {
    CompileInput input = compileInput(request.place);
    input.available = request.available;
    input.reals = request.reals;
    return input;
  }

  static std::string keyOf(const Request& request, const std::string& context) {
    std::string key = fmt::format("{}\n{}\n", context, request.available);
    for (const std::string& e : request.expressions) key += e + "\n";
    if (request.reals) {
      key += "reals";
      key.append(reinterpret_cast<const char*>(request.reals->data()), request.reals->size_bytes());
    }
    return key;
  }
};

Library::Library(Interface interface, LoadFile load, Warn warn) : tables_(std::make_unique<Tables>()) {
  tables_->interface = std::move(interface);
  tables_->load = std::move(load);
  tables_->warn = std::move(warn);
}

Library::~Library() = default;

void Library::define(std::string_view text, std::string_view place) {
  const std::lock_guard lock(tables_->mutex);
  tables_->begin();
  tables_->addAll(text, place, "");
}

void Library::include(std::string_view file) {
  const std::lock_guard lock(tables_->mutex);
  tables_->begin();
  const SourceText source = tables_->need(file);
  tables_->addAll(source.text, source.path, "");
}

std::shared_ptr<const Program> Library::compile(const Request& request) {
  const std::lock_guard lock(tables_->mutex);
  const std::string context = tables_->enter(request);
  const std::string key = Tables::keyOf(request, context);
  const auto known = tables_->programs.find(key);
  if (known != tables_->programs.end()) return known->second;
  std::vector<Syntax> trees;
  for (const std::string& text : request.expressions) {
    trees.push_back(parseExpression(text, request.place));
    tables_->bind(trees.back(), context, request.place, 0);
  }
  return tables_->programs[key] = compileTrees(tables_->compileInput(request), trees);
}

std::shared_ptr<const Program> Library::compileCall(const Request& request, std::string_view function,
                                                    int count) {
  const std::lock_guard lock(tables_->mutex);
  const std::string context = tables_->enter(request);
  const Syntax name = parseExpression(function, request.place);
  if (name.kind != Kind::name) {
    throw Error(fmt::format("{}: expected a function's name, got \"{}\"", request.place, function));
  }
  const int symbol = tables_->refer(name.text, context);
  return writeProgram(expandCall(tables_->compileInput(request), symbol, count));
}

int Library::functionArity(std::string_view file, std::string_view name) {
  const std::lock_guard lock(tables_->mutex);
  Request request;
  request.file = file;
  const std::string context = tables_->enter(request);
  if (name.find_first_not_of(kMark) == std::string_view::npos) return 0;
  for (const std::string& qualified : candidates(name, context)) {
    const int index = tables_->find(qualified);
    if (index < 0) continue;
    const Symbol& s = tables_->symbols[static_cast<size_t>(index)];
    if (s.definition != nullptr && s.definition->isFunction())
      return static_cast<int>(s.definition->parameters.size());
    return s.library != nullptr ? s.library->arity : s.host != nullptr ? s.host->arity : 0;
  }
  const LibraryFunction* f = findLibraryFunction(name);
  if (f != nullptr) return f->arity;
  for (const HostFunction& host : tables_->interface.hosts) {
    if (host.name == name) return host.arity;
  }
  return 0;
}

}  // namespace rad::calc
