#include "python/options.h"

#include <pybind11/stl.h>

#include <string_view>

namespace py = pybind11;

namespace rsphere::python {
namespace {

// Sets a member if the keyword is its name.
struct Keyword {
  std::string_view name;
  py::handle value;
  bool known = false;

  template <typename Member>
  void set(std::string_view member, Member& to) {
    if (name != member) return;
    known = true;
    try {
      to = value.cast<Member>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(name) +
                           " has a value of the wrong type: " + std::string(py::repr(value)));
    }
  }
};

// Whether the name cannot be that of an option of the command, of which none has an underscore within.
bool isNoOption(std::string_view name) {
  const size_t at = name.find('_');
  return at != name.npos && at + 1 < name.size();
}

bool isSequence(const py::handle& value) {
  return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) || py::hasattr(value, "tolist");
}

void addWords(std::vector<std::string>& words, std::string name, py::object value) {
  if (!name.empty() && name.back() == '_') name.pop_back();
  name.insert(name.begin(), '-');
  // Numbers and arrays of NumPy become those of Python.
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
    if (value.is_none()) continue;
    const auto text = name.cast<std::string>();
    Keyword keyword{text, value};
    keyword.set("ambient_bounces", options.ambientBounces);
    keyword.set("ambient_accuracy", options.ambientAccuracy);
    keyword.set("ambient_divisions", options.ambientDivisions);
    keyword.set("ambient_super_samples", options.ambientSuperSamples);
    keyword.set("ambient_resolution", options.ambientResolution);
    keyword.set("ambient_value", options.ambientValue);
    keyword.set("limit_reflections", options.limitReflections);
    keyword.set("limit_weight", options.limitWeight);
    keyword.set("rotation", options.rotation);
    keyword.set("irradiance_at_origin", options.irradianceAtOrigin);
    keyword.set("irradiance_at_surface", options.irradianceAtSurface);
    keyword.set("directions", options.directions);
    keyword.set("most_directions", options.mostDirections);
    keyword.set("accuracy", options.accuracy);
    keyword.set("outputs", options.outputs);
    keyword.set("threads", options.threads);
    keyword.set("arguments", options.arguments);
    if (!keyword.known && isNoOption(text))
      throw py::type_error("'" + text + "' is not an option; help(rsphere.Scene) lists the options");
    if (!keyword.known) addWords(further, text, py::reinterpret_borrow<py::object>(value));
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

}  // namespace rsphere::python
