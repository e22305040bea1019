#pragma once
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rad_parser/calc/expand.h"
#include "rad_parser/calc/syntax.h"
#include "rad_parser/error.h"

// The definitions of all contexts, and the symbols that names refer to. For library.cpp, whose header
// describes contexts and constants.
namespace rad::calc {

// The qualified names that a name in a context may refer to, nearest first.
std::vector<std::string> candidates(std::string_view name, std::string_view context);

// Not thread-safe.
class SymbolTable {
 public:
  // inputs: the number of the renderer's variables. hosts: its functions; must outlive the table.
  SymbolTable(size_t inputs, std::span<const HostFunction> hosts, Warn warn);

  const Symbol& operator[](int index) const { return symbols_[static_cast<size_t>(index)]; }

  // The symbol of a qualified name, or -1.
  int find(const std::string& qualified) const;

  // The symbol that a name in a context refers to. It is made if there is none, so that later references to
  // the name find the same symbol.
  int refer(const std::string& name, const std::string& context);

  // The renderer's function of this name, or null.
  const HostFunction* findHost(std::string_view name) const;

  // Sets the symbols of the names in a tree, and replaces constant parts by numbers. file: for messages.
  // hasLines: whether messages add the line of the part; otherwise `file` is the whole place. Throws Error if
  // a constant has no value, or if its value depends on the ray or on the primitive.
  void bind(Syntax& tree, const std::string& context, const std::string& file, bool hasLines);

  // Binds a definition and adds it to a context. Warns if it changes a constant. Returns whether programs of
  // other requests that were compiled before may now mean something else. Throws Error.
  bool define(Definition definition, const std::string& context);

  // What compiling needs of the table. The symbols are valid until the table changes.
  CompileInput compileInput(std::string place) const;

 private:
  int insert(const std::string& qualified);
  bool isConstantFunction(const Syntax& name) const;
  std::optional<double> constantValue(const Syntax& tree, const std::string& place) const;
  bool needsRay(const Syntax& tree, const std::string& place) const;
  void fold(Syntax& tree, const std::string& place) const;
  void foldChain(Syntax& tree, const std::string& place) const;
  void foldCall(Syntax& tree, const std::string& place) const;

  size_t inputs_;
  std::span<const HostFunction> hosts_;
  Warn warn_;
  std::vector<Symbol> symbols_;
  std::unordered_map<std::string, int> byName_;  // by qualified name
  std::deque<Definition> definitions_;           // never moved: symbols point at them
};

}  // namespace rad::calc
