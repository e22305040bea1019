#include "rad_parser/xform.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "rad_parser/file_path.h"
#include "rad_parser/number.h"

namespace rad {
namespace {

Imath::M44d rotation(int axis, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  Imath::M44d m;
  m[a][a] = m[b][b] = c;
  m[a][b] = s;
  m[b][a] = -s;
  return m;
}

Similarity power(Similarity base, int64_t exponent) {
  Similarity result;
  for (; exponent > 0; exponent >>= 1) {
    if (exponent & 1) result = result * base;
    base = base * base;
  }
  return result;
}

// One transform from the front of the words, without -i. Empty where they are none.
std::optional<Similarity> readStep(std::span<const std::string_view> words, size_t& used) {
  const std::string_view option = words[0];
  double n[3];
  const auto numbers = [&](size_t count) {
    if (words.size() <= count) return false;
    for (size_t i = 0; i < count; ++i) {
      const auto value = parseReal(words[i + 1]);
      if (!value) return false;
      n[i] = *value;
    }
    used = count + 1;
    return true;
  };
  const int axis = option.size() == 3 && option[2] >= 'x' && option[2] <= 'z' ? option[2] - 'x' : -1;
  Similarity step;
  if (option == "-t" && numbers(3)) {
    step.matrix.setTranslation(V3d(n[0], n[1], n[2]));
  } else if (option.starts_with("-r") && axis >= 0 && numbers(1)) {
    step.matrix = rotation(axis, n[0]);
  } else if (option == "-s" && numbers(1) && n[0] != 0) {
    step.matrix.setScale(n[0]);
    step.scale = n[0];
  } else if (option.starts_with("-m") && axis >= 0 && numbers(0)) {
    step.matrix[axis][axis] = -1;
    step.scale = -1;
  } else {
    return {};
  }
  return step;
}

// Whether the type's transform is told to a function file, an instance or a mesh by arguments.
bool carriesTransform(Type type) {
  switch (type) {
    case Type::instance:
    case Type::mesh:
    case Type::texfunc:
    case Type::texdata:
    case Type::plastic2:
    case Type::metal2:
    case Type::trans2:
    case Type::ashik2:
    case Type::plasfunc:
    case Type::metfunc:
    case Type::transfunc:
    case Type::brtdfunc:
    case Type::plasdata:
    case Type::metdata:
    case Type::transdata:
    case Type::bsdf:
    case Type::absdf:
    case Type::wgmdfunc:
    case Type::prism1:
    case Type::prism2:
    case Type::colorfunc:
    case Type::brightfunc:
    case Type::specfunc:
    case Type::colordata:
    case Type::brightdata:
    case Type::specdata:
    case Type::colorpict:
    case Type::specpict:
    case Type::mixfunc:
    case Type::mixdata:
    case Type::mixpict:
      return true;
    default:
      return false;
  }
}

// "a>b" becomes "prefix.a>prefix.b": mist names surfaces, one after the other along the light's way.
std::string prefixSources(std::string_view path, const std::string& prefix) {
  std::string result;
  while (!path.empty()) {
    const size_t length = std::min(path.find('>'), path.size() - 1) + 1;
    result.append(prefix).append(1, '.').append(path.substr(0, length));
    path.remove_prefix(length);
  }
  return result;
}

}  // namespace

V3d Similarity::point(const V3d& p) const {
  return vector(p) + V3d(matrix[3][0], matrix[3][1], matrix[3][2]);
}

V3d Similarity::vector(const V3d& v) const {
  V3d result;
  for (int i = 0; i < 3; ++i) result[i] = v.x * matrix[0][i] + v.y * matrix[1][i] + v.z * matrix[2][i];
  return result;
}

Similarity Similarity::inverse() const {
  // The linear part is scale times an orthogonal matrix, so its inverse is its transpose over the scale
  // squared.
  Similarity result;
  result.scale = 1 / scale;
  const double factor = 1 / (scale * scale);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result.matrix[i][j] = matrix[j][i] * factor;
  const V3d back = result.vector(V3d(matrix[3][0], matrix[3][1], matrix[3][2]));
  for (int i = 0; i < 3; ++i) result.matrix[3][i] = -back[i];
  return result;
}

Similarity operator*(const Similarity& a, const Similarity& b) {
  return {a.matrix * b.matrix, a.scale * b.scale};
}

Similarity readTransform(std::span<const std::string_view> words, size_t& used) {
  Similarity total, repeated;
  int64_t times = 1;
  used = 0;
  while (used < words.size()) {
    const auto rest = words.subspan(used);
    if (rest[0] == "-i" && rest.size() > 1) {
      const auto count = parseInteger(rest[1]);
      if (!count || *count > std::numeric_limits<int32_t>::max()) break;
      total = total * power(repeated, times);
      repeated = {};
      times = *count;
      used += 2;
      continue;
    }
    size_t length = 0;
    const auto step = readStep(rest, length);
    if (!step) break;
    repeated = repeated * *step;
    used += length;
  }
  return total * power(repeated, times);
}

Type Transform::typeOf(Type type) const {
  if (!inverted) return type;
  switch (type) {
    case Type::sphere:
      return Type::bubble;
    case Type::bubble:
      return Type::sphere;
    case Type::cone:
      return Type::cup;
    case Type::cup:
      return Type::cone;
    case Type::cylinder:
      return Type::tube;
    case Type::tube:
      return Type::cylinder;
    default:
      return type;
  }
}

std::string_view Transform::nameOf(Type type, std::string_view written, std::string& buffer) const {
  if (prefix.empty() || !isSurface(type)) return written;
  buffer.assign(prefix).append(1, '.').append(written);
  return buffer;
}

void Transform::apply(Primitive& p, DescriptionBuilder& builder) const {
  Description& d = builder.description();
  const std::span<double> x = std::span(d.realArgs).subspan(p.firstReal, p.reals);
  const double length = std::abs(similarity.scale);
  const auto refuse = [&](std::string_view why) {
    return builder.error(p.place, fmt::format("{} \"{}\": {}", typeName(p.type), printable(d.name(p)), why));
  };
  const auto need = [&](size_t reals) {
    if (p.strings != 0 || x.size() != reals)
      throw refuse(fmt::format("xform needs no string and {} real arguments, not {} and {}", reals, p.strings,
                               x.size()));
  };
  const auto movePoint = [&](size_t i) {
    const V3d q = similarity.point(V3d(x[i], x[i + 1], x[i + 2]));
    for (int k = 0; k < 3; ++k) x[i + k] = q[k];
  };
  const auto turnVector = [&](size_t i, double sign = 1) {
    const V3d q = similarity.vector(V3d(x[i], x[i + 1], x[i + 2])) * sign;
    for (int k = 0; k < 3; ++k) x[i + k] = q[k];
  };
  // Transmission per unit length.
  const auto absorb = [&](size_t i) {
    for (size_t k = i; k < i + 3; ++k) x[k] = std::pow(x[k], 1 / length);
  };

  switch (p.type) {
    case Type::source:
      need(4);
      turnVector(0);
      break;
    case Type::sphere:
    case Type::bubble:
      need(4);
      movePoint(0);
      x[3] *= length;
      break;
    case Type::polygon:
      if (p.strings != 0 || x.size() % 3 != 0)
        throw refuse(fmt::format("{} string and {} real arguments are no vertices", p.strings, x.size()));
      for (size_t i = 0; i < x.size(); i += 3) movePoint(i);
      if (reversed)
        for (size_t i = 0, j = x.size(); i + 3 < j; i += 3) {
          j -= 3;
          std::swap_ranges(x.begin() + i, x.begin() + i + 3, x.begin() + j);
        }
      break;
    case Type::cone:
    case Type::cup:
      need(8);
      movePoint(0);
      movePoint(3);
      x[6] *= length;
      x[7] *= length;
      break;
    case Type::cylinder:
    case Type::tube:
      need(7);
      movePoint(0);
      movePoint(3);
      x[6] *= length;
      break;
    case Type::ring:
      need(8);
      movePoint(0);
      turnVector(3, inverted ? -1 : 1);
      x[6] *= length;
      x[7] *= length;
      break;
    case Type::glow:
      need(4);
      x[3] *= length;
      break;
    case Type::spotlight:
      need(7);
      turnVector(4);
      break;
    case Type::dielectric:
      need(5);
      absorb(0);
      break;
    case Type::interface:
      need(8);
      absorb(0);
      absorb(4);
      break;
    case Type::mist:
      if (x.size() > 7) throw refuse(fmt::format("xform needs at most 7 real arguments, not {}", x.size()));
      for (size_t i = 0; i < 3 && x.size() > 2; ++i) x[i] /= length;
      for (uint32_t i = 0; i < p.strings && !prefix.empty(); ++i)
        d.stringArgs[p.firstString + i] = builder.intern(prefixSources(d.string(p, i), prefix));
      break;
    case Type::brighttext:
    case Type::colortext:
    case Type::mixtext:
      if (x.size() < 9) throw refuse(fmt::format("xform needs 9 real arguments, not {}", x.size()));
      movePoint(0);
      turnVector(3);
      turnVector(6);
      break;
    default:
      if (carriesTransform(p.type))
        for (const std::string& argument : arguments) builder.addString(p, argument);
      return;
  }
  for (const double value : x)
    if (!std::isfinite(value)) throw refuse("transformed arguments are no finite numbers");
}

Transform within(const Transform& outer, const Transform& inner) {
  Transform both;
  both.similarity = inner.similarity * outer.similarity;
  both.reversed = inner.reversed != outer.reversed;
  both.inverted = inner.inverted != outer.inverted;
  both.prefix = outer.prefix;
  if (!outer.prefix.empty() && !inner.prefix.empty()) both.prefix += '.';
  both.prefix += inner.prefix;
  both.modifier = outer.modifier ? outer.modifier : inner.modifier;
  both.arguments = inner.arguments;
  both.arguments.insert(both.arguments.end(), outer.arguments.begin(), outer.arguments.end());
  return both;
}

std::optional<std::vector<std::string>> plainWords(std::string_view command) {
  std::vector<std::string> words;
  std::string word;
  bool inWord = false;
  for (size_t i = 0; i <= command.size(); ++i) {
    const char c = i < command.size() ? command[i] : ' ';
    if (c == '\\' && i + 1 < command.size() && command[i + 1] == '\n') {
      ++i;
    } else if (c == ' ' || c == '\t' || c == '\n' || (c == '#' && !inWord)) {
      // A line end that was not escaped would begin another command, but command lines hold none.
      if (inWord) words.push_back(word);
      word.clear();
      inWord = false;
      if (c == '#') break;
    } else if (c == '"' || c == '\'') {
      const size_t close = command.find(c, i + 1);
      if (close == command.npos) return {};
      const std::string_view quoted = command.substr(i + 1, close - i - 1);
      if (c == '"' && quoted.find_first_of("$`\\") != quoted.npos) return {};
      word += quoted;
      inWord = true;
      i = close;
    } else if (std::strchr("|&;<>()$`\\*?[]{}!", c)) {
      return {};
    } else {
      word += c;
      inWord = true;
    }
  }
  return words;
}

namespace {

XformFault fault(std::string_view text) { return XformFault(fmt::format("xform: {}", text)); }

// One line of an argument file as words. Quotes and a backslash count at the begin of a word only, as xform
// has it.
std::vector<std::string> argumentWords(std::string_view line) {
  constexpr std::string_view kSpace = " \t\n\v\f\r";
  if (line.starts_with('!')) line.remove_prefix(1);
  if (line.starts_with("xform ")) line.remove_prefix(6);
  std::vector<std::string> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
    if (line.starts_with("\\\n")) {
      line.remove_prefix(2);
      continue;
    }
    if (line.empty()) return words;
    size_t begin = 0, end, next;
    if (line[0] == '"' || line[0] == '\'') {
      begin = 1;
      end = std::min(line.find(line[0], 1), line.size());
      next = std::min(end + 1, line.size());
    } else {
      begin = line[0] == '\\' && line.size() > 1;
      next = end = std::min(line.find_first_of(kSpace, begin), line.size());
    }
    words.emplace_back(line.substr(begin, end - begin));
    line.remove_prefix(next);
  }
}

// The lines of an argument file that hold arguments.
std::vector<std::vector<std::string>> readArgumentFile(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> lines;
  std::string line, part;
  while (std::getline(file, part)) {
    if (part.ends_with('\r')) part.pop_back();
    line += part;
    if (line.ends_with('\\')) {
      line += '\n';
      continue;
    }
    if (!line.empty() && line[0] != '#') lines.push_back(argumentWords(line));
    line.clear();
  }
  if (!line.empty() && line[0] != '#') lines.push_back(argumentWords(line));
  if (!file.eof())
    throw XformFault(
        fmt::format("xform: cannot read argument file \"{}\": {}", printable(name), std::strerror(errno)),
        Status::system);
  if (lines.empty()) throw fault(fmt::format("empty argument file \"{}\"", printable(name)));
  return lines;
}

class Passes {
 public:
  Passes(const std::string& directory, const FileAccess& access,
         const std::function<void(const XformPass&)>& pass)
      : directory_(directory), access_(access), pass_(pass) {}

  void run(const std::vector<std::string>& words, int nested) {
    if (nested > kDeepest) throw fault("argument files within each other without end");
    for (size_t i = 1; i < words.size(); ++i)
      if (words[i] == "-f") return fromFile(words, i, nested);
    for (size_t i = 1; i < words.size(); ++i)
      if (words[i] == "-a") return array(words, i, nested);
    if (++done_ > kMostPasses) throw fault(fmt::format("more than {} copies", kMostPasses));
    single(words);
  }

 private:
  static constexpr int kDeepest = 32;  // -f files and arrays within each other

  void fromFile(const std::vector<std::string>& words, size_t at, int nested) {
    if (at + 1 == words.size() || (words[at + 1].starts_with('-') && words[at + 1] != "-"))
      throw fault("missing file for -f");
    if (words[at + 1] == "-") throw fault("-f - would read standard input, which a scene must not");
    int k = 0;
    const std::string path = joinPath(directory_, words[at + 1]);
    if (!access_.allows(path))
      throw XformFault(fmt::format("xform: cannot read argument file \"{}\"{}", printable(words[at + 1]),
                                   access_.remark()),
                       Status::system);
    for (const auto& line : readArgumentFile(path, words[at + 1])) {
      std::vector<std::string> longer(words.begin(), words.begin() + at);
      longer.insert(longer.end(), line.begin(), line.end());
      longer.insert(longer.end(), words.begin() + at + 2, words.end());
      bool named = false;
      for (size_t i = 1; i + 1 < longer.size() && !named; ++i)
        if (longer[i] == "-n") {
          longer[i + 1] += fmt::format(".{}", k);
          named = true;
        }
      if (!named) longer.insert(longer.begin() + 1, {"-n", fmt::format("i{}", k)});
      run(longer, nested + 1);
      ++k;
    }
  }

  void array(const std::vector<std::string>& words, size_t at, int nested) {
    const auto count = at + 1 < words.size() ? parseInteger(words[at + 1]) : std::nullopt;
    if (!count || *count <= 0) throw fault("missing count for -a");
    if (*count > kMostPasses) throw fault(fmt::format("more than {} copies", kMostPasses));
    // All names of a command with several become that of its last, numbered.
    std::optional<std::string> name;
    for (size_t i = 1; i + 1 < words.size(); ++i)
      if (words[i] == "-n") name = words[i + 1];
    for (int64_t k = 0; k < *count; ++k) {
      std::vector<std::string> element = words;
      element[at] = "-i";
      element[at + 1] = fmt::format("{}", k);
      for (size_t i = 1; name && i + 1 < words.size(); ++i)
        if (words[i] == "-n") element[i + 1] = fmt::format("{}.{}", *name, k);
      if (!name) element.insert(element.begin() + 1, {"-n", fmt::format("a{}", k)});
      run(element, nested + 1);
    }
  }

  void single(const std::vector<std::string>& words) {
    XformPass pass;
    Transform& t = pass.transform;
    size_t i = 1;
    for (; i < words.size(); ++i) {
      const std::string& option = words[i];
      const bool hasValue = i + 1 < words.size();
      if (option == "-m" && hasValue) {
        if (!t.modifier) t.modifier = words[i + 1];
        ++i;
      } else if (option == "-n" && hasValue) {
        if (!t.prefix.empty()) t.prefix += '.';
        t.prefix += words[++i];
      } else if (option == "-c" || option == "-e") {
        pass.changesDirectory = option == "-e";
      } else if (option == "-I") {
        t.inverted = !t.inverted;
      } else {
        break;
      }
    }
    const std::vector<std::string_view> rest(words.begin() + i, words.end());
    size_t used = 0;
    t.similarity = readTransform(rest, used);
    t.reversed = (t.similarity.scale < 0) != t.inverted;
    if (used > 0 && rest[0] != "-i") t.arguments = {"-i", "1"};  // ends an -i of the file's own arguments
    t.arguments.insert(t.arguments.end(), rest.begin(), rest.begin() + used);
    if (used < rest.size() && rest[used].starts_with('-'))
      throw fault(fmt::format("bad option or argument at \"{}\"", printable(rest[used])));
    if (used == rest.size())
      throw fault("no file named: it would read standard input, which a scene must not");
    pass.files.assign(rest.begin() + used, rest.end());
    pass_(pass);
  }

  const std::string& directory_;
  const FileAccess& access_;
  const std::function<void(const XformPass&)>& pass_;
  int64_t done_ = 0;
};

}  // namespace

void forEachPass(std::span<const std::string> words, const std::string& directory, const FileAccess& access,
                 const std::function<void(const XformPass&)>& pass) {
  Passes(directory, access, pass).run({words.begin(), words.end()}, 0);
}

}  // namespace rad
