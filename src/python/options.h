#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "rsphere/options.h"

namespace rsphere::python {

// Reads the options of a call from its keywords:
// - the members of rsphere::Options by their Python names (ambient_bounces), and threads, outputs and
//   arguments;
// - any other keyword is an option of the command without its hyphen: ab=5 is -ab 5, av=(.1, .1, .1) is -av
//   .1 .1 .1, dv=False is -dv- and dv=True is -dv+. An underscore at the end is removed, because `as` is a
//   reserved word in Python.
// Options that are None are ignored. Throws pybind11::type_error if a value has a wrong type.
Options optionsOf(const pybind11::kwargs& keywords);

// One or more paths (str, bytes or os.PathLike) in the system's encoding. Throws pybind11::type_error.
std::vector<std::string> pathsOf(const pybind11::object& files);

// The value of an argument that is a whole number, or True or False. Throws pybind11::type_error with the
// name of the argument for anything else.
int wholeNumberOf(const pybind11::object& given, const std::string& argument);
bool truthOf(const pybind11::object& given, const std::string& argument);

// The bins given by a number of zones, or by a dict with the members of Bins.
Bins binsOf(const pybind11::object& given);

}  // namespace rsphere::python
