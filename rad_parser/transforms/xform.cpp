#include "rad_parser/transforms/xform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "rad_parser/number.h"
#include "rad_parser/printable.h"

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

// The transform at the beginning of the words, other than -i. Empty if they begin with none.
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

// Converts "a>b" to "prefix.a>prefix.b". Mist lists surfaces in the order in which light hits them.
std::string prefixSources(std::string_view path, const std::string& prefix) {
  std::string result;
  while (!path.empty()) {
    const size_t length = std::min(path.find('>'), path.size() - 1) + 1;
    result.append(prefix).append(1, '.').append(path.substr(0, length));
    path.remove_prefix(length);
  }
  return result;
}

// Whether the function file, data, picture, octree or mesh of this type is transformed, by xform options
// after the string arguments.
bool hasTransform(Type type) {
  static_assert(kTypes == 59, "Does a new type have a transform?");
  const auto isWithin = [type](Type first, Type last) { return first <= type && type <= last; };
  return isWithin(Type::instance, Type::mesh) || isWithin(Type::prism1, Type::prism2) ||
         isWithin(Type::plastic2, Type::ashik2) || isWithin(Type::plasfunc, Type::wgmdfunc) ||
         isWithin(Type::texfunc, Type::colorpict) || type == Type::specpict ||
         isWithin(Type::mixfunc, Type::mixpict);
}

// Applies a transform to the arguments of one primitive.
class ArgumentTransform {
 public:
  ArgumentTransform(const Transform& transform, Primitive& p, DescriptionBuilder& builder)
      : transform_(transform),
        p_(p),
        builder_(builder),
        length_(std::abs(transform.similarity.scale)),
        reals_(builder.description().reals(p)) {}

  void apply() {
    if (!arguments()) return;
    for (const double value : reals_)
      if (!std::isfinite(value)) throw error("transformed arguments are not finite numbers");
  }

 private:
  using Indices = std::initializer_list<size_t>;

  // Transforms the arguments according to their meaning. Returns whether numbers have changed.
  bool arguments() {
    switch (p_.type) {
      case Type::source: return moved(4, {}, {}, {0});
      case Type::sphere:
      case Type::bubble: return moved(4, {0}, {3});
      case Type::polygon: polygon(); return true;
      case Type::cone:
      case Type::cup: return moved(8, {0, 3}, {6, 7});
      case Type::cylinder:
      case Type::tube: return moved(7, {0, 3}, {6});
      case Type::ring:
        moved(8, {0}, {6, 7});
        turnVector(3, transform_.inverted ? -1 : 1);
        return true;
      case Type::glow: return moved(4, {}, {3});
      case Type::spotlight: return moved(7, {}, {}, {4});
      case Type::dielectric: return moved(5, {}, {}, {}, {0});
      case Type::interface: return moved(8, {}, {}, {}, {0, 4});
      case Type::mist: mist(); return true;
      case Type::brighttext:
      case Type::colortext:
      case Type::mixtext:
        if (reals_.size() < 9)
          throw error(fmt::format("xform needs 9 real arguments, not {}", reals_.size()));
        movePoint(0);
        turnVector(3);
        turnVector(6);
        return true;
      default: break;
    }
    if (hasTransform(p_.type))
      for (const std::string& argument : transform_.arguments) builder_.addString(p_, argument);
    return false;
  }

  // Transforms `count` real arguments, of which these are the first of points, lengths, directions and
  // transmissions.
  bool moved(size_t count, Indices points, Indices lengths, Indices directions = {},
             Indices transmissions = {}) {
    need(count);
    for (const size_t i : points) movePoint(i);
    for (const size_t i : lengths) scaleLength(i);
    for (const size_t i : directions) turnVector(i);
    for (const size_t i : transmissions) absorb(i);
    return true;
  }

  void polygon() {
    if (p_.strings != 0 || reals_.size() % 3 != 0)
      throw error(
          fmt::format("{} string and {} real arguments do not form vertices", p_.strings, reals_.size()));
    for (size_t i = 0; i < reals_.size(); i += 3) movePoint(i);
    if (!transform_.reversed) return;
    for (size_t i = 0, j = reals_.size(); i + 3 < j; i += 3) {
      j -= 3;
      std::swap_ranges(reals_.begin() + i, reals_.begin() + i + 3, reals_.begin() + j);
    }
  }

  void mist() {
    if (reals_.size() > 7)
      throw error(fmt::format("xform needs at most 7 real arguments, not {}", reals_.size()));
    for (size_t i = 0; i < 3 && reals_.size() > 2; ++i) reals_[i] /= length_;
    Description& d = builder_.description();
    for (uint32_t i = 0; i < p_.strings && !transform_.prefix.empty(); ++i)
      d.stringArgs[p_.firstString + i] = builder_.intern(prefixSources(d.string(p_, i), transform_.prefix));
  }

  void need(size_t reals) const {
    if (p_.strings != 0 || reals_.size() != reals)
      throw error(fmt::format("xform needs no string and {} real arguments, not {} and {}", reals, p_.strings,
                              reals_.size()));
  }

  V3d at(size_t i) const { return {reals_[i], reals_[i + 1], reals_[i + 2]}; }
  void set(size_t i, const V3d& v) {
    for (int k = 0; k < 3; ++k) reals_[i + k] = v[k];
  }
  void movePoint(size_t i) { set(i, transform_.similarity.point(at(i))); }
  void turnVector(size_t i, double sign = 1) { set(i, transform_.similarity.vector(at(i)) * sign); }
  void scaleLength(size_t i) { reals_[i] *= length_; }
  // Three values of transmission per unit length.
  void absorb(size_t i) {
    for (size_t k = i; k < i + 3; ++k) reals_[k] = std::pow(reals_[k], 1 / length_);
  }

  Error error(std::string_view why) const {
    return builder_.error(p_.place, fmt::format("{} \"{}\": {}", typeName(p_.type), printable(p_.name), why));
  }

  const Transform& transform_;
  Primitive& p_;
  DescriptionBuilder& builder_;
  double length_;
  std::span<double> reals_;
};

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
  // The linear part is the scale times an orthogonal matrix, so its inverse is its transpose divided by the
  // square of the scale.
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
  static_assert(static_cast<int>(Type::mesh) == 10, "If a new surface has an inside, its type belongs here.");
  if (!inverted) return type;
  switch (type) {
    case Type::sphere: return Type::bubble;
    case Type::bubble: return Type::sphere;
    case Type::cone: return Type::cup;
    case Type::cup: return Type::cone;
    case Type::cylinder: return Type::tube;
    case Type::tube: return Type::cylinder;
    default: return type;
  }
}

std::string_view Transform::nameOf(Type type, std::string_view written, std::string& buffer) const {
  if (prefix.empty() || !isSurface(type)) return written;
  buffer.assign(prefix).append(1, '.').append(written);
  return buffer;
}

void Transform::apply(Primitive& p, DescriptionBuilder& builder) const {
  ArgumentTransform(*this, p, builder).apply();
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

}  // namespace rad
