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

// The definitions of function files, and programs made from them.
//
// Contexts. Each file's definitions have the file as their context: its name without ".cal", other characters
// than those of names as '_'. The context "" holds what all files share. A name in a file means
//   name        the file's, if the file has defined or used it further up; else the shared one if there is
//   one by then;
//               else a library function; else the file's own, which may be defined further down
//   `name       the file's only
//   name`       the shared one only; name`ctx` the one of context ctx
// Source: RADIANCE file formats, "Function File Format", "Language Features".
//
// Constants. A variable defined with ':' that is a number by then is replaced by its value where it is used
// further down, and so is the call of a function defined with ':' whose arguments are constants. Where such a
// value would be another for each ray (it uses inputs, arg() or the renderer's functions) the use is an
// error.
namespace rad::calc {

struct SourceText {
  std::string path;  // as messages name it
  std::string text;
};

// What the renderer gives to the language.
struct Interface {
  std::vector<std::string> inputs;  // names of its variables; the first is also $1. At most 64
  std::vector<HostFunction> hosts;  // its functions
  std::string_view
      preludeName;  // the file that is read first, into the shared context ("rayinit.cal"); may be ""
  std::string_view preludeText;  // used where there is no such file
  // The end of a message about a function file that was not found (" in .:/usr/local/lib/ray"); may be null.
  std::string (*searched)(std::string_view file) = nullptr;
};

// Finds and reads a function file; nullopt where there is none. Called with the library locked.
using LoadFile = std::function<std::optional<SourceText>(std::string_view name)>;

struct Request {
  std::string place;                         // of the primitive, for messages
  std::string_view file = ".";               // its function file; "." for none: the shared context
  std::span<const std::string> expressions;  // evaluated together, in this order
  uint64_t available = ~uint64_t{0};  // bit i: inputs[i] exists for this primitive; others are undefined
  // arg(n), if the program is to be made for these; else it reads Point::reals. Much is then done in advance.
  std::optional<std::span<const double>> reals;
};

// Thread-safe. Programs outlive the library.
class Library {
 public:
  Library(Interface interface, LoadFile load, Warn warn = {});
  ~Library();

  // Adds shared definitions, after the prelude: the options -e text and -f file. Throws Error.
  void define(std::string_view text, std::string_view place);
  void include(std::string_view file);

  // The program for a primitive's expressions. Loads its file if no request did. A file is read once; if it
  // has an error, every request for it throws that error. Throws Error: a file that is not found
  // (Status::system), anything that the language does not allow, and a name that is undefined and certain to
  // be needed.
  std::shared_ptr<const Program> compile(const Request& request);

  // The program for function(Point::arguments[0], .. [count-1]); request.expressions is not used.
  std::shared_ptr<const Program> compileCall(const Request& request, std::string_view function, int count);

  // Whether a primitive that uses `file` sees a function of this name, and how many arguments it needs. 0:
  // none.
  int functionArity(std::string_view file, std::string_view name);

 private:
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

// The context of a function file: "lib/wood.cal" -> "`lib_wood"; "." -> "".
std::string contextOf(std::string_view file);

}  // namespace rad::calc
