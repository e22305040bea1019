#include "rad_parser/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "rad_parser/error.h"
#include "rad_parser/nearest_name.h"
#include "rad_parser/printable.h"

namespace rad {

std::string Description::at(Place place) const {
  const auto alone = [this](Place p) {
    const SourceFile& file = files[p.file];
    // The first words are sufficient to identify a command, but a file is only identified by its whole path.
    const std::string name = printable(file.name, file.name.starts_with('!') ? 100 : kLongestName);
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

std::span<const double> Description::reals(const Primitive& p) const {
  if (p.type != Type::polygon) return std::span(realArgs).subspan(p.firstReal, p.reals);
  if (p.reals == 0 || vertices.empty()) return {};
  return {&vertices[p.firstReal].x, p.reals};
}

std::span<double> Description::reals(const Primitive& p) {
  const auto values = std::as_const(*this).reals(p);
  return {const_cast<double*>(values.data()), values.size()};
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
  const uint64_t reals = to.realArgs.size(), vertices = to.vertices.size();

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
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (Primitive p : more.primitives) {
    if (p.modifier != kVoid) p.modifier = PrimitiveId(p.modifier.index() + primitives);
    if (p.aliased != kVoid) p.aliased = PrimitiveId(p.aliased.index() + primitives);
    p.place.file += files;
    p.firstString += strings;
    p.firstReal += p.type == Type::polygon ? vertices : reals;
    to.primitives.push_back(p);
  }
  more = Description();
}

ModifierIndex::ModifierIndex(const Description& description, size_t first) {
  const auto end = description.primitives.end();
  for (auto p = description.primitives.from(first); p != end; ++p)
    if (!isSurface(p->type)) definitions_[p->name].push_back(p.id());
}

PrimitiveId ModifierIndex::before(std::string_view name, PrimitiveId index) const {
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) return kVoid;
  const std::vector<PrimitiveId>& at = found->second;
  const auto after = std::ranges::lower_bound(at, index);
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
