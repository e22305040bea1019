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

// The definitions of all contexts, and the symbols to which names refer. For library.cpp; library.h describes
// contexts and constants.
namespace rad::calc {

// The qualified names to which a name in a context may refer, nearest first.
std::vector<std::string> candidates(std::string_view name, std::string_view context);

// Not thread-safe.
class SymbolTable {
 public:
  // inputs: number of the renderer's variables. hosts: the renderer's functions; they must outlive the table.
  SymbolTable(size_t inputs, std::span<const HostFunction> hosts, Warn warn);

  const Symbol& operator[](int index) const { return symbols_[static_cast<size_t>(index)]; }

  // The symbol of a qualified name, or -1.
  int find(const std::string& qualified) const;

  // The symbol to which a name in a context refers. If it does not exist it is created, and later references
  // to the name find it.
  int refer(const std::string& name, const std::string& context);

  // The renderer's function of this name, or null.
  const HostFunction* findHost(std::string_view name) const;

  // Sets the symbols of the names in a tree, and replaces constant parts by numbers. file: for messages.
  // hasLines: whether messages add the line of the part; otherwise `file` is the complete place. Throws Error
  // if a constant has no value, or if its value depends on the ray or the primitive.
  void bind(Syntax& tree, const std::string& context, const std::string& file, bool hasLines);

  // Binds a definition and adds it to a context. Warns if it changes a constant. Returns whether programs
  // compiled for earlier requests may now have a different meaning. Throws Error.
  bool define(Definition definition, const std::string& context);

  // The data for compiling. The symbols are valid until the table changes.
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
  std::deque<Definition> definitions_;           // never moved, because symbols point to them
};

}  // namespace rad::calc
