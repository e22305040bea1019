#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "rsphere/options.h"

namespace rsphere::python {

// The options of a call, from its keywords:
// - the members of rsphere::Options by their names in Python (ambient_bounces), and threads, outputs and
//   arguments;
// - any other keyword is an option of the command without its hyphen: ab=5 is -ab 5, av=(.1, .1, .1) is -av
//   .1 .1 .1, dv=False is -dv- and dv=True is -dv+. An underscore at the end is dropped, because `as` is a
//   word of Python.
// None leaves an option out. Throws pybind11::type_error if a value has a wrong type.
Options optionsOf(const pybind11::kwargs& keywords);

// The path or paths (str, bytes or os.PathLike) as the system knows them. Throws pybind11::type_error.
std::vector<std::string> pathsOf(const pybind11::object& files);

// A number of zones, or a dict with the members of Bins by their names.
Bins binsOf(const pybind11::object& given);

}  // namespace rsphere::python
