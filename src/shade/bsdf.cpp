#include "shade/bsdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "base/colorimetry.h"
#include "base/constants.h"
#include "base/primaries.h"

namespace rsphere {
namespace {

using rad::BsdfFile;

constexpr double kBelowOne = 1 - 0x1p-53;

// ---- color

// CIE 1976 u', v'.
Tristimulus ofChromaticity(double y, double u, double v) {
  if (!(v > 0)) return {y, y, y};
  return {y * 9 * u / (4 * v), y, y * (12 - 3 * u - 20 * v) / (4 * v)};
}

// ---- the diffuse part

// Limits (1/sr) of the diffuse part that is separated from the data. Below the first value, a diffuse
// calculation would not be worth its cost. The second value is an upper limit for gray trees only.
constexpr double kLeastDiffuse = .01 / kPi;
constexpr double kMostDiffuseTree = 1.5 / kPi;

// The channel-wise minimum of several colors. Sharpened sensors (kSharpFromXyz) distort it least. As in
// RADIANCE, it is the diffuse part of colored data.
class Smallest {
 public:
  void add(const Tristimulus& c) {
    y_ = std::min(y_, c.y);
    const V3d sharp = c * kSharpFromXyz;
    for (int i = 0; i < 3; ++i) sharp_[i] = std::min(sharp_[i], sharp[i]);
  }
  void addGrey(double y) { y_ = std::min(y_, y); }
  // 1/sr; 0 if it is negligible.
  Tristimulus grey() const { return kept(Tristimulus(y_)); }
  Tristimulus colored() const { return kept(sharp_ * kXyzFromSharp); }

 private:
  static Tristimulus kept(const Tristimulus& c) {
    return c.y > kLeastDiffuse && c.y < std::numeric_limits<float>::max() ? c : Tristimulus(0);
  }
  double y_ = std::numeric_limits<float>::max();
  V3d sharp_{y_, y_, y_};
};

// ---- matrices

struct Rings {
  struct Ring {
    double lowerSquare, upperCosine, upperSquare;  // cosines at its lower and upper angle, and their squares
    size_t first, cells;
    double projectedSolidAngle;  // of a cell
  };
  std::vector<Ring> rings;
  size_t cells = 0;

  explicit Rings(const rad::AngleBasis& basis) {
    double lower = 1;
    for (const auto& ring : basis.rings) {
      const double cosine = ring.upper >= 90 ? 0 : std::cos(ring.upper * (kPi / 180));
      const double square = cosine * cosine;
      rings.push_back({lower, cosine, square, cells, ring.cells,
                       kPi * (lower - square) / static_cast<double>(ring.cells)});
      cells += ring.cells;
      lower = square;
    }
  }

  const Ring& ringOf(size_t cell) const {
    return *std::ranges::find_if(rings, [&](const Ring& r) { return cell < r.first + r.cells; });
  }

  // The cell of a direction; empty beyond the last ring.
  std::optional<size_t> cellOf(double x, double y, double z) const {
    for (const Ring& ring : rings) {
      if (z <= ring.upperCosine) continue;
      const double turns = std::atan2(y, x) / (2 * kPi);
      const auto n = static_cast<double>(ring.cells);
      const double k = std::floor((turns < 0 ? turns + 1 : turns) * n + .5);
      return ring.first + (k >= n ? 0 : static_cast<size_t>(k));
    }
    return {};
  }

  // A direction within a cell, uniform by projected solid angle.
  V3d within(size_t cell, double u1, double u2) const {
    const Ring& ring = ringOf(cell);
    const double square = (1 - u1) * ring.lowerSquare + u1 * ring.upperSquare;
    const double angle =
        2 * kPi * (static_cast<double>(cell - ring.first) + u2 - .5) / static_cast<double>(ring.cells);
    const double sine = std::sqrt(1 - square);
    return V3d(std::cos(angle) * sine, std::sin(angle) * sine, std::sqrt(square));
  }
};

class MatrixScattering final : public DirectedScattering {
 public:
  MatrixScattering(const rad::BsdfMatrix& matrix, const std::vector<rad::AngleBasis>& bases,
                   bool incidentFront, bool scatteredFront, Tristimulus& diffuse)
      : DirectedScattering(incidentFront, scatteredFront),
        in_(bases[matrix.incident]),
        out_(bases[matrix.scattered]),
        x_(matrix.x),
        y_(matrix.y),
        z_(matrix.z) {
    const bool colored = !x_.empty();
    Smallest smallest;
    for (size_t i = 0; i < y_.size(); ++i) {
      if (colored)
        smallest.add({x_[i], y_[i], z_[i]});
      else
        smallest.addGrey(y_[i]);
    }
    diffuse = colored ? smallest.colored() : smallest.grey();
    const auto subtract = [](std::vector<float>& from, double value) {
      for (float& f : from) f = std::max(0.F, static_cast<float>(f - value));
    };
    subtract(x_, diffuse.x);
    subtract(y_, diffuse.y);
    subtract(z_, diffuse.z);
    straight_ = Table(in_.cells, out_, [&](size_t i, size_t o) { return y_[o * in_.cells + i]; });
    for (size_t i = 0; i < in_.cells; ++i) largestAlbedo_ = std::max(largestAlbedo_, straight_.total(i));
    finestCell_ = kPi;
    for (const Rings* basis : {&in_, &out_})
      for (const auto& ring : basis->rings) finestCell_ = std::min(finestCell_, ring.projectedSolidAngle);
  }

  bool prepareTurned() override {
    turned_ = Table(out_.cells, in_, [&](size_t o, size_t i) { return y_[o * in_.cells + i]; });
    return true;
  }

  Cell cell(const V3d& view, const V3d& other) const override {
    const bool swap = turned(view);
    const V3d& from = swap ? other : view;
    const V3d& to = swap ? view : other;
    const auto i = incidentCell(from), o = scatteredCell(to);
    if (!i || !o) return {};
    const size_t at = *o * in_.cells + *i;
    const double y = y_[at];
    return {x_.empty() ? Tristimulus(y) : Tristimulus(x_[at], y, z_[at]),
            std::min(in_.ringOf(*i).projectedSolidAngle, out_.ringOf(*o).projectedSolidAngle), at};
  }

  double albedo(const V3d& view) const override {
    const auto row = turned(view) ? scatteredCell(view) : incidentCell(view);
    return row ? (turned(view) ? turned_ : straight_).total(*row) : 0;
  }

  V3d sample(const V3d& view, double u1, double u2) const override {
    const bool swap = turned(view);
    const size_t row = *(swap ? scatteredCell(view) : incidentCell(view));
    const size_t cell = (swap ? turned_ : straight_).sample(row, u1);
    V3d d = (swap ? in_ : out_).within(cell, u1, u2);
    if (swap) d = V3d(-d.x, -d.y, d.z);
    if ((view.z > 0) == transmits()) d.z = -d.z;
    return d;
  }

  Resolution resolution(const V3d& view) const override {
    const bool swap = turned(view);
    const auto cell = swap ? scatteredCell(view) : incidentCell(view);
    if (!cell) return {};
    const double angle = (swap ? out_ : in_).ringOf(*cell).projectedSolidAngle;
    return {angle, angle};
  }

 private:
  // Cumulative sums of albedo over the cells of each row.
  class Table {
   public:
    Table() = default;
    template <class Value>
    Table(size_t rows, const Rings& basis, Value value) : cells_(basis.cells) {
      sums_.reserve(rows * cells_);
      for (size_t row = 0; row < rows; ++row) {
        double sum = 0;
        for (const Rings::Ring& ring : basis.rings)
          for (size_t k = 0; k < ring.cells; ++k) {
            sum += value(row, ring.first + k) * ring.projectedSolidAngle;
            sums_.push_back(static_cast<float>(sum));
          }
      }
    }
    double total(size_t row) const { return sums_[(row + 1) * cells_ - 1]; }
    // Selects a cell by a uniform u, and sets u to a uniform number for use within the cell.
    size_t sample(size_t row, double& u) const {
      const auto sums = std::span(sums_).subspan(row * cells_, cells_);
      const double target = u * sums.back();
      auto found = static_cast<size_t>(std::ranges::upper_bound(sums, target) - sums.begin());
      // Rounding may select a cell after the last one that is not black.
      if (found == cells_)
        found = static_cast<size_t>(std::ranges::lower_bound(sums, sums.back()) - sums.begin());
      const double before = found == 0 ? 0 : sums[found - 1];
      u = std::clamp((target - before) / (sums[found] - before), 0., kBelowOne);
      return found;
    }

   private:
    size_t cells_ = 0;
    std::vector<float> sums_;
  };

  // The incident direction of the data is that in which light travels: undeflected transmitted light has the
  // same azimuth on both sides.
  std::optional<size_t> incidentCell(const V3d& d) const { return in_.cellOf(-d.x, -d.y, std::abs(d.z)); }
  std::optional<size_t> scatteredCell(const V3d& d) const { return out_.cellOf(d.x, d.y, std::abs(d.z)); }

  Rings in_, out_;
  std::vector<float> x_, y_, z_;
  Table straight_, turned_;
};

// ---- tensor trees

// An area-preserving map from the unit disk to the square [0, 1)^2. Applied to x and y of unit vectors, it
// preserves ratios of projected solid angles.
std::array<double, 2> squareOfDisk(double x, double y) {
  const double r = std::sqrt(x * x + y * y);
  double a = 0, b = 0;
  if (std::abs(x) > std::abs(y)) {
    a = std::copysign(r, x);
    b = a * std::atan(y / x) * (4 / kPi);
  } else if (y != 0) {
    b = std::copysign(r, y);
    a = b * std::atan(x / y) * (4 / kPi);
  }
  return {std::clamp((a + 1) / 2, 0., kBelowOne), std::clamp((b + 1) / 2, 0., kBelowOne)};
}

V3d diskOfSquare(double sx, double sy) {
  const double a = 2 * sx - 1, b = 2 * sy - 1;
  double x = 0, y = 0;
  if (std::abs(a) > std::abs(b)) {
    x = a * std::cos(kPi / 4 * (b / a));
    y = a * std::sin(kPi / 4 * (b / a));
  } else if (b != 0) {
    x = b * std::sin(kPi / 4 * (a / b));
    y = b * std::cos(kPi / 4 * (a / b));
  }
  return V3d(x, y, std::sqrt(std::max(0., 1 - x * x - y * y)));
}

using Coordinates = std::array<double, 4>;

struct Leaf {
  uint32_t node = 0;
  int depth = 0;
};

// The part of a cell that contains p, a bit for each of `rank` dimensions. p becomes relative to that part.
uint32_t descend(Coordinates& p, int rank) {
  uint32_t part = 0;
  for (int i = 0; i < rank; ++i) {
    p[i] *= 2;
    if (p[i] >= 1) {
      part |= 1U << i;
      p[i] -= 1;
    }
  }
  return part;
}

// The leaf that contains a point. p: as many coordinates in [0, 1) as the rank of the tree.
Leaf find(const rad::TensorTree& tree, int rank, Coordinates p) {
  Leaf leaf;
  while (const uint32_t children = tree.nodes[leaf.node].children) {
    leaf.node = children + descend(p, rank);
    ++leaf.depth;
  }
  return leaf;
}

// Means of a tree over two of its dimensions, as functions of the others. Each branch of the tree gets a tree
// over the other dimensions, with means as leaves. In total they have about a third as many nodes as the tree
// has leaves, because each level needs a quarter of the nodes of the level below. Rejected alternative:
// cumulative sums for each cell of view directions, made at first use, because they need a lock and a limit
// on memory.
class Means {
 public:
  Means() = default;
  // drawFirst: whether directions are sampled in the first two dimensions, otherwise in the last two.
  Means(const rad::TensorTree& tree, int rank, bool drawFirst)
      : tree_(&tree), rank_(rank), given_(rank - 2), drawFirst_(drawFirst) {
    roots_.resize(tree.nodes.size() >> rank);
    if (tree.nodes[0].children != 0) build(0, 0);
  }

  struct Mean {
    double value;
    int finest, coarsest;  // depths of the smallest and the largest cells
  };
  // given: the coordinates in the dimensions that are not sampled.
  Mean at(const Coordinates& given) const { return mean(refer(0, 0), given); }
  double largest() const {
    const Reference root = refer(0, 0);
    return root.node == 0 ? root.value : largestBelow(root.node);
  }

  // A point in the two sampled dimensions, with a density proportional to the tree's values (hierarchical
  // warping: McCool and Harwood 1997).
  std::array<double, 2> draw(Coordinates given, double u1, double u2) const {
    uint32_t node = 0;
    double x = 0, y = 0, width = 1;
    int depth = 0;
    while (const uint32_t children = tree_->nodes[node].children) {
      const uint32_t quadrant = descend(given, given_);
      ++depth;
      std::array<double, 4> masses{};
      for (uint32_t drawn = 0; drawn < 4; ++drawn)
        masses[drawn] = mean(refer(children + child(quadrant, drawn), depth), given).value;
      const bool right = choose(masses[0] + masses[2], masses[1] + masses[3], u1);
      const bool top = choose(masses[right], masses[2 + right], u2);
      node = children + child(quadrant, static_cast<uint32_t>(right) + 2 * static_cast<uint32_t>(top));
      width /= 2;
      if (right) x += width;
      if (top) y += width;
    }
    return {x + width * u1, y + width * u2};
  }

 private:
  struct Node {
    float mean = 0;
    uint32_t children = 0;
    uint8_t finest = 0, coarsest = 0;
  };
  // A constant mean, or a node of these trees.
  struct Reference {
    uint32_t node = 0;  // 0: a constant; the first node is unused
    float value = 0;
    int depth = 0;
  };

  uint32_t child(uint32_t given, uint32_t drawn) const {
    return drawFirst_ ? drawn | given << 2 : given | drawn << given_;
  }

  // Selects the second half with probability proportional to its mass. Rescales u, which is then uniform
  // again.
  static bool choose(double first, double second, double& u) {
    const double target = u * (first + second);
    const bool taken = target >= first && second > 0;
    const double mass = taken ? second : first;
    if (mass > 0) u = std::clamp((taken ? target - first : target) / mass, 0., kBelowOne);
    return taken;
  }

  Reference refer(uint32_t treeNode, int depth) const {
    const auto& n = tree_->nodes[treeNode];
    if (n.children == 0) return {0, n.value, depth};
    return {roots_[(n.children - 1) >> rank_], 0, depth};
  }

  Mean mean(Reference r, Coordinates given) const {
    if (r.node == 0) return {r.value, r.depth, r.depth};
    const Node* n = &nodes_[r.node];
    while (n->children != 0) n = &nodes_[n->children + descend(given, given_)];
    return {n->mean, n->finest, n->coarsest};
  }

  float largestBelow(uint32_t node) const {
    const Node& n = nodes_[node];
    if (n.children == 0) return n.mean;
    float most = 0;
    for (uint32_t q = 0; q < 1U << given_; ++q) most = std::max(most, largestBelow(n.children + q));
    return most;
  }

  uint32_t addNodes(size_t count) {
    const auto first = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + count);
    return first;
  }

  void build(uint32_t treeNode, int depth) {
    const uint32_t children = tree_->nodes[treeNode].children;
    for (uint32_t i = 0; i < 1U << rank_; ++i)
      if (tree_->nodes[children + i].children != 0) build(children + i, depth + 1);
    const uint32_t root = addNodes(1), quadrants = addNodes(size_t{1} << given_);
    nodes_[root].children = quadrants;
    for (uint32_t q = 0; q < 1U << given_; ++q) {
      std::array<Reference, 4> parts;
      for (uint32_t drawn = 0; drawn < 4; ++drawn)
        parts[drawn] = refer(children + child(q, drawn), depth + 1);
      average(parts, quadrants + q);
    }
    roots_[(children - 1) >> rank_] = root;
  }

  void average(const std::array<Reference, 4>& parts, uint32_t into) {
    const auto constant = [&](const Reference& r) { return r.node == 0 || nodes_[r.node].children == 0; };
    if (std::ranges::all_of(parts, constant)) {
      Node& n = nodes_[into];
      double sum = 0;
      n.coarsest = UINT8_MAX;
      for (const Reference& r : parts) {
        const Mean m = mean(r, {});
        sum += m.value;
        n.finest = std::max(n.finest, static_cast<uint8_t>(m.finest));
        n.coarsest = std::min(n.coarsest, static_cast<uint8_t>(m.coarsest));
      }
      n.mean = static_cast<float>(sum / 4);
      return;
    }
    const uint32_t children = addNodes(size_t{1} << given_);
    nodes_[into].children = children;
    for (uint32_t q = 0; q < 1U << given_; ++q) {
      std::array<Reference, 4> below = parts;
      for (Reference& r : below)
        if (!constant(r)) r.node = nodes_[r.node].children + q;
      average(below, children + q);
    }
  }

  const rad::TensorTree* tree_ = nullptr;
  int rank_ = 0, given_ = 0;
  bool drawFirst_ = false;
  std::vector<Node> nodes_{1};
  // Nodes for the branches of the tree, whose children are groups of 2^rank. A branch with the first child c
  // has the index (c - 1) / 2^rank.
  std::vector<uint32_t> roots_;
};

class TreeScattering final : public DirectedScattering {
 public:
  TreeScattering(const rad::BsdfTrees& trees, int rank, bool incidentFront, bool scatteredFront,
                 Tristimulus& diffuse)
      : DirectedScattering(incidentFront, scatteredFront), trees_(trees), rank_(rank) {
    const bool colored = !trees.u.nodes.empty();
    Smallest smallest;
    collect(smallest, colored, 0, 0, 0, true);
    diffuse = colored ? smallest.colored() : smallest.grey();
    if (!colored && diffuse.y >= kMostDiffuseTree) diffuse = Tristimulus(0);
    diffuse_ = diffuse;
    for (auto& node : trees_.y.nodes) node.value = std::max(0.F, static_cast<float>(node.value - diffuse.y));
    straight_ = Means(trees_.y, rank, false);
    largestAlbedo_ = kPi * straight_.largest();
    finestCell_ = cellSize(deepest(trees_.y, 0));
  }

  bool prepareTurned() override {
    if (rank_ == 4) turned_ = Means(trees_.y, rank_, true);
    return rank_ == 4;
  }

  Cell cell(const V3d& view, const V3d& other) const override {
    const bool swap = turned(view);
    const Coordinates p = point(swap ? other : view, swap ? view : other);
    const Leaf leaf = find(trees_.y, rank_, p);
    const double y = trees_.y.nodes[leaf.node].value;
    Tristimulus value(y);
    if (y > 0 && !trees_.u.nodes.empty()) {
      const double u = trees_.u.nodes[find(trees_.u, rank_, p).node].value;
      const double v = trees_.v.nodes[find(trees_.v, rank_, p).node].value;
      value = ofChromaticity(y + diffuse_.y, u, v) - diffuse_;
    }
    return {value, cellSize(leaf.depth), leaf.node};
  }

  double albedo(const V3d& view) const override {
    const Means* means = meansFor(view);
    return means ? kPi * means->at(given(view)).value : 0;
  }

  V3d sample(const V3d& view, double u1, double u2) const override {
    const bool swap = turned(view);
    const auto [x, y] = meansFor(view)->draw(given(view), u1, u2);
    V3d d = diskOfSquare(x, y);
    if (swap) d = V3d(-d.x, -d.y, d.z);
    if (rank_ == 3) {
      const auto [cosine, sine] = azimuth(view);
      d = V3d(cosine * d.x - sine * d.y, sine * d.x + cosine * d.y, d.z);
    }
    if ((view.z > 0) == transmits()) d.z = -d.z;
    return d;
  }

  Resolution resolution(const V3d& view) const override {
    const Means* means = meansFor(view);
    if (!means) return {};
    const Means::Mean m = means->at(given(view));
    return {cellSize(m.finest), cellSize(m.coarsest)};
  }

 private:
  static double cellSize(int depth) { return kPi * std::ldexp(1., -2 * depth); }

  int deepest(const rad::TensorTree& tree, uint32_t node) const {
    const uint32_t children = tree.nodes[node].children;
    if (children == 0) return 0;
    int most = 0;
    for (uint32_t i = 0; i < 1U << rank_; ++i) most = std::max(most, deepest(tree, children + i));
    return most + 1;
  }

  // Adds the values of the tree's cells. In isotropic data, half of the cells correspond to no direction and
  // are skipped.
  void collect(Smallest& smallest, bool colored, uint32_t y, uint32_t u, uint32_t v, bool root) const {
    const uint32_t children = trees_.y.nodes[y].children;
    if (children == 0) {
      const double value = trees_.y.nodes[y].value;
      if (colored)
        smallest.add(ofChromaticity(value, mean(trees_.u, u), mean(trees_.v, v)));
      else
        smallest.addGrey(value);
      return;
    }
    const auto below = [](const rad::TensorTree& tree, uint32_t node, uint32_t i) {
      return tree.nodes[node].children == 0 ? node : tree.nodes[node].children + i;
    };
    for (uint32_t i = 0; i < 1U << rank_; ++i) {
      if (root && rank_ == 3 && (i & 1)) continue;
      collect(smallest, colored, children + i, colored ? below(trees_.u, u, i) : 0,
              colored ? below(trees_.v, v, i) : 0, false);
    }
  }
  double mean(const rad::TensorTree& tree, uint32_t node) const {
    const uint32_t children = tree.nodes[node].children;
    if (children == 0) return tree.nodes[node].value;
    double sum = 0;
    for (uint32_t i = 0; i < 1U << rank_; ++i) sum += mean(tree, children + i);
    return sum / (1U << rank_);
  }

  // Cosine and sine of the reference azimuth of isotropic data: that of undeflected light from the view.
  static std::array<double, 2> azimuth(const V3d& view) {
    const double r = std::sqrt(view.x * view.x + view.y * view.y);
    if (!(r > 0)) return {1, 0};
    return {-view.x / r, -view.y / r};
  }
  // The coordinate for the polar angle: the lower half of the dimension covers all angles, from grazing (0)
  // to normal (.5).
  static double slant(const V3d& d) {
    return std::clamp(.5 - .5 * std::sqrt(d.x * d.x + d.y * d.y), 0., .5 - 0x1p-54);
  }

  Coordinates point(const V3d& from, const V3d& to) const {
    if (rank_ == 3) {
      const auto [cosine, sine] = azimuth(from);
      const auto s = squareOfDisk(cosine * to.x + sine * to.y, cosine * to.y - sine * to.x);
      return {slant(from), s[0], s[1], 0};
    }
    const auto i = squareOfDisk(-from.x, -from.y), o = squareOfDisk(to.x, to.y);
    return {i[0], i[1], o[0], o[1]};
  }

  // Null if the directions of the data would have to be exchanged but cannot be.
  const Means* meansFor(const V3d& view) const {
    if (!turned(view)) return &straight_;
    return turned_ ? &*turned_ : nullptr;
  }
  Coordinates given(const V3d& view) const {
    if (rank_ == 3) return {slant(view), 0, 0, 0};
    const auto s = turned(view) ? squareOfDisk(view.x, view.y) : squareOfDisk(-view.x, -view.y);
    return {s[0], s[1], 0, 0};
  }

  rad::BsdfTrees trees_;
  int rank_;
  Tristimulus diffuse_;
  Means straight_;
  std::optional<Means> turned_;
};

}  // namespace

Color rgbOf(const Tristimulus& c) {
  if (c.x == c.y && c.z == c.y) return Color(c.y, c.y, c.y);
  const V3d rgb = standardRgb(c);
  return Color(std::max(0., rgb.x), std::max(0., rgb.y), std::max(0., rgb.z));
}

BsdfData::BsdfData(const BsdfFile& file, std::string_view name, const rad::Warn& warn) {
  constexpr double kLeastAlbedo = .001, kMostAlbedo = 1.01;
  constexpr std::string_view kNames[] = {"front reflection", "back reflection", "front transmission",
                                         "back transmission"};
  std::array<std::unique_ptr<DirectedScattering>, 4> made;
  std::array<bool, 4> given{};
  for (size_t i = 0; i < BsdfFile::kComponents; ++i) {
    const bool front = i == BsdfFile::kReflectionFront || i == BsdfFile::kTransmissionFront;
    const bool across = i == BsdfFile::kTransmissionFront || i == BsdfFile::kTransmissionBack;
    Tristimulus diffuse(0);
    if (file.matrices[i])
      made[i] =
          std::make_unique<MatrixScattering>(*file.matrices[i], file.bases, front, front != across, diffuse);
    else if (file.trees[i])
      made[i] = std::make_unique<TreeScattering>(*file.trees[i], file.rank, front, front != across, diffuse);
    given[i] = made[i] != nullptr;
    diffuse_[i] = rgbOf(diffuse * kPi);
    diffuseLuminance_[i] = diffuse.y;
    if (!made[i]) continue;
    if (const double most = kPi * diffuse.y + made[i]->largestAlbedo(); most > kMostAlbedo && warn)
      warn(fmt::format("{}: {} of {:.1f}% of the light", name, kNames[i], 100 * most));
    if (made[i]->largestAlbedo() <= kLeastAlbedo) made[i].reset();
  }
  for (const auto& [i, other] : {std::pair<size_t, size_t>{2, 3}, {3, 2}}) {
    if (!given[i]) {
      diffuse_[i] = diffuse_[other];
      diffuseLuminance_[i] = diffuseLuminance_[other];
    }
    if (made[other] && !made[i] && !made[other]->prepareTurned() && warn)
      warn(fmt::format("{}: no {}, and isotropic data of the other side do not determine it", name,
                       kNames[i]));
  }
  std::move(made.begin(), made.end(), directed_.begin());
}

DirectedScattering::Resolution BsdfData::resolution(const V3d& view) const {
  const bool front = view.z > 0;
  DirectedScattering::Resolution r{std::numeric_limits<double>::max(), 0};
  for (const DirectedScattering* part : {reflection(front), transmission(front)}) {
    if (!part) continue;
    const auto own = part->resolution(view);
    if (own.finest > 0) r.finest = std::min(r.finest, own.finest);
    r.coarsest = std::max(r.coarsest, own.coarsest);
  }
  if (!(r.coarsest > 0)) return {kPi, kPi};
  return r;
}

BsdfData::Through BsdfData::through(const V3d& view) const {
  const bool front = view.z > 0;
  const DirectedScattering* part = transmission(front);
  if (!part) return {};

  // Probes cells around the undeflected direction, at points of a 9 by 9 grid: on its axes and diagonals
  // except the corners, at a spacing of .6 cells. The criteria for a peak and its surroundings are
  // RADIANCE's.
  struct Probe {
    double luminance;
    DirectedScattering::Cell cell;
  };
  std::array<Probe, 29> probes;
  size_t count = 0;
  const double step = .6 * std::sqrt(part->finestCell());
  const auto probe = [&](int i, int j) {
    const V3d d(-view.x + i * step, -view.y + j * step, -view.z);
    Probe p{0, part->cell(view, d.normalized())};
    p.luminance = p.cell.value.y + diffuseLuminance_[front ? 2 : 3];
    for (size_t k = 0; k < count; ++k)
      if (probes[k].cell.number == p.cell.number) return;
    probes[count++] = p;
  };
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) {
      const int far = std::max(std::abs(i), std::abs(j)), near = std::min(std::abs(i), std::abs(j));
      if ((near == 0 || near == far) && !(near == 4)) probe(i, j);
    }
  const auto found = std::span(probes).first(count);
  std::ranges::sort(found, [](const Probe& a, const Probe& b) { return a.luminance > b.luminance; });

  constexpr double kSizeOfPeak = 1.5, kHeightOfPeak = 8, kLeastAround = .2, kLeastPeak = .0005;
  if (found[0].luminance <= kNegligible ||
      found[0].cell.projectedSolidAngle > kSizeOfPeak * part->finestCell())
    return {};
  Through t;
  double peakAngle = 0, aroundAngle = 0, luminance = 0;
  int inPeak = 0;
  for (const Probe& p : found) {
    const double angle = p.cell.projectedSolidAngle;
    const Color light = rgbOf(p.cell.value) * angle;
    if (angle > kSizeOfPeak * part->finestCell() || luminance > kHeightOfPeak * p.luminance * inPeak) {
      t.around += light;
      aroundAngle += angle;
      continue;
    }
    t.peak += light;
    peakAngle += angle;
    luminance += p.luminance;
    ++inPeak;
  }
  if (aroundAngle < kLeastAround * peakAngle || brightness(t.peak) < kLeastPeak) return {};
  t.around /= aroundAngle;
  return t;
}

}  // namespace rsphere
