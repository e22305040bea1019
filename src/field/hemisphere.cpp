#include "field/hemisphere.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/spectral_sampling.h"

namespace rsphere {

HemisphereCells::HemisphereCells(int rays)
    : rings_(std::max(1, static_cast<int>(std::sqrt(rays / kPi) + .5))),
      sectors_(std::max(4, static_cast<int>(static_cast<double>(rays) / rings_ + .5))) {}

V3d HemisphereCells::direction(int cell, double u1, double u2, const V3d& x, const V3d& y,
                               const V3d& z) const {
  const double square = (cell / sectors_ + u1) / rings_;
  const double radius = std::sqrt(square), height = std::sqrt(std::max(0., 1 - square));
  const double angle = 2 * kPi * (cell % sectors_ + u2) / sectors_;
  return radius * std::cos(angle) * x + radius * std::sin(angle) * y + height * z;
}

int HemisphereCells::cellOf(const V3d& direction, const V3d& x, const V3d& y, const V3d& z) const {
  const double height = direction.dot(z);
  double azimuth = std::atan2(direction.dot(y), direction.dot(x)) / (2 * kPi);
  if (azimuth < 0) azimuth += 1;
  const int ring = std::clamp(static_cast<int>((1 - height * height) * rings_), 0, rings_ - 1);
  const int sector = std::clamp(static_cast<int>(azimuth * sectors_), 0, sectors_ - 1);
  return ring * sectors_ + sector;
}

namespace {

// Mean values over a ring of cells. c and s: cosine and sine of the angle to the normal.
struct RingMeans {
  double c, s, inverseC, tangent;
  double edgeWeight;  // weight of the difference between this ring and the next inner one
  double width;       // difference between the sines of its two edges
};

std::vector<RingMeans> meansOfRings(int rings, int sectors) {
  const auto primitive = [](double s) { return std::asin(s) - s * std::sqrt(std::max(0., 1 - s * s)); };
  const auto sine = [&](int j) { return std::sqrt(static_cast<double>(j) / rings); };
  std::vector<RingMeans> means(rings);
  for (int j = 0; j < rings; ++j) {
    const double s0 = sine(j), s1 = sine(j + 1), c0 = std::sqrt(1 - s0 * s0),
                 c1 = std::sqrt(std::max(0., 1 - s1 * s1));
    means[j] = {2. / 3 * rings * (c0 * c0 * c0 - c1 * c1 * c1),
                2. / 3 * rings * (s1 * s1 * s1 - s0 * s0 * s0),
                2 * rings * (c0 - c1),
                rings * (primitive(s1) - primitive(s0)),
                2. / sectors * s0 * (1 - s0 * s0),
                s1 - s0};
  }
  return means;
}

// Sums of the radiance over a sector, weighted by the mean values of its rings.
struct SectorSums {
  Color one{0, 0, 0}, s{0, 0, 0}, c{0, 0, 0}, inverseC{0, 0, 0}, tangent{0, 0, 0};

  void add(const Color& radiance, const RingMeans& ring) {
    one += radiance;
    inverseC += radiance * ring.inverseC;
    tangent += radiance * ring.tangent;
    s += radiance * ring.s;
    c += radiance * ring.c;
  }
};

// out: the middle direction of the sector in the plane of the surface. acrossSector: mean over the sector of
// the cosine of the angle to `out`. count: number of all cells.
void addSector(LightMoments& moments, const SectorSums& sums, const V3d& out, double acrossSector,
               const V3d& z, int count) {
  for (int b = 0; b < 3; ++b) {
    moments.all[b] += static_cast<float>(sums.inverseC[b] / count);
    moments.first[b] += V3f((sums.tangent[b] * acrossSector * out + sums.one[b] * z) / count);
    const double flat = sums.inverseC[b] - sums.c[b], aslant = sums.s[b] * acrossSector;
    const auto product = [&](int i, int j) {
      return static_cast<float>(
          (flat * out[i] * out[j] + aslant * (out[i] * z[j] + z[i] * out[j]) + sums.c[b] * z[i] * z[j]) /
          count);
    };
    moments.squares[b] += V3f(product(0, 0), product(1, 1), product(2, 2));
    moments.products[b] += V3f(product(1, 2), product(2, 0), product(0, 1));
  }
}

}  // namespace

GatheredLight HemisphereCells::sum(std::span<const Radiance> radiance, std::span<const double> distance,
                                   double nearest, const V3d& x, const V3d& y, const V3d& z) const {
  Radiance mean;
  // Gradient per channel, along x and y.
  double move[3][2] = {}, variance = 0, slopeVariance = 0;
  const auto at = [&](int j, int k) { return j * sectors_ + k; };
  const auto apart = [&](int a, int b) { return std::max(nearest, std::min(distance[a], distance[b])); };
  const double sector = 2 * kPi / sectors_;
  const double acrossSector = std::sin(sector / 2) / (sector / 2);
  const std::vector<RingMeans> rings = meansOfRings(rings_, sectors_);
  const auto addChance = [&](int a, int b, double weight) {
    const double difference = brightness(radiance[a] - radiance[b]);
    variance += difference * difference / 4;
    slopeVariance += difference * difference * weight * weight / 2;
  };
  GatheredLight light;
  for (int k = 0; k < sectors_; ++k) {
    const int before = (k + sectors_ - 1) % sectors_;
    const double middle = (k + .5) * sector, edge = k * sector;
    V3d outwards(0, 0, 0), around(0, 0, 0);
    SectorSums sums;
    for (int j = 0; j < rings_; ++j) {
      const int here = at(j, k);
      mean += radiance[here];
      sums.add(Color(radiance[here].color.rgb()), rings[j]);
      if (j > 0) {
        const double weight = rings[j].edgeWeight / apart(here, at(j - 1, k));
        outwards += (radiance[here].color.rgb() - radiance[at(j - 1, k)].color.rgb()) * weight;
        addChance(here, at(j - 1, k), weight);
      }
      const double weight = rings[j].width / (kPi * apart(here, at(j, before)));
      around += (radiance[here].color.rgb() - radiance[at(j, before)].color.rgb()) * weight;
      addChance(here, at(j, before), weight);
    }
    for (int b = 0; b < 3; ++b) {
      move[b][0] += outwards[b] * std::cos(middle) - around[b] * std::sin(edge);
      move[b][1] += outwards[b] * std::sin(middle) + around[b] * std::cos(edge);
    }
    addSector(light.tilted, sums, std::cos(middle) * x + std::sin(middle) * y, acrossSector, z, count());
  }
  double inverse = 0;
  for (const double d : distance) inverse += 1 / std::max(d, nearest);
  light.reach = static_cast<float>(count() / inverse);
  light.noise = static_cast<float>(std::sqrt(variance) / count());
  light.noisePerLength = static_cast<float>(std::sqrt(slopeVariance));
  light.setColor(mean.color / count());
  for (int b = 0; b < 3; ++b) light.perLength[b] = V3f(move[b][0] * x + move[b][1] * y);
  return light;
}

void LightMoments::add(const LightMoments& other, float share) {
  for (int c = 0; c < 3; ++c) {
    all[c] += share * other.all[c];
    first[c] += share * other.first[c];
    squares[c] += share * other.squares[c];
    products[c] += share * other.products[c];
  }
}

// Expands the clamped cosine of the angle to n in Legendre polynomials: 1/4 + 1/2 n.d + 5/32 (3 (n.d)^2 - 1).
float LightMoments::towards(const V3f& n, int c) const {
  const V3f squared(n.x * n.x, n.y * n.y, n.z * n.z), mixed(n.y * n.z, n.z * n.x, n.x * n.y);
  const float second = squares[c].dot(squared) + 2 * products[c].dot(mixed);
  return all[c] / 4 + first[c].dot(n) / 2 + 5.F / 32 * (3 * second - all[c]);
}

Radiance GatheredLight::meanOfTilted(const V3d& normal, const V3d& perturbed) const {
  const V3f before(normal), after(perturbed);
  if ((after - before).length2() < 1e-12F) return Radiance(color());
  V3f result;
  for (int c = 0; c < 3; ++c) {
    // The moments give only the ratio of the two means, since `mean` is more accurate than they are.
    const float straight = tilted.towards(before, c);
    const float ratio = straight > 0 ? tilted.towards(after, c) / straight : 0;
    // Upper bound: all light arrives from the direction of the perturbed normal.
    const float most = tilted.all[c] > 0 ? tilted.all[c] : mean[c];
    result[c] = std::clamp(mean[c] * ratio, 0.F, std::max(most, mean[c]));
  }
  if (!bands) return Radiance(Color(V3d(result)));
  GatheredLight turned;
  turned.mean = mean;
  turned.bands = bands;
  turned.setMean(result);
  return Radiance(turned.color());
}

void GatheredLight::setColor(const Color& color) {
  mean = V3f(color.rgb());
  bands = bandsBeside(mean, color);
}

void GatheredLight::setMean(const V3f& changed) {
  bands = bandsBeside(changed, color());
  mean = changed;
}

Bands bandsBeside(const V3f& channels, const Color& color) {
  if (!color.bands()) return {};
  V3d ratio(0, 0, 0);
  for (int c = 0; c < 3; ++c)
    if (color[c] != 0) ratio[c] = double{channels[c]} / color[c];
  return (color * Color(ratio)).bands();
}

}  // namespace rsphere
