#include "python/options.h"

#include <pybind11/stl.h>

#include <string_view>

namespace py = pybind11;

namespace rsphere::python {
namespace {

// Sets the member that the keyword names.
struct Keyword {
  std::string_view name;
  py::handle value;
  const py::kwargs& all;
  bool known = false;

  // option: the corresponding option of the command, without its hyphen, if there is one.
  template <typename Member>
  void set(std::string_view member, Member& to, const char* option = "") {
    if (name != member) return;
    known = true;
    if (value.is_none()) return;
    if (all.contains(option) || all.contains(std::string(option) + '_'))
      throw py::type_error(std::string(name) + " and " + option + " are the same option: give one of them");
    try {
      to = value.cast<Member>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(name) +
                           " has a value of the wrong type: " + std::string(py::repr(value)));
    }
  }
};

// Whether a keyword cannot name an option of the command. Names of options contain no underscore, and the
// longest that applies to a call is pRGB. Keywords such as "oVW" are also excluded: the letters after -f, -o,
// -te and -ti are a value, not part of the name.
bool isNoOption(std::string_view name) {
  constexpr size_t kLongest = 4;
  const size_t at = name.find('_');
  if ((at != name.npos && at + 1 < name.size()) || name.size() > kLongest + (at != name.npos)) return true;
  if (name[0] == 'f' || name[0] == 'o') return name.size() > 1;
  return name.size() > 2 && (name.starts_with("te") || name.starts_with("ti"));
}

bool isSequence(const py::handle& value) {
  return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) || py::hasattr(value, "tolist");
}

void addWords(std::vector<std::string>& words, std::string name, py::object value) {
  if (!name.empty() && name.back() == '_') name.pop_back();
  name.insert(name.begin(), '-');
  // Converts numbers and arrays of NumPy to Python's.
  if (py::hasattr(value, "tolist")) value = value.attr("tolist")();
  if (py::isinstance<py::bool_>(value)) {
    words.push_back(name + (value.cast<bool>() ? '+' : '-'));
    return;
  }
  words.push_back(name);
  if (!isSequence(value)) {
    words.push_back(py::str(value));
    return;
  }
  for (const py::handle& item : value) words.push_back(py::str(item));
}

}  // namespace

Options optionsOf(const py::kwargs& keywords) {
  Options options;
  std::vector<std::string> further;
  for (const auto& [name, value] : keywords) {
    const auto text = name.cast<std::string>();
    Keyword keyword{text, value, keywords};
    keyword.set("ambient_bounces", options.ambientBounces, "ab");
    keyword.set("ambient_accuracy", options.ambientAccuracy, "aa");
    keyword.set("ambient_divisions", options.ambientDivisions, "ad");
    keyword.set("ambient_super_samples", options.ambientSuperSamples, "as");
    keyword.set("ambient_resolution", options.ambientResolution, "ar");
    keyword.set("ambient_value", options.ambientValue, "av");
    keyword.set("limit_reflections", options.limitReflections, "lr");
    keyword.set("limit_weight", options.limitWeight, "lw");
    keyword.set("rotation", options.rotation, "Sr");
    keyword.set("irradiance_at_origin", options.irradianceAtOrigin, "I");
    keyword.set("irradiance_at_surface", options.irradianceAtSurface, "i");
    keyword.set("directions", options.directions, "Sn");
    keyword.set("most_directions", options.mostDirections, "Sx");
    keyword.set("accuracy", options.accuracy, "Sa");
    if (text == "bins" && py::isinstance<py::dict>(value)) {
      options.directionBins = binsOf(py::reinterpret_borrow<py::object>(value));
      continue;
    }
    keyword.set("bins", options.zones, "Sz");
    keyword.set("outputs", options.outputs, "o");
    keyword.set("threads", options.threads, "n");
    keyword.set("arguments", options.arguments);
    if (!keyword.known && isNoOption(text))
      throw py::type_error("'" + text + "' is not an option; help(rsphere.Scene) lists the options");
    if (!keyword.known && !value.is_none())
      addWords(further, text, py::reinterpret_borrow<py::object>(value));
  }
  options.arguments.insert(options.arguments.begin(), further.begin(), further.end());
  return options;
}

std::vector<std::string> pathsOf(const py::object& files) {
  const py::object encode = py::module_::import("os").attr("fsencode");
  const auto path = [&](const py::handle& file) { return encode(file).cast<std::string>(); };
  if (!py::isinstance<py::list>(files) && !py::isinstance<py::tuple>(files)) return {path(files)};
  std::vector<std::string> paths;
  for (const py::handle& file : files) paths.push_back(path(file));
  return paths;
}

int wholeNumberOf(const py::object& given, const std::string& argument) {
  try {
    if (!py::isinstance<py::bool_>(given)) return given.cast<int>();
  } catch (const py::cast_error&) {
  }
  throw py::type_error(argument + " must be a whole number below 2147483648, not " +
                       std::string(py::repr(given)));
}

bool truthOf(const py::object& given, const std::string& argument) {
  try {
    if (!given.is_none()) return given.cast<bool>();
  } catch (const py::cast_error&) {
  }
  throw py::type_error(argument + " must be True or False, not " + std::string(py::repr(given)));
}

Bins binsOf(const py::object& given) {
  Bins bins;
  if (given.is_none()) return bins;
  if (py::isinstance<py::int_>(given)) {
    bins.zones = given.cast<int>();
    return bins;
  }
  if (!py::isinstance<py::dict>(given))
    throw py::type_error(
        "bins must be a number of zones, or a dict of expression, count, parameters and files");
  for (const auto& [key, value] : given.cast<py::dict>()) {
    const auto name = key.cast<std::string>();
    if (name == "expression")
      bins.expression = value.cast<std::string>();
    else if (name == "count")
      bins.count = py::str(value);
    else if (name == "parameters")
      bins.parameters = value.cast<std::string>();
    else if (name == "files")
      bins.files = pathsOf(py::reinterpret_borrow<py::object>(value));
    else
      throw py::type_error("bins have no '" + name + "', but expression, count, parameters and files");
  }
  return bins;
}

}  // namespace rsphere::python
