#pragma once
// Sums and products of two doubles without error (Knuth's sum, Dekker's product): high is the rounded result,
// low its rounding error. Requires that nothing overflows or underflows, and that the compiler does not
// contract products and sums (CMakeLists.txt).
namespace rsphere {

struct TwoParts {
  double high, low;
};

inline TwoParts sum(double a, double b) {
  const double s = a + b, fromB = s - a;
  return {s, (a - (s - fromB)) + (b - fromB)};
}

// Veltkamp's splitting into halves of 26 bits each, so that products of halves are exact.
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
