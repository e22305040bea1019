#pragma once
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "rad_parser/calc/library.h"

namespace rad::calc {

// A library over files in memory, with the inputs x, y and z.
class Files {
 public:
  std::map<std::string, std::string> files;
  std::vector<std::string> warnings;
  std::string prelude;
  std::vector<HostFunction> hosts;
  std::vector<double> inputs = {.25, .5, -2};
  std::vector<double> reals = {7, 8, 9};
  uint32_t faults = 0;

  Library& library() {
    if (!library_) {
      Interface interface;
      interface.inputs = {"x", "y", "z"};
      interface.hosts = hosts;
      interface.preludeName = "prelude.cal";
      interface.preludeText = prelude;
      interface.searched = [](std::string_view file, bool) {
        return " (not even \"" + std::string(file) + "\")";
      };
      const auto load = [this](std::string_view name) -> std::optional<SourceText> {
        const auto found = files.find(std::string(name));
        if (found == files.end()) return {};
        ++loads;
        return SourceText{found->first, found->second};
      };
      library_ = std::make_unique<Library>(interface, load,
                                           [this](std::string_view w) { warnings.emplace_back(w); });
    }
    return *library_;
  }

  std::shared_ptr<const Program> compile(std::string_view file, const std::string& text) {
    Request request;
    request.place = "room.rad:3";
    request.file = file;
    const std::vector<std::string> texts = {text};
    request.expressions = texts;
    return library().compile(request);
  }

  double value(std::string_view file, const std::string& text) {
    State state;
    const double value = compile(file, text)->evaluate({inputs, reals, {}}, state);
    faults = state.faults;
    return value;
  }
  double value(const std::string& text) { return value(".", text); }

  // The text of the error of compiling or evaluating.
  std::string error(std::string_view file, const std::string& text) {
    try {
      value(file, text);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  }
  std::string error(const std::string& text) { return error(".", text); }

  int loads = 0;

 private:
  std::unique_ptr<Library> library_;
};

}  // namespace rad::calc
