#pragma once
#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/scene_file.h"

// A folder that is removed at the end of the test.
class TestFolder {
 public:
  TestFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "rad_parser_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder for the test");
    path_ = pattern;
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  // Writes a file, and creates the folders of its path. Returns the path.
  std::string write(const std::string& name, std::string_view text) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::filesystem::remove(path);  // ext4 writes to the disk when a truncated file is closed
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  std::string path(const std::string& name = {}) const {
    return (name.empty() ? path_ : path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

inline rad::Description readFile(const std::string& path, std::vector<std::string>* warnings = nullptr,
                                 bool commands = true) {
  rad::ReadOptions options;
  options.commands = commands;
  if (warnings) options.warn = [warnings](std::string_view text) { warnings->emplace_back(text); };
  return rad::readScene(std::vector<std::string>{path}, options);
}

inline rad::Description readText(std::string_view text) { return rad::readSceneText(text, "room.rad"); }

// The text of the error; empty if there is none.
template <class Read>
std::string errorOf(Read read, rad::Status status = rad::Status::input) {
  try {
    read();
  } catch (const rad::Error& error) {
    if (error.status() != status) return fmt::format("wrong status: {}", error.what());
    return error.what();
  }
  return {};
}
inline std::string errorOfText(std::string_view text) {
  return errorOf([&] { readText(text); });
}

// A word as it is written in scene text, in quotes if necessary.
inline std::string sceneWord(std::string_view word) {
  const char mark = word.find('"') == word.npos ? '"' : '\'';
  return word.empty() || word.find_first_of(" \t\r\n\v\f\"'") != word.npos
             ? fmt::format("{}{}{}", mark, word, mark)
             : std::string(word);
}

// Scene text that reads back as the same description, digit for digit.
inline std::string printScene(const rad::Description& d) {
  std::string text;
  for (const rad::Primitive& p : d.primitives) {
    const std::string modifier = p.modifier == rad::kVoid ? "void" : d.primitives[p.modifier].name;
    text += fmt::format("{} {} {}\n", sceneWord(modifier), rad::typeName(p.type), sceneWord(p.name));
    if (p.type == rad::Type::alias) {
      text += fmt::format("\t{}\n", sceneWord(d.string(p, 0)));
      continue;
    }
    text += fmt::format("{}", p.strings);
    for (uint32_t i = 0; i < p.strings; ++i) text += fmt::format(" {}", sceneWord(d.string(p, i)));
    text += fmt::format("\n0\n{}", p.reals);
    for (const double x : d.reals(p)) text += fmt::format(" {}", x);
    text += '\n';
  }
  return text;
}
