#include "transport/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rsphere {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

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

std::vector<int> HemisphereCells::refinement(std::span<const double> brightness, int more) const {
  std::vector<double> upTo(count());
  double sum = 0;
  for (int j = 0; j < rings_; ++j)
    for (int k = 0; k < sectors_; ++k) {
      double first = 0, second = 0;
      int around = 0;
      for (int dj = -1; dj <= 1; ++dj)
        for (int dk = -1; dk <= 1; ++dk) {
          const int ring = j + dj;
          if ((dj == 0 && dk == 0) || ring < 0 || ring >= rings_) continue;
          const double b = brightness[ring * sectors_ + (k + dk + sectors_) % sectors_];
          first += b;
          second += b * b;
          ++around;
        }
      sum += std::sqrt(std::max(0., second / around - (first / around) * (first / around)));
      upTo[j * sectors_ + k] = sum;
    }
  std::vector<int> rays(count(), 0);
  if (!(sum > 0)) return rays;
  int given = 0;
  for (int i = 0; i < count(); ++i) {
    const int due = static_cast<int>(upTo[i] / sum * more + .5);
    rays[i] = due - given;
    given = due;
  }
  return rays;
}

GatheredLight HemisphereCells::sum(std::span<const Rgb> radiance, std::span<const int> rays,
                                   std::span<const double> distance, double nearest, const V3d& x,
                                   const V3d& y) const {
  Rgb mean(0, 0, 0);
  // By channel, along x and y.
  double move[3][2] = {}, tilt[3][2] = {}, variance = 0, slopeVariance = 0;
  const auto at = [&](int j, int k) { return j * sectors_ + k; };
  const auto apart = [&](int a, int b) { return std::max(nearest, std::min(distance[a], distance[b])); };
  const double sector = 2 * kPi / sectors_;
  // The mean of the tangent of the angle to the normal over each ring, and that of a direction over a sector.
  const double acrossSector = std::sin(sector / 2) / (sector / 2);
  std::vector<double> tangent(rings_), edgeWeight(rings_), sine(rings_ + 1);
  const auto primitive = [](double s) { return std::asin(s) - s * std::sqrt(std::max(0., 1 - s * s)); };
  for (int j = 0; j <= rings_; ++j) sine[j] = std::sqrt(static_cast<double>(j) / rings_);
  for (int j = 0; j < rings_; ++j) {
    tangent[j] = rings_ * (primitive(sine[j + 1]) - primitive(sine[j])) * acrossSector;
    edgeWeight[j] = 2. / sectors_ * sine[j] * (1 - sine[j] * sine[j]);
  }
  for (int k = 0; k < sectors_; ++k) {
    const int before = (k + sectors_ - 1) % sectors_;
    const double middle = (k + .5) * sector, edge = k * sector;
    Rgb outwards(0, 0, 0), around(0, 0, 0), leaning(0, 0, 0);
    const auto addChance = [&](int a, int b, double weight) {
      const double difference = brightness(radiance[a] - radiance[b]);
      variance += difference * difference * (.125 / rays[a] + .125 / rays[b]);
      slopeVariance += difference * difference * weight * weight / 2;
    };
    for (int j = 0; j < rings_; ++j) {
      const int here = at(j, k);
      mean += radiance[here];
      leaning += radiance[here] * tangent[j];
      if (j > 0) {
        const double weight = edgeWeight[j] / apart(here, at(j - 1, k));
        outwards += (radiance[here] - radiance[at(j - 1, k)]) * weight;
        addChance(here, at(j - 1, k), weight);
      }
      const double weight = (sine[j + 1] - sine[j]) / (kPi * apart(here, at(j, before)));
      around += (radiance[here] - radiance[at(j, before)]) * weight;
      addChance(here, at(j, before), weight);
    }
    for (int c = 0; c < 3; ++c) {
      move[c][0] += outwards[c] * std::cos(middle) - around[c] * std::sin(edge);
      move[c][1] += outwards[c] * std::sin(middle) + around[c] * std::cos(edge);
      tilt[c][0] += leaning[c] * std::cos(middle);
      tilt[c][1] += leaning[c] * std::sin(middle);
    }
  }
  GatheredLight light;
  double inverse = 0;
  for (const double d : distance) inverse += 1 / std::max(d, nearest);
  light.reach = static_cast<float>(count() / inverse);
  light.noise = static_cast<float>(std::sqrt(variance) / count());
  light.noisePerLength = static_cast<float>(std::sqrt(slopeVariance));
  light.mean = V3f(mean / count());
  for (int c = 0; c < 3; ++c) {
    light.perLength[c] = V3f(move[c][0] * x + move[c][1] * y);
    light.perTilt[c] = V3f((tilt[c][0] * x + tilt[c][1] * y) / count());
  }
  return light;
}

}  // namespace rsphere
