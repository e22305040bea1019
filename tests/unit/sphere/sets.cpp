#include "sets.h"

#include <cmath>
#include <numbers>

#include "sphere/directions.h"

namespace rsphere {
namespace {

using std::numbers::pi;

V3d polar(double fromPole, double turn) {
  return V3d(std::sin(fromPole) * std::cos(turn), std::sin(fromPole) * std::sin(turn), std::cos(fromPole))
      .normalized();
}

std::vector<V3d> ring(int n, double fromPole, double turn = 2 * pi) {
  std::vector<V3d> directions;
  for (int i = 0; i < n; ++i) directions.push_back(polar(fromPole, turn * i / n));
  return directions;
}

// Exactly in the plane z = 0.
std::vector<V3d> greatCircle(int n, double turn = 2 * pi) {
  std::vector<V3d> directions;
  for (int i = 0; i < n; ++i) directions.emplace_back(std::cos(turn * i / n), std::sin(turn * i / n), 0);
  return directions;
}

std::vector<V3d> cap(int n, double radius, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit;
  std::vector<V3d> directions;
  for (int i = 0; i < n; ++i)
    directions.push_back(polar(radius * std::sqrt(unit(random)), 2 * pi * unit(random)));
  return directions;
}

std::vector<V3d> operator+(std::vector<V3d> a, const std::vector<V3d>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<V3d> nearTwins(double distance) {
  std::mt19937_64 random(5);
  std::vector<V3d> directions = baseDirections(150);
  for (int i = 0; i < 150; ++i)
    directions.push_back((directions[i] + randomDirection(random) * distance).normalized());
  return directions;
}

}  // namespace

V3d randomDirection(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  V3d d;
  for (int axis = 0; axis < 3; ++axis) d[axis] = normal(random);
  return d.normalized();
}

std::vector<V3d> randomDirections(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<V3d> directions(n);
  for (V3d& d : directions) d = randomDirection(random);
  return directions;
}

std::vector<V3d> regularSolid(int corners) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  std::vector<V3d> directions;
  for (int i = 0; i < 8; ++i) {
    const V3d s(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const bool even = s.x * s.y * s.z > 0;
    if (corners == 4 && even) directions.push_back(s);
    if (corners == 8 || corners == 20) directions.push_back(s);
    if (corners == 6 && i < 6)
      directions.push_back(i % 2 ? V3d(i / 2 == 0, i / 2 == 1, i / 2 == 2)
                                 : -V3d(i / 2 == 0, i / 2 == 1, i / 2 == 2));
    if (i < 4 && corners == 12) {
      directions.insert(directions.end(), {V3d(0, s.x, s.y * g), V3d(s.x, s.y * g, 0), V3d(s.y * g, 0, s.x)});
    }
    if (i < 4 && corners == 20) {
      directions.insert(directions.end(),
                        {V3d(0, s.x / g, s.y * g), V3d(s.x / g, s.y * g, 0), V3d(s.y * g, 0, s.x / g)});
    }
  }
  for (V3d& d : directions) d.normalize();
  return directions;
}

std::vector<Set> hardSets() {
  std::vector<Set> built = {
      {"four", randomDirections(4, 1)},
      {"random", randomDirections(2000, 2)},
      {"lattice", baseDirections(4096)},
      {"great_circle_4", greatCircle(4)},
      {"great_circle_7", greatCircle(7)},
      {"great_circle_300", greatCircle(300)},
      {"great_circle_and_pole", greatCircle(100) + std::vector<V3d>{V3d(0, 0, 1)}},
      {"half_great_circle", greatCircle(50, 3.0)},
      {"arc", greatCircle(100, 0.3)},
      {"crossed_great_circles", greatCircle(36) + rotatedDirections(greatCircle(36), 9)},
      {"small_circle_4", ring(4, 0.7)},
      {"small_circle_300", ring(300, 0.7)},
      {"small_circle_1e-3", ring(100, 1e-3)},
      {"small_circle_1e-6", ring(100, 1e-6)},
      {"small_circle_1e-9", ring(100, 1e-9)},
      {"twins_at_1e-9", nearTwins(1e-9)},
      {"twins_at_1e-14", nearTwins(1e-14)},
      {"twins_at_1e-15", nearTwins(1e-15)},
      {"equal", baseDirections(100) + baseDirections(100) + baseDirections(100)},
      {"antipodes", randomDirections(30, 3) + rotatedDirections(randomDirections(30, 3), 0)},
  };
  for (std::size_t i = 30; i < 60; ++i) built.back().directions[i] *= -1;
  for (int corners : {4, 6, 8, 12, 20})
    built.push_back({"solid_" + std::to_string(corners), regularSolid(corners)});
  built.push_back({"solid_12_and_its_dual", regularSolid(12) + regularSolid(20)});
  for (int power : {0, 1, 3, 6, 9})
    built.push_back({"cap_1e-" + std::to_string(power), cap(400, std::pow(0.1, power), 4)});
  built.push_back({"hemisphere", cap(400, pi / 2 / std::sqrt(2.0), 4) + greatCircle(40)});
  for (int power : {3, 6, 8, 10, 12}) {
    built.push_back(
        {"cluster_1e-" + std::to_string(power), baseDirections(300) + cap(300, std::pow(0.1, power), 4)});
  }
  std::vector<V3d> grid = {V3d(0, 0, 1), V3d(0, 0, -1)}, crowded = grid;
  for (int i = 1; i < 40; ++i) grid = grid + ring(80, pi * i / 40);
  for (int i = 0; i < 15; ++i) crowded = crowded + ring(60, 1e-6 * std::pow(2.2, i));
  built.push_back({"latitude_longitude", grid});
  built.push_back({"crowded_pole", crowded});

  std::vector<Set> sets;
  for (const Set& set : built) {
    sets.push_back(set);
    sets.push_back({set.name + "_rotated", rotatedDirections(set.directions, 3)});
  }
  return sets;
}

std::vector<V3d> degenerateSet(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto any = [&](int n) { return static_cast<int>(random() % n); };
  std::vector<V3d> directions;
  const int pieces = 1 + any(4);
  for (int piece = 0; piece < pieces; ++piece) {
    const std::uint64_t rotation = any(2) == 0 ? 0 : 1 + any(1000);
    std::vector<V3d> some;
    switch (any(7)) {
      case 0:  // corners of a grid in a cube
        for (int i = 0; i < 20; ++i) {
          const V3d d(any(5) - 2, any(5) - 2, any(5) - 2);
          if (d != V3d(0)) some.push_back(d.normalized());
        }
        break;
      case 1:
        some = ring(3 + any(20), 0.1 * (1 + any(30)));
        break;
      case 2:
        some = greatCircle(3 + any(20), any(2) == 0 ? 2 * pi : 1.0);
        break;
      case 3:
        some = regularSolid(std::array{4, 6, 8, 12, 20}[any(5)]);
        break;
      case 4:
        some = cap(3 + any(20), std::pow(0.1, any(12)), random());
        break;
      case 5:  // equal ones and antipodes of what is there
        for (int i = 0; i < 10 && !directions.empty(); ++i) {
          some.push_back(directions[any(static_cast<int>(directions.size()))] * (any(2) == 0 ? 1.0 : -1.0));
        }
        break;
      default:
        some = randomDirections(1 + any(20), random());
    }
    directions = directions + (rotation == 0 ? some : rotatedDirections(some, rotation));
  }
  if (directions.empty()) directions.push_back(V3d(0, 0, 1));
  return directions;
}

}  // namespace rsphere
