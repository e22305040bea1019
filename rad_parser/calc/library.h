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
// Contexts. The definitions of a file belong to a context that is named after the file: its name without
// ".cal", in which characters that names cannot contain are replaced by '_'. The context "" contains the
// definitions that all files share. A name in a file refers to
//   name        the file's own definition, if the file has defined or used it further up; otherwise the
//               shared definition, if there is one by then; otherwise a library function; otherwise the
//               file's own definition, which may follow further down
//   `name       only the file's own definition
//   name`       only the shared definition
//   name`ctx`   only the definition of context ctx
// Source: RADIANCE file formats, "Function File Format", "Language Features".
//
// Constants. A variable that is defined with ':' and whose value is known by then is replaced by its value
// where it is used further down. So is the call of a function that is defined with ':' if its arguments are
// constants. If such a value would differ from ray to ray, because it uses inputs, arg() or the renderer's
// functions, its use is an error.
namespace rad::calc {

struct SourceText {
  std::string path;  // as messages name it
  std::string text;
};

// The names and functions that the renderer adds to the language.
struct Interface {
  std::vector<std::string> inputs;  // names of its variables, at most 64; the first is also $1
  std::vector<HostFunction> hosts;  // its functions
  std::string_view preludeName;     // the file that is read first, into the shared context; may be empty
  std::string_view preludeText;     // used if there is no such file
  // The end of a message about a function file that was not found (" in .:/usr/local/lib/ray"); may be empty.
  std::function<std::string(std::string_view file)> searched{};
};

// Finds and reads a function file. Empty if there is none. Throws Error, without the place of the request, if
// there is one that cannot be read. Called while the library is locked, so it
// must not call the library.
using LoadFile = std::function<std::optional<SourceText>(std::string_view name)>;

struct Request {
  std::string place;            // of the primitive, for messages
  std::string_view file = ".";  // its function file; ".": none, so that names refer to the shared context
  std::span<const std::string> expressions;  // evaluated together, in this order
  uint64_t available = ~uint64_t{0};         // bit i: inputs[i] is defined for this primitive
  // The values of arg(n), if the program may be compiled for these values only. Much of it is then evaluated
  // in advance. Otherwise the program reads Point::reals.
  std::optional<std::span<const double>> reals;
};

// Thread-safe. Programs may outlive the library.
class Library {
 public:
  Library(Interface interface, LoadFile load, Warn warn = {});
  ~Library();

  // Adds definitions to the shared context, after the prelude, for the options -e text
  // and -f file. Throws Error.
  void define(std::string_view text, std::string_view place);
  void include(std::string_view file);

  // The program for a primitive's expressions. Loads its file if no earlier request did. A file is read once;
  // if it has an error, every request for it throws that error. Throws Error
  // - with Status::system for a file that is not found,
  // - for anything that the language does not allow,
  // - for an undefined name that every evaluation would need.
  std::shared_ptr<const Program> compile(const Request& request);

  // The program for function(Point::arguments[0], .. [count-1]). Ignores request.expressions.
  // Throws as compile() does.
  std::shared_ptr<const Program> compileCall(const Request& request, std::string_view function, int count);

  // The number of arguments that a function of this name needs, as the primitive of the request sees it. 0 if
  // there is no such function. Ignores all of the request but place and file. Throws Error if the file cannot
  // be found or is wrong.
  int functionArity(const Request& request, std::string_view name);

 private:
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

// The context of a function file: "lib/wood.cal" -> "`lib_wood"; "." -> "".
std::string contextOf(std::string_view file);

}  // namespace rad::calc
