#include "rad_parser/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "rad_parser/error.h"
#include "rad_parser/nearest_name.h"

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

std::string nearestType(std::string_view name) {
  NearestName nearest(name);
  for (const std::string_view type : kNames) nearest.consider(type);
  return nearest.hint();
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
    // The first words identify a command, but only the whole path identifies a file.
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

void append(Description& to, Description&& more, Place from) {
  const auto check = [](size_t have, size_t added, size_t most) {
    if (added > most - have) throw Error("too many primitives or arguments in all files");
  };
  constexpr size_t kMost32 = std::numeric_limits<uint32_t>::max();
  check(to.primitives.size(), more.primitives.size(), std::numeric_limits<int32_t>::max());
  check(to.words.size(), more.words.size(), kMost32);
  check(to.stringArgs.size(), more.stringArgs.size(), kMost32);
  const auto files = static_cast<uint32_t>(to.files.size()), words = static_cast<uint32_t>(to.words.size());
  const auto strings = static_cast<uint32_t>(to.stringArgs.size());
  const size_t primitives = to.primitives.size();
  const uint64_t reals = to.realArgs.size();

  for (SourceFile& file : more.files) {
    if (file.from.file == SourceFile::kNoFile)
      file.from = from;
    else
      file.from.file += files;
    to.files.push_back(std::move(file));
  }
  to.words.insert(to.words.end(), std::make_move_iterator(more.words.begin()),
                  std::make_move_iterator(more.words.end()));
  for (uint32_t word : more.stringArgs) to.stringArgs.push_back(word + words);
  to.realArgs.insert(to.realArgs.end(), more.realArgs.begin(), more.realArgs.end());
  for (Primitive p : more.primitives) {
    if (p.modifier != kVoid) p.modifier = PrimitiveId(p.modifier.index() + primitives);
    if (p.aliased != kVoid) p.aliased = PrimitiveId(p.aliased.index() + primitives);
    p.place.file += files;
    p.name += words;
    p.firstString += strings;
    p.firstReal += reals;
    to.primitives.push_back(p);
  }
  more = Description();
}

ModifierIndex::ModifierIndex(const Description& description, size_t first) {
  for (const PrimitiveId i : IdRange<PrimitiveId>(first, description.primitives.size() - first)) {
    const Primitive& p = description.primitives[i];
    if (!isSurface(p.type)) definitions_[description.name(p)].push_back(i);
  }
}

PrimitiveId ModifierIndex::before(std::string_view name, PrimitiveId index) const {
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) return kVoid;
  const std::vector<PrimitiveId>& at = found->second;
  const auto after = std::lower_bound(at.begin(), at.end(), index);
  return after == at.begin() ? PrimitiveId() : *std::prev(after);
}

std::string ModifierIndex::nearest(std::string_view name, PrimitiveId index) const {
  NearestName nearest(name);
  nearest.consider("void");
  for (const auto& [defined, at] : definitions_)
    if (at.front() < index) nearest.consider(defined);
  return nearest.hint();
}

}  // namespace rad
