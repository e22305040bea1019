#include "base/radiometry.h"

#include <gtest/gtest.h>

#include <concepts>
#include <type_traits>
#include <utility>

#include "base/spectral_sampling.h"

namespace rsphere {
namespace {

template <class A, class B>
concept Unrelated = !std::is_constructible_v<A, B> && !std::is_assignable_v<A&, B> &&
                    !std::is_constructible_v<B, A> && !std::is_assignable_v<B&, A>;
static_assert(Unrelated<Radiance, Irradiance> && Unrelated<Radiance, Coefficient> &&
              Unrelated<Irradiance, Coefficient>);

// Colors and numbers convert only where the kind is named, and nothing converts back.
template <class Q>
concept Explicit = std::is_constructible_v<Q, Color> && !std::is_convertible_v<Color, Q> &&
                   !std::is_assignable_v<Q&, Color> && std::is_constructible_v<Q, double> &&
                   !std::is_convertible_v<double, Q> && !std::is_convertible_v<Q, Color>;
static_assert(Explicit<Radiance> && Explicit<Irradiance> && Explicit<Coefficient>);

template <class A, class B>
concept CanBeAdded = requires(A a, const A& c, const B& b) {
  c + b;
}
|| requires(A a, const B& b) { a += b; }
|| requires(const A& a, const B& b) { a - b; };
static_assert(CanBeAdded<Radiance, Radiance> && CanBeAdded<Irradiance, Irradiance> &&
              CanBeAdded<Coefficient, Coefficient>);
static_assert(!CanBeAdded<Radiance, Irradiance> && !CanBeAdded<Irradiance, Radiance> &&
              !CanBeAdded<Radiance, Coefficient> && !CanBeAdded<Coefficient, Radiance> &&
              !CanBeAdded<Radiance, Color> && !CanBeAdded<Color, Radiance>);

template <class A, class B>
concept CanBeMultiplied = requires(const A& a, const B& b) {
  a* b;
};
static_assert(!CanBeMultiplied<Radiance, Radiance> && !CanBeMultiplied<Radiance, Irradiance> &&
              !CanBeMultiplied<Irradiance, Irradiance> && !CanBeMultiplied<Radiance, Color> &&
              !CanBeMultiplied<Color, Radiance>);
template <class A, class B>
using Product = decltype(std::declval<A>() * std::declval<B>());
static_assert(std::same_as<Product<Radiance, Coefficient>, Radiance> &&
              std::same_as<Product<Coefficient, Radiance>, Radiance> &&
              std::same_as<Product<Coefficient, Irradiance>, Irradiance> &&
              std::same_as<Product<Coefficient, Coefficient>, Coefficient> &&
              std::same_as<Product<double, Radiance>, Radiance>);

static_assert(!std::is_invocable_v<decltype(irradianceFrom), Coefficient, double> &&
              !std::is_invocable_v<decltype(meanRadiance), Radiance, double>);

static_assert(sizeof(Radiance) == sizeof(Color), "a type costs no memory");

TEST(Radiometry, QuantitiesAreZeroUntilSet) {
  EXPECT_EQ(Radiance().color, Color(0, 0, 0));
  EXPECT_TRUE(isBlack(Irradiance()));
}

TEST(Radiometry, ArithmeticIsThatOfTheChannels) {
  const Color a(1, 2, 3), b(.5, .25, 4);
  EXPECT_EQ((Radiance(a) + Radiance(b)).color, a + b);
  EXPECT_EQ((Radiance(a) - Radiance(b)).color, a - b);
  EXPECT_EQ((Radiance(a) * Coefficient(b)).color, a * b);
  EXPECT_EQ((Coefficient(b) * Radiance(a)).color, a * b);
  EXPECT_EQ((Coefficient(a) * Coefficient(b)).color, a * b);
  EXPECT_EQ((3 * Radiance(a) / 2).color, Color(1.5, 3, 4.5));
  Radiance sum(a);
  sum += Radiance(b);
  sum -= Radiance(1);
  sum *= Coefficient(b);
  sum *= 6;
  sum /= 3;
  EXPECT_EQ(sum.color, (a + b - Color(1, 1, 1)) * b * 2.);
  EXPECT_EQ(brightness(Radiance(a)), brightness(a));
  EXPECT_EQ(maxChannel(Coefficient(b)), 4);
}

// A band may be bright where the means of all channels are not.
TEST(Radiometry, ExtremesAreThoseOfTheBands) {
  Bands bands(spectralSampling(6, 380, 780));
  bands.values()[3] = -2;
  bands.values()[4] = .5;
  const Color color(bands), dark(V3d(0, 0, 0), bands);
  for (const Color& c : {color, dark}) {
    EXPECT_EQ(maxChannel(c), .5);
    EXPECT_EQ(minChannel(c), -2);
    EXPECT_FALSE(isBlack(c));
  }
  EXPECT_TRUE(isBlack(Color(Bands(spectralSampling(6, 380, 780)))));
  EXPECT_EQ(maxChannel(Color(1, 3, 2)), 3);
  EXPECT_EQ(minChannel(Color(2, 3, 1)), 1);
  EXPECT_TRUE(isBlack(Color(0, -1, 0)));
}

TEST(Radiometry, MeanRadianceIsThatOfTheIrradianceFromTheSameSolidAngle) {
  const Radiance radiance(Color(1, 2, 3));
  EXPECT_EQ(irradianceFrom(radiance, .25).color, Color(.25, .5, .75));
  EXPECT_EQ(meanRadiance(irradianceFrom(radiance, .25), .25).color, radiance.color);
}

}  // namespace
}  // namespace rsphere
