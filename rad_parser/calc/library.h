#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/calc/program.h"
#include "rad_parser/error.h"

// The definitions of function files, and the programs made from them.
//
// Contexts. The definitions of a file belong to a context named after the file: its name without ".cal", with
// '_' in place of characters that are not allowed in names. The context "" contains the definitions shared by
// all files. A name in a file refers to
//   name        the definition in the same file, if the file has defined or used the name before; otherwise
//               the shared definition, if it already exists; otherwise a library function; otherwise the
//               definition in the same file, which may follow later
//   `name       only the definition in the same file
//   name`       only the shared definition
//   name`ctx`   only the definition of context ctx
// Source: RADIANCE file formats, "Function File Format", "Language Features".
//
// Constants. If the value of a variable defined with ':' is already known, the value replaces later uses of
// the variable. Calls of a function defined with ':' are replaced, too, if the arguments are constants. It is
// an error if the value depends on the ray, because it uses inputs, arg() or the renderer's functions.
namespace rad::calc {

struct SourceText {
  std::string path;  // as shown in messages
  std::string text;
};

// Names and functions that the renderer adds to the language.
struct Interface {
  std::vector<std::string> inputs;  // names of its variables, at most 64; the first is also called $1
  std::vector<HostFunction> hosts;  // its functions
  std::string_view preludeName;     // the file that is read first, into the shared context; empty: none
  std::string_view preludeText;     // used if that file does not exist
  // The end of a message about a function file that was not found (" in .:/usr/local/lib/ray"); may be empty.
  // inScene: whether a primitive names the file, not an option.
  std::function<std::string(std::string_view file, bool inScene)> searched{};
};

// Finds and reads a function file. Empty if it does not exist. Throws Error, without the place of the
// request, if it cannot be read. The library is locked during the call, so the function must not call the
// library.
using LoadFile = std::function<std::optional<SourceText>(std::string_view name)>;

struct Request {
  std::string place;            // of the primitive, for messages
  std::string_view file = ".";  // its function file; ".": none, so that names refer to the shared context
  std::span<const std::string> expressions;  // evaluated together, in this order
  uint64_t available = ~uint64_t{0};         // bit i: inputs[i] is defined for this primitive
  // Values of arg(n), if the program may be compiled for these values only, so that much of it is evaluated
  // in advance. If they are not given, the program reads Point::reals.
  std::optional<std::span<const double>> reals;
};

// Thread-safe. Programs may be used after the library is destroyed.
class Library {
 public:
  Library(Interface interface, LoadFile load, Warn warn = {});
  ~Library();

  // Adds definitions to the shared context, after the prelude: the text of an option -e, or the file of -f.
  // Throws Error.
  void define(std::string_view text, std::string_view place);
  void include(std::string_view file);

  // The program for a primitive's expressions. Its file is read at the first request only; if the file has an
  // error, all requests for it throw that error. Throws Error
  // - with Status::system if a file is not found,
  // - for anything that the language does not allow,
  // - for an undefined name that every evaluation would need.
  std::shared_ptr<const Program> compile(const Request& request);

  // The program for function(Point::arguments[0], .. [count-1]). Ignores request.expressions. Throws like
  // compile().
  std::shared_ptr<const Program> compileCall(const Request& request, std::string_view function, int count);

  // The number of arguments of the function to which this name refers in the primitive of the request; 0 if
  // there is no such function. Uses only place and file of the request. Throws Error if the file is not found
  // or invalid.
  int functionArity(const Request& request, std::string_view name);

 private:
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

// The context of a function file: "lib/wood.cal" -> "`lib_wood"; "." -> "".
std::string contextOf(std::string_view file);

}  // namespace rad::calc
