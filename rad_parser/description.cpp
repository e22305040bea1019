#include "rad_parser/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rad {
namespace {

constexpr std::array<std::string_view, kTypes> kNames = {
    "source",     "sphere",     "bubble",   "polygon",   "cone",       "cup",        "cylinder",
    "tube",       "ring",       "instance", "mesh",      "light",      "illum",      "glow",
    "spotlight",  "mirror",     "prism1",   "prism2",    "mist",       "plastic",    "metal",
    "trans",      "plastic2",   "metal2",   "trans2",    "ashik2",     "dielectric", "interface",
    "glass",      "plasfunc",   "metfunc",  "transfunc", "BRTDfunc",   "plasdata",   "metdata",
    "transdata",  "BSDF",       "aBSDF",    "WGMDfunc",  "antimatter", "texfunc",    "texdata",
    "colorfunc",  "brightfunc", "specfunc", "colordata", "brightdata", "specdata",   "colorpict",
    "brighttext", "colortext",  "spectrum", "specfile",  "specpict",   "mixfunc",    "mixdata",
    "mixpict",    "mixtext",    "alias"};

struct NamedType {
  std::string_view name;
  Type type = Type::alias;
};

constexpr auto kByName = [] {
  std::array<NamedType, kTypes> sorted;
  for (int i = 0; i < kTypes; ++i) sorted[i] = {kNames[i], static_cast<Type>(i)};
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return sorted;
}();

bool within(Type type, Type first, Type last) { return first <= type && type <= last; }

}  // namespace

std::string_view typeName(Type type) { return kNames[static_cast<size_t>(type)]; }

bool findType(std::string_view name, Type& type) {
  const auto at = std::lower_bound(kByName.begin(), kByName.end(), name,
                                   [](const NamedType& t, std::string_view n) { return t.name < n; });
  if (at == kByName.end() || at->name != name) return false;
  type = at->type;
  return true;
}

bool isSurface(Type type) { return within(type, Type::source, Type::mesh); }
bool isMaterial(Type type) { return within(type, Type::light, Type::antimatter); }
bool isTexture(Type type) { return within(type, Type::texfunc, Type::texdata); }
bool isPattern(Type type) { return within(type, Type::colorfunc, Type::specpict); }
bool isMixture(Type type) { return within(type, Type::mixfunc, Type::mixtext); }

std::string printable(std::string_view text, size_t longest) {
  std::string line(text.substr(0, longest));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  if (text.size() > longest) line += "...";
  return line;
}

std::string Description::at(Place place) const {
  const auto alone = [this](Place p) {
    const SourceFile& file = files[p.file];
    // A command is known by its first words, a file by its whole path.
    const std::string name = printable(file.name, file.name.starts_with('!') ? 100 : 4096);
    if (p.line == 0) return name;
    return file.numbered ? fmt::format("{}: object {}", name, p.line) : fmt::format("{}:{}", name, p.line);
  };
  constexpr int kShown = 4;
  std::string text = alone(place);
  int shown = 0;
  for (Place from = files[place.file].from; from.file != SourceFile::kNoFile; from = files[from.file].from) {
    const bool last = files[from.file].from.file == SourceFile::kNoFile;
    if (shown < kShown || last) {
      text += shown == 0 ? " (from " : ", ";
      if (shown > kShown) text += "..., ";
      text += alone(from);
    }
    ++shown;
  }
  if (shown > 0) text += ')';
  return text;
}

ModifierIndex::ModifierIndex(const Description& description) {
  for (size_t i = 0; i < description.primitives.size(); ++i) {
    const Primitive& p = description.primitives[i];
    if (!isSurface(p.type)) definitions_[description.name(p)].push_back(static_cast<int32_t>(i));
  }
}

int32_t ModifierIndex::before(std::string_view name, int32_t index) const {
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) return kVoid;
  const std::vector<int32_t>& at = found->second;
  const auto after = std::lower_bound(at.begin(), at.end(), index);
  return after == at.begin() ? kVoid : *std::prev(after);
}

}  // namespace rad
