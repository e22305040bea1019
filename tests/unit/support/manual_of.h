#pragma once
// The pages of man/ are generated: NAME.1 is the template NAME.1.in, into which the options and the
// quantities of points are inserted. What is said of an option is in the table of options, and in its
// paragraph in NAME.options. After a change of one of these, copy the page that the test writes to the build
// folder.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "cli/option_table.h"
#include "points/quantities.h"

namespace rsphere::manual {

inline std::string contents(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

inline std::string folder() { return std::string(RSPHERE_TESTS) + "/../man/"; }

// The texts of NAME.options by the first line of each. A line that begins with '>' begins a paragraph.
inline std::map<std::string, std::string> paragraphs(const std::string& name) {
  std::istringstream in(contents(folder() + name + ".options"));
  std::map<std::string, std::string> all;
  std::string option;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    if (line.empty()) {
      option.clear();
    } else if (option.empty()) {
      option = line;
      EXPECT_TRUE(all.insert({option, ""}).second) << option << " has two paragraphs";
    } else {
      std::string& text = all[option];
      if (line.starts_with("> "))
        text += "\n.IP\n" + line.substr(2);
      else
        text += (text.empty() ? "" : " ") + line;
    }
  }
  return all;
}

// The sentences of the manual on the unit and the range.
inline std::string unitAndRange(const OptionEntry& entry) {
  std::string text;
  if (!entry.unit.empty()) text += fmt::format("Unit: {}. ", entry.unit);
  const bool low =
      std::isfinite(entry.range.lowest) && entry.range.lowest != -std::numeric_limits<int>::max();
  const bool high =
      std::isfinite(entry.range.highest) && entry.range.highest != std::numeric_limits<int>::max();
  if (low && high) text += fmt::format("From {} to {}. ", entry.range.lowest, entry.range.highest);
  if (low && !high) text += fmt::format("At least {}. ", entry.range.lowest);
  return text;
}

// unitAndRange(), followed by the defaults.
inline std::string facts(const OptionEntry& entry) {
  std::string text = unitAndRange(entry);
  Options rays = modeDefaults(false), spheres = modeDefaults(true);
  const std::string ray = shortValue(entry, rays), sphere = shortValue(entry, spheres);
  if (entry.name == "-S" || ray.empty()) return text;
  if (ray == sphere || entry.group == Group::sphere)
    text += fmt::format("Default: {}. ", sphere);
  else
    text += fmt::format("Default: {} in ray mode, {} in sphere mode. ", ray, sphere);
  return text;
}

// Escapes text for man(7): lines may not begin with a dot or a quote, and a hyphen is written as a minus.
inline std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  if (!out.empty() && (out[0] == '.' || out[0] == '\'')) out.insert(0, "\\&");
  return out;
}

// The part of a manual on one option. `more` follows its paragraph.
inline std::string manualEntry(const OptionEntry& entry, const std::string& paragraph,
                               const std::string& more) {
  const bool isSwitch = std::holds_alternative<SwitchValue>(entry.value);
  std::string text = fmt::format(".TP\n.BI {}{}\n", escaped(entry.name),
                                 isSwitch ? " [+|\\-]"
                                 : entry.arguments.empty()
                                     ? ""
                                     : fmt::format(" \"{}{}\"", entry.glued ? "" : " ", entry.arguments));
  text += escaped(paragraph);
  if (entry.support == Support::refused) text += escaped(fmt::format(" Not supported: {}.", entry.reason));
  if (!more.empty()) text += '\n' + escaped(more.substr(0, more.size() - 1));
  return text + '\n';
}

// What the page says of each option. Every option has a paragraph, and every paragraph an option.
class OptionTexts {
 public:
  explicit OptionTexts(std::map<std::string, std::string> paragraphs) : left_(std::move(paragraphs)) {}
  ~OptionTexts() {
    for (const auto& [option, text] : left_) ADD_FAILURE() << "there is no option " << option;
  }
  // `facts` follow the paragraph.
  std::string of(const OptionEntry& entry, const std::string& facts) {
    const std::string key = std::string(entry.name) + std::string(entry.glued ? entry.arguments : "");
    const std::string text = left_[key];
    EXPECT_TRUE(text.ends_with('.')) << key << " needs a paragraph that ends with a full stop";
    left_.erase(key);
    return manualEntry(entry, text, facts);
  }

 private:
  std::map<std::string, std::string> left_;
};

inline std::string optionsOfRsphere() {
  OptionTexts texts(paragraphs("rsphere"));
  std::string text;
  for (const auto& [group, name] : kGroups) {
    text += fmt::format(".SS {}\n", name);
    for (const OptionEntry& entry : optionTable())
      if (entry.group == group) text += texts.of(entry, facts(entry));
  }
  return text;
}

inline std::string optionsOf(const Companion& companion, const std::string& name, Options& defaults) {
  OptionTexts texts(paragraphs(name));
  std::string text;
  for (const OptionEntry& entry : companion.own) {
    const std::string value = shortValue(entry, defaults);
    text += texts.of(entry, unitAndRange(entry) + (value.empty() ? "" : fmt::format("Default: {}. ", value)));
  }
  return text;
}

inline std::string quantities() {
  constexpr size_t kWidth = 57;  // columns before the unit
  std::string text;
  for (const PointQuantity& quantity : pointQuantities()) {
    if (quantity.definition.empty()) continue;  // another meaning of e
    const bool isColor = quantity.each != nullptr;
    const std::string columns = quantity.values == PointQuantity::kOfZones
                                    ? "3N"
                                    : fmt::format("{}", quantity.values * (isColor ? 3 : 1));
    std::string line = fmt::format("{} {:>2}  ", quantity.letter, columns);
    for (const char c : quantity.definition) {
      if (c != '\n')
        line += c;
      else
        text += escaped(std::exchange(line, "      ")) + '\n';
    }
    if (!quantity.unit.empty()) line = fmt::format("{:<{}}({})", line, kWidth, quantity.unit);
    text += escaped(line) + '\n';
  }
  return text;
}

// That man/NAME.1 is man/NAME.1.in with the texts in place of the lines `.\" @KEY@`. If it is not, leaves
// what it should be in the folder of the test.
inline void expectPage(const std::string& name, const std::map<std::string, std::string>& texts) {
  std::string page = contents(folder() + name + ".1.in");
  for (const auto& [key, text] : texts) {
    const std::string mark = fmt::format(".\\\" @{}@\n", key);
    const size_t at = page.find(mark);
    ASSERT_NE(at, std::string::npos);
    page.replace(at, mark.size(), text);
  }
  if (contents(folder() + name + ".1") == page) return;
  std::ofstream(name + ".1", std::ios::binary) << page;
  FAIL() << "differs from " << name << ".1 in the folder of this test";
}

}  // namespace rsphere::manual
