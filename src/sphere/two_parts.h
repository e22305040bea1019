#pragma once
// Sums and products of two doubles without error (Knuth's sum, Dekker's product): high is the rounded one,
// low what it lacks. Requires that nothing overflows or underflows, and no contraction (CMakeLists.txt).
namespace rsphere {

struct TwoParts {
  double high, low;
};

inline TwoParts sum(double a, double b) {
  const double s = a + b, fromB = s - a;
  return {s, (a - (s - fromB)) + (b - fromB)};
}

// Veltkamp's halves: 26 bits each, so that products of halves are exact.
inline TwoParts halves(double a) {
  const double c = 134217729.0 * a, high = c - (c - a);
  return {high, a - high};
}

inline TwoParts product(double a, double b) {
  const double p = a * b;
  const auto [ah, al] = halves(a);
  const auto [bh, bl] = halves(b);
  return {p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
}

}  // namespace rsphere
