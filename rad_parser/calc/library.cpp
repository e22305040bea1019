#include "rad_parser/calc/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "rad_parser/calc/code_writer.h"
#include "rad_parser/calc/expand.h"
#include "rad_parser/calc/symbols.h"
#include "rad_parser/calc/syntax.h"
#include "rad_parser/printable.h"

namespace rad::calc {

std::string contextOf(std::string_view file) {
  if (file == ".") return "";
  constexpr std::string_view suffix = ".cal";
  if (file.size() > suffix.size()) {
    const std::string_view end = file.substr(file.size() - suffix.size());
    const auto same = [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b); };
    if (std::equal(end.begin(), end.end(), suffix.begin(), same)) file.remove_suffix(suffix.size());
  }
  while (!file.empty() && file.front() == kContextMark) file.remove_prefix(1);
  std::string context;
  for (char c : file) context += isNamePart(c) ? c : '_';
  while (!context.empty() && context.back() == kContextMark) context.pop_back();
  return context.empty() ? "" : kContextMark + context;
}

struct Library::Tables {
  Tables(Interface given, LoadFile load_, Warn warn)
      : interface(std::move(given)),
        load(std::move(load_)),
        symbols(interface.inputs.size(), interface.hosts, std::move(warn)) {}

  std::mutex mutex;
  const Interface interface;
  const LoadFile load;
  SymbolTable symbols;
  std::map<std::string, std::optional<Error>> loaded;  // by context, with the error that ended the loading
  std::map<std::string, std::shared_ptr<const Program>> programs;  // by keyOf()
  bool begun = false;

  // Programs that were returned keep the definitions with which they were compiled. They must not be returned
  // again if definitions have changed.
  void addAll(std::string_view text, std::string_view file, const std::string& context) {
    for (Definition& d : parseDefinitions(text, file))
      if (symbols.define(std::move(d), context)) programs.clear();
  }

  void begin() {
    if (begun) return;
    for (size_t i = 0; i < interface.inputs.size(); ++i) {
      Definition d;
      d.name = interface.inputs[i];
      d.body.kind = Syntax::Kind::channel;
      d.body.index = static_cast<int32_t>(i) + 1;
      symbols.define(std::move(d), "");
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

  // place: prefix of the message if the file cannot be read, such as "room.rad:3: "; may be empty.
  SourceText need(std::string_view file, std::string_view place) const {
    try {
      if (std::optional<SourceText> source = load(file)) return std::move(*source);
    } catch (const Error& error) {
      throw Error(fmt::format("{}{}", place, error.what()), error.status());
    }
    throw Error(fmt::format("{}cannot find function file \"{}\"{}", place, printableName(file),
                            interface.searched ? interface.searched(file, !place.empty()) : ""),
                Status::system);
  }

  // Loads the file of a request unless it is already loaded, and returns its context.
  std::string enter(const Request& request) {
    begin();
    const std::string context = contextOf(request.file);
    if (request.file == ".") return context;
    const auto known = loaded.find(context);
    if (known != loaded.end()) {
      if (known->second) throw *known->second;
      return context;
    }
    const SourceText source = need(request.file, request.place + ": ");
    try {
      addAll(source.text, source.path, context);
    } catch (const Error& error) {
      loaded.emplace(context, error);
      throw;
    }
    loaded.emplace(context, std::nullopt);
    return context;
  }

  CompileInput compileInput(const Request& request) const {
    CompileInput input = symbols.compileInput(request.place);
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

Library::Library(Interface interface, LoadFile load, Warn warn)
    : tables_(std::make_unique<Tables>(std::move(interface), std::move(load), std::move(warn))) {}

Library::~Library() = default;

void Library::define(std::string_view text, std::string_view place) {
  const std::lock_guard lock(tables_->mutex);
  tables_->begin();
  tables_->addAll(text, place, "");
}

void Library::include(std::string_view file) {
  const std::lock_guard lock(tables_->mutex);
  tables_->begin();
  const SourceText source = tables_->need(file, "");
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
    tables_->symbols.bind(trees.back(), context, request.place, false);
  }
  return tables_->programs[key] = writeProgram(expandExpressions(tables_->compileInput(request), trees));
}

std::shared_ptr<const Program> Library::compileCall(const Request& request, std::string_view function,
                                                    int count) {
  const std::lock_guard lock(tables_->mutex);
  const std::string context = tables_->enter(request);
  const Syntax name = parseExpression(function, request.place);
  if (name.kind != Syntax::Kind::name) {
    throw Error(
        fmt::format("{}: expected a function's name, got \"{}\"", request.place, printable(function)));
  }
  const int symbol = tables_->symbols.refer(name.text, context);
  return writeProgram(expandCall(tables_->compileInput(request), symbol, count));
}

int Library::functionArity(const Request& request, std::string_view name) {
  const std::lock_guard lock(tables_->mutex);
  const std::string context = tables_->enter(request);
  if (name.find_first_not_of(kContextMark) == std::string_view::npos) return 0;
  for (const std::string& qualified : candidates(name, context)) {
    const int index = tables_->symbols.find(qualified);
    if (index < 0) continue;
    const Symbol& s = tables_->symbols[index];
    if (s.definition != nullptr && s.definition->isFunction())
      return static_cast<int>(s.definition->parameters.size());
    return s.library != nullptr ? s.library->arity : s.host != nullptr ? s.host->arity : 0;
  }
  if (const LibraryFunction* f = findLibraryFunction(name)) return f->arity;
  const HostFunction* host = tables_->symbols.findHost(name);
  return host != nullptr ? host->arity : 0;
}

}  // namespace rad::calc
