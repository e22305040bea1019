#include "rad_parser/tables/bsdf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "rad_parser/description.h"
#include "rad_parser/number.h"
#include "rad_parser/printable.h"

namespace rad {
namespace {

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

bool sameWord(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lowered(x) == lowered(y); });
}

// Text in UTF-16 that begins with a byte order mark, converted to UTF-8.
std::string fromUtf16(std::string_view text) {
  const size_t low = text[0] == '\xff' ? 0 : 1;
  const auto isIn = [](wchar_t unit, wchar_t first) { return unit >= first && unit < first + 0x400; };
  std::wstring wide;
  for (size_t i = 2; i + 1 < text.size(); i += 2) {
    const auto byte = [&](size_t at) { return static_cast<unsigned char>(text[i + at]); };
    const auto unit = static_cast<wchar_t>(byte(1 - low) << 8 | byte(low));
    if (isIn(unit, 0xdc00) && !wide.empty() && isIn(wide.back(), 0xd800))
      wide.back() = 0x10000 + ((wide.back() - 0xd800) << 10) + (unit - 0xdc00);
    else
      wide += unit;
  }
  return pugi::as_utf8(wide);
}

AngleBasis klems(std::string_view name, std::vector<AngleBasis::Ring> rings) {
  AngleBasis basis{std::string(name), std::move(rings), 0};
  for (const auto& ring : basis.rings) basis.cells += ring.cells;
  return basis;
}

// The numbers and braces in the text of an element, with their lines for messages.
class Data {
 public:
  // firstLine: line of the file in which the text begins.
  Data(std::string_view text, std::string_view file, ptrdiff_t firstLine)
      : text_(text), file_(file), firstLine_(firstLine) {}

  [[noreturn]] void fail(std::string_view problem) const {
    const auto end = text_.begin() + static_cast<ptrdiff_t>(position_);
    throw Error(fmt::format("{}:{}: {}", file_, firstLine_ + std::count(text_.begin(), end, '\n'), problem));
  }

  // The next character that is not blank, or 0 at the end.
  char next() {
    position_ = std::min(text_.find_first_not_of(kBlanks, position_), text_.size());
    return position_ < text_.size() ? text_[position_] : '\0';
  }
  // Skips the character and returns true if it is the next one.
  bool take(char c) {
    if (next() != c) return false;
    ++position_;
    return true;
  }
  // Reads a value of scattering and the comma that may follow it.
  float value() {
    next();
    const size_t end = std::min(text_.find_first_of(" \t\n\r\f\v,{}", position_), text_.size());
    const std::string_view word = text_.substr(position_, end - position_);
    const std::optional<double> number = parseReal(word);
    if (!number || !std::isfinite(static_cast<float>(*number)))
      fail(word.empty() ? std::string("expected a number in the scattering data, got its end")
                        : fmt::format("expected a number in the scattering data, got \"{}\"",
                                      printable(word.substr(0, 40))));
    position_ = end;
    take(',');
    return std::max(0.F, static_cast<float>(*number));
  }
  size_t left() const { return text_.size() - position_; }

 private:
  std::string_view text_, file_;
  ptrdiff_t firstLine_;
  size_t position_ = 0;
};

class TreeReader {
 public:
  TreeReader(Data& data, int rank) : data_(data), rank_(rank), branching_(size_t{1} << rank) {}

  TensorTree read() {
    tree_.nodes.emplace_back();
    readNode(0, 0);
    if (data_.next() != '\0') data_.fail("expected the end of the tensor tree");
    return std::move(tree_);
  }

 private:
  size_t addChildren(size_t node) {
    const size_t first = tree_.nodes.size();
    if (first + branching_ > UINT32_MAX) data_.fail("the tensor tree is too large");
    tree_.nodes.resize(first + branching_);
    tree_.nodes[node].children = static_cast<uint32_t>(first);
    return first;
  }

  void readNode(size_t node, int depth) {
    if (!data_.take('{')) data_.fail("expected '{' in the tensor tree");
    if (data_.next() == '{') {
      if (depth == BsdfFile::kDeepest) data_.fail("the tensor tree is too deep");
      const size_t first = addChildren(node);
      for (size_t i = 0; i < branching_; ++i) readNode(first + i, depth + 1);
    } else {
      readGrid(node, depth);
    }
    if (!data_.take('}')) data_.fail("expected '}' in the tensor tree");
    data_.take(',');
  }

  // Reads the values of an even grid with 1, 2, 4, ... cells along each dimension. The index of the last
  // dimension varies fastest.
  void readGrid(size_t node, int depth) {
    values_.clear();
    for (char c = data_.next(); c != '}' && c != '\0'; c = data_.next()) values_.push_back(data_.value());
    int halvings = 0;
    while (halvings * rank_ < 63 && size_t{1} << (halvings * rank_) < values_.size()) ++halvings;
    if (values_.size() != size_t{1} << (halvings * rank_))
      data_.fail(fmt::format("{} values do not form a grid of {} dimensions", values_.size(), rank_));
    if (depth + halvings > BsdfFile::kDeepest) data_.fail("the tensor tree is too deep");
    spread(node, 0, halvings, halvings);
  }

  // Converts a part of a grid into a subtree. The part begins at `from` and has 2^halvings cells along each
  // dimension; the whole grid has 2^whole.
  void spread(size_t node, size_t from, int halvings, int whole) {
    if (halvings == 0) {
      tree_.nodes[node].value = values_[from];
      return;
    }
    const size_t first = addChildren(node);
    for (size_t child = 0; child < branching_; ++child) {
      size_t begin = from;
      for (int i = 0; i < rank_; ++i)
        if (child >> i & 1) begin += size_t{1} << (halvings - 1 + whole * (rank_ - 1 - i));
      spread(first + child, begin, halvings - 1, whole);
    }
  }

  Data& data_;
  int rank_;
  size_t branching_;
  TensorTree tree_;
  std::vector<float> values_;
};

class BsdfReader {
 public:
  BsdfReader(std::string_view text, std::string_view name, const Warn& warn)
      : converted_(isUtf16(text) ? fromUtf16(text) : std::string()),
        text_(isUtf16(text) ? converted_ : text),
        name_(name),
        warn_(warn) {}

  BsdfFile read() {
    const pugi::xml_node layer = open();
    const pugi::xml_node definition = layer.child("DataDefinition");
    const pugi::xml_node structure = definition.child("IncidentDataStructure");
    const std::string_view kind = word(structure);
    if (kind.empty()) fail(layer, "no IncidentDataStructure");
    if (sameWord(kind, "TensorTree3") || sameWord(kind, "TensorTree4")) {
      file_.rank = kind.back() - '0';
    } else if (sameWord(kind, "Rows")) {
      incidentIsRow_ = true;
    } else if (!sameWord(kind, "Columns")) {
      fail(structure, fmt::format("the IncidentDataStructure \"{}\" is not supported", printable(kind)));
    }
    if (file_.rank == 0)
      for (const pugi::xml_node basis : definition.children("AngleBasis")) defineBasis(basis);
    for (const pugi::xml_node band : layer.children("WavelengthData")) readBand(band);
    dropIncomplete();
    return std::move(file_);
  }

 private:
  enum class Channel { y, first, second };  // first, second: X and Z for matrices, u' and v' for trees

  ptrdiff_t lineAt(ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<ptrdiff_t>(offset, 0, static_cast<ptrdiff_t>(text_.size()));
    return 1 + std::count(text_.begin(), end, '\n');
  }
  std::string at(ptrdiff_t offset) const { return fmt::format("{}:{}", name_, lineAt(offset)); }
  [[noreturn]] void fail(pugi::xml_node node, std::string_view problem) const {
    throw Error(fmt::format("{}: {}", at(node.offset_debug()), problem));
  }
  void warn(pugi::xml_node node, std::string_view problem) const {
    if (warn_) warn_(fmt::format("{}: {}", at(node.offset_debug()), problem));
  }

  // Reads the XML and finds the layer.
  pugi::xml_node open() {
    // In-place parsing keeps every byte at its offset, which gives its line in messages.
    buffer_.assign(text_.begin(), text_.end());
    const pugi::xml_parse_result parsed = document_.load_buffer_inplace(
        buffer_.data(), buffer_.size(), pugi::parse_cdata | pugi::parse_escapes, pugi::encoding_utf8);
    if (!parsed) throw Error(fmt::format("{}: not XML: {}", at(parsed.offset), parsed.description()));
    const pugi::xml_node root = document_.document_element();
    if (std::string_view(root.name()) != "WindowElement")
      fail(root, fmt::format("expected a WindowElement, got \"{}\"", printable(root.name())));
    if (const pugi::xml_node type = root.child("FileType"); type && word(type) != "BSDF")
      fail(type, fmt::format("expected the FileType BSDF, got \"{}\"", printable(word(type))));
    const pugi::xml_node layer = root.child("Optical").child("Layer");
    if (!layer) fail(root, "no optical layer");
    return layer;
  }

  // The text of an element, without surrounding blanks.
  static std::string_view word(pugi::xml_node node) { return trimmed(node.child_value()); }

  // The numbers in an element. If comments divide its text, the parts are joined.
  Data data(pugi::xml_node node) {
    std::string_view whole;
    size_t pieces = 0;
    for (const pugi::xml_node piece : node.children()) {
      const std::string_view part = piece.value();
      if (pieces++ == 0)
        whole = part;
      else if (pieces == 2)
        whole = joined_.assign(whole).append(" ").append(part);
      else
        whole = joined_.append(" ").append(part);
    }
    if (whole.empty()) fail(node, "no scattering data");
    const bool whereItLies = pieces == 1;
    return Data(whole, name_, lineAt(whereItLies ? whole.data() - buffer_.data() : node.offset_debug()));
  }

  double angle(pugi::xml_node bounds, const char* which) const {
    const pugi::xml_node node = bounds.child(which);
    const std::optional<double> value = parseReal(word(node));
    if (!value || !(*value >= 0 && *value <= 90))
      fail(node ? node : bounds, fmt::format("expected an angle from 0 to 90 as {}", which));
    return *value;
  }

  void defineBasis(pugi::xml_node node) {
    constexpr double kSameAngle = 1e-4;  // degrees; larger than the rounding of angles in files
    AngleBasis basis;
    basis.name = word(node.child("AngleBasisName"));
    if (basis.name.empty()) return;
    double begin = 0;
    for (const pugi::xml_node block : node.children("AngleBasisBlock")) {
      const pugi::xml_node bounds = block.child("ThetaBounds");
      if (!bounds) fail(block, "no ThetaBounds");
      const double upper = angle(bounds, "UpperTheta");
      if (!basis.rings.empty() && std::abs(angle(bounds, "LowerTheta") - begin) > kSameAngle)
        fail(bounds, "a ring does not begin where the one before it ends");
      if (!(upper > begin)) fail(bounds, "a ring ends before it begins");
      const std::optional<int64_t> cells = parseInteger(word(block.child("nPhis")));
      if (!cells || *cells < (begin > 0 ? 2 : 1) || *cells > INT32_MAX)
        fail(block, "expected the number of azimuths as nPhis, at least 2 except around the normal");
      basis.rings.push_back({upper, static_cast<size_t>(*cells)});
      basis.cells += static_cast<size_t>(*cells);
      begin = upper;
    }
    if (basis.rings.empty()) fail(node, "an angle basis without blocks");
    if (const AngleBasis* known = klemsBasis(basis.name)) {
      if (known->rings != basis.rings)
        warn(node, fmt::format("the angles differ from those of {}, which are used instead", known->name));
      return;
    }
    for (const AngleBasis& earlier : defined_)
      if (sameWord(earlier.name, basis.name)) return;
    defined_.push_back(std::move(basis));
  }

  // The index in file_.bases of the basis named in the block's child.
  size_t basisOf(pugi::xml_node block, const char* which) {
    const std::string_view name = word(block.child(which));
    if (name.empty()) fail(block, fmt::format("no {}", which));
    for (size_t i = 0; i < file_.bases.size(); ++i)
      if (sameWord(file_.bases[i].name, name)) return i;
    const AngleBasis* basis = klemsBasis(name);
    for (const AngleBasis& own : defined_)
      if (sameWord(own.name, name)) basis = &own;
    if (!basis) fail(block.child(which), fmt::format("undefined {} \"{}\"", which, printable(name)));
    file_.bases.push_back(*basis);
    return file_.bases.size() - 1;
  }

  void readBand(pugi::xml_node band) {
    const std::string_view name = word(band.child("Wavelength"));
    Channel channel;
    if (sameWord(name, "Visible"))
      channel = Channel::y;
    else if (sameWord(name, file_.rank == 0 ? "CIE-X" : "CIE-u"))
      channel = Channel::first;
    else if (sameWord(name, file_.rank == 0 ? "CIE-Z" : "CIE-v"))
      channel = Channel::second;
    else
      return;
    for (const pugi::xml_node block : band.children("WavelengthDataBlock")) {
      const std::optional<BsdfFile::Component> component =
          componentOf(word(block.child("WavelengthDataDirection")));
      if (!component) continue;
      if (file_.rank == 0)
        readMatrix(block, *component, channel);
      else
        readTree(block, *component, channel);
    }
  }

  // Other components, such as absorptance, are ignored.
  static std::optional<BsdfFile::Component> componentOf(std::string_view direction) {
    if (sameWord(direction, "Reflection Back")) return BsdfFile::kReflectionFront;
    if (sameWord(direction, "Reflection Front")) return BsdfFile::kReflectionBack;
    if (sameWord(direction, "Transmission Back")) return BsdfFile::kTransmissionFront;
    if (sameWord(direction, "Transmission Front")) return BsdfFile::kTransmissionBack;
    return {};
  }

  pugi::xml_node scatteringData(pugi::xml_node block) const {
    const pugi::xml_node node = block.child("ScatteringData");
    if (!node) fail(block, "no ScatteringData");
    return node;
  }

  void readMatrix(pugi::xml_node block, BsdfFile::Component component, Channel channel) {
    const size_t incident = basisOf(block, "ColumnAngleBasis"), scattered = basisOf(block, "RowAngleBasis");
    const size_t columns = file_.bases[incident].cells, rows = file_.bases[scattered].cells;
    const pugi::xml_node node = scatteringData(block);
    Data numbers = data(node);
    // Every number takes at least one digit and one separator.
    if (rows > (numbers.left() + 1) / 2 / columns)
      fail(node, fmt::format("fewer numbers than the {} by {} of the angle bases", rows, columns));
    std::vector<float> values(rows * columns);
    for (size_t i = 0; i < values.size(); ++i)
      values[incidentIsRow_ ? i % rows * columns + i / rows : i] = numbers.value();
    if (numbers.next() != '\0')
      warn(node, fmt::format("more numbers than the {} by {} of the angle bases", rows, columns));
    std::optional<BsdfMatrix>& matrix = file_.matrices[component];
    if (!matrix || matrix->incident != incident || matrix->scattered != scattered)
      matrix = BsdfMatrix{incident, scattered, {}, {}, {}};
    (channel == Channel::y       ? matrix->y
     : channel == Channel::first ? matrix->x
                                 : matrix->z) = std::move(values);
  }

  void readTree(pugi::xml_node block, BsdfFile::Component component, Channel channel) {
    const std::string_view basis = word(block.child("AngleBasis"));
    if (!sameWord(basis, "LBNL/Shirley-Chiu"))
      fail(block, fmt::format("expected the AngleBasis LBNL/Shirley-Chiu, got \"{}\"", printable(basis)));
    Data numbers = data(scatteringData(block));
    TensorTree tree = TreeReader(numbers, file_.rank).read();
    std::optional<BsdfTrees>& trees = file_.trees[component];
    if (!trees) trees.emplace();
    (channel == Channel::y ? trees->y : channel == Channel::first ? trees->u : trees->v) = std::move(tree);
  }

  // Removes chromaticity without luminance, and single coordinates of chromaticity, because they do not
  // determine a color.
  void dropIncomplete() {
    for (auto& m : file_.matrices) {
      if (m && m->y.empty()) m.reset();
      if (m && (m->x.empty() || m->z.empty())) m->x = m->z = {};
    }
    for (auto& t : file_.trees) {
      if (t && t->y.nodes.empty()) t.reset();
      if (t && (t->u.nodes.empty() || t->v.nodes.empty())) t->u.nodes = t->v.nodes = {};
    }
  }

  const std::string converted_;  // of a file in UTF-16
  const std::string_view text_, name_;
  const Warn& warn_;
  std::vector<char> buffer_;
  pugi::xml_document document_;
  std::string joined_;
  bool incidentIsRow_ = false;
  std::vector<AngleBasis> defined_;
  BsdfFile file_;
};

}  // namespace

const AngleBasis* klemsBasis(std::string_view name) {
  static const std::array<AngleBasis, 3> bases{
      klems("LBNL/Klems Full",
            {{5, 1}, {15, 8}, {25, 16}, {35, 20}, {45, 24}, {55, 24}, {65, 24}, {75, 16}, {90, 12}}),
      klems("LBNL/Klems Half",
            {{6.5, 1}, {19.5, 8}, {32.5, 12}, {45.5, 16}, {58.5, 20}, {71.5, 12}, {90, 8}}),
      klems("LBNL/Klems Quarter", {{9, 1}, {27, 8}, {45, 12}, {63, 12}, {90, 8}})};
  for (const AngleBasis& basis : bases)
    if (sameWord(basis.name, name)) return &basis;
  return nullptr;
}

BsdfFile BsdfFile::parse(std::string_view text, std::string_view name, const Warn& warn) {
  return BsdfReader(text, name, warn).read();
}

}  // namespace rad
